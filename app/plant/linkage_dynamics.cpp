// SPDX-License-Identifier: Apache-2.0
#include "app/plant/linkage_dynamics.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

// Three axes couple weakly and the search starts from the last step's forces: one or two sweeps are
// the rule, more only while an axis comes to rest.
constexpr int kFrictionSweeps = 12;
constexpr double kFrictionToleranceN = 1e-3;

/// Inverse of a symmetric 3 x 3 matrix.
std::array<std::array<double, 3>, 3> inverse_of(const std::array<std::array<double, 3>, 3>& m) {
  const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2];
  const double c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2];
  const double c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
  const double scale = 1.0 / (m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02);
  const double i00 = c00 * scale;
  const double i01 = c01 * scale;
  const double i02 = c02 * scale;
  const double i11 = (m[0][0] * m[2][2] - m[0][2] * m[0][2]) * scale;
  const double i12 = (m[0][1] * m[0][2] - m[0][0] * m[1][2]) * scale;
  const double i22 = (m[0][0] * m[1][1] - m[0][1] * m[0][1]) * scale;
  return {{{i00, i01, i02}, {i01, i11, i12}, {i02, i12, i22}}};
}

/// From forces on the absolute link angles to those on the joints: a joint turns all links beyond.
JointArray to_joints(const JointArray& link) {
  return {link[0] + link[1] + link[2], link[1] + link[2], link[2]};
}

JointArray link_rates(const JointArray& joint) {
  return {joint[0], joint[0] + joint[1], joint[0] + joint[1] + joint[2]};
}

}  // namespace

SwingInertia::SwingInertia(const ExcavatorPlantProfile& profile)
    : body_(profile.link),
      link_length_{profile.machine.geometry.boom_length_m, profile.machine.geometry.arm_length_m,
                   profile.machine.geometry.bucket_length_m},
      boom_foot_m_(profile.machine.geometry.boom_foot_m.x()) {}

void SwingInertia::update(const JointRotations& joint) {
  inertia_ = 0.0;
  gradient_ = {};
  Rotation link;
  double pin_radius = boom_foot_m_;
  // By how much the pin's radius falls with the angle of each link before it.
  JointArray pin_drop{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    link = link.then(joint[i]);
    const LinkBody& body = body_[i];
    const Eigen::Vector2d centre = link.apply(body.mass_centre_m);
    const double moment = body.mass_kg * (pin_radius + centre.x());
    const double own = body.inertia_kgm2 * link.cosine;
    inertia_ += moment * (pin_radius + centre.x()) + own * link.cosine;
    for (std::size_t j = 0; j < i; ++j) {
      gradient_[j] -= 2.0 * moment * pin_drop[j];
    }
    gradient_[i] -= 2.0 * (moment * centre.y() + own * link.sine);
    pin_radius += link_length_[i] * link.cosine;
    pin_drop[i] = link_length_[i] * link.sine;
  }
}

LinkageDynamics::LinkageDynamics(const ExcavatorPlantProfile& profile)
    : geometry_(profile.machine.geometry),
      body_(profile.link),
      empty_bucket_(profile.link[kBucket]),
      link_length_{profile.machine.geometry.boom_length_m, profile.machine.geometry.arm_length_m,
                   profile.machine.geometry.bucket_length_m},
      gravity_(profile.gravity_mps2),
      boom_foot_m_(profile.machine.geometry.boom_foot_m) {
  set_pivot_inertias();
  if (profile.machine.has_swing()) {
    swing_.emplace(profile);
  }
}

void LinkageDynamics::set_pivot_inertias() {
  double carried = 0.0;
  for (std::size_t i = kAxisCount; i-- > 0;) {
    pivot_inertia_[i] = body_[i].inertia_kgm2 +
                        body_[i].mass_kg * body_[i].mass_centre_m.squaredNorm() +
                        carried * link_length_[i] * link_length_[i];
    carried += body_[i].mass_kg;
  }
}

void LinkageDynamics::carry(const LinkBody& fill) {
  if (fill.mass_kg == fill_kg_) {
    return;
  }
  fill_kg_ = fill.mass_kg;
  body_[kBucket] = together(empty_bucket_, fill);
  set_pivot_inertias();
  if (swing_) {
    swing_->set_bucket(body_[kBucket]);
  }
  update();
}

void LinkageDynamics::start(const JointArray& angle_rad, const JointArray& rate_radps) {
  angle_ = angle_rad;
  joint_ = rotations_of(angle_rad);
  rate_ = rate_radps;
  acceleration_ = {};
  friction_n_ = {};
  update();
}

void LinkageDynamics::update() {
  levers_ = geometry_.levers(joint_);
  Rotation link;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    link = link.then(joint_[i]);
    bodies_.link[i] = link.apply({link_length_[i], 0.0});
    bodies_.first_moment[i] = body_[i].mass_kg * link.apply(body_[i].mass_centre_m);
  }
  double carried = 0.0;
  for (std::size_t i = kAxisCount; i-- > 0;) {
    bodies_.first_moment[i] += carried * bodies_.link[i];
    carried += body_[i].mass_kg;
  }
  if (swing_) {
    swing_->update(joint_);
  }
}

LinkageDynamics::Matrix3 LinkageDynamics::mass_matrix() const {
  // In absolute link angles the off-diagonal terms are link . first moment; joints sum the links
  // beyond them.
  const double m01 = bodies_.link[0].dot(bodies_.first_moment[1]);
  const double m02 = bodies_.link[0].dot(bodies_.first_moment[2]);
  const double m12 = bodies_.link[1].dot(bodies_.first_moment[2]);
  const double j22 = pivot_inertia_[2];
  const double j12 = m12 + j22;
  const double j02 = m02 + j12;
  const double j11 = pivot_inertia_[1] + m12 + j12;
  const double j01 = m01 + m02 + j11;
  const double j00 = pivot_inertia_[0] + m01 + m02 + j01;
  return {{{j00, j01, j02}, {j01, j11, j12}, {j02, j12, j22}}};
}

JointArray LinkageDynamics::generalised_force(const JointArray& rate_radps) const {
  // Q - h. A link that turns at w pulls its first moment's centre inwards with w^2; across another
  // link's direction that is a moment on it.
  const JointArray rate = link_rates(rate_radps);
  JointArray force{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    force[i] =
        -gravity_ * base_.apply(bodies_.first_moment[i]).x() + cross(bodies_.link[i], tip_force_);
  }
  force[kBucket] += bucket_moment_nm_;
  if (base_acceleration_ != 0.0) {
    const JointArray by_links = links_moments();
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      force[i] -= base_acceleration_ * (by_links[i] + boom_foot_m_.dot(bodies_.first_moment[i]));
    }
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    for (std::size_t j = i + 1; j < kAxisCount; ++j) {
      const double arm = cross(bodies_.link[i], bodies_.first_moment[j]);
      force[i] += arm * rate[j] * rate[j];
      force[j] -= arm * rate[i] * rate[i];
    }
  }
  if (swing_) {
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      force[i] += 0.5 * swing_rate_ * swing_rate_ * swing_->gradient_kgm2prad()[i];
    }
  }
  return to_joints(force);
}

JointArray LinkageDynamics::holding_forces() const {
  const JointArray moment = generalised_force({});
  JointArray force{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    force[i] = -moment[i] / levers_[i].stroke_per_angle_m;
  }
  return force;
}

void LinkageDynamics::add_friction(const Matrix3& inverse,
                                   const std::array<PistonLoad, kAxisCount>& load, double step_s,
                                   JointArray& rate_radps) {
  const auto push = [&](std::size_t axis, double force_n) {
    const double moment = step_s * force_n * levers_[axis].stroke_per_angle_m;
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      rate_radps[i] += inverse[i][axis] * moment;
    }
  };
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    friction_n_[i] = std::clamp(friction_n_[i], -load[i].coulomb_n, load[i].coulomb_n);
    push(i, friction_n_[i]);
  }
  for (int sweep = 0; sweep < kFrictionSweeps; ++sweep) {
    double largest_change = 0.0;
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      const double lever = levers_[i].stroke_per_angle_m;
      const double mobility = step_s * lever * lever * inverse[i][i];  // (m/s) per N
      if (load[i].coulomb_n <= 0.0 || mobility <= 0.0) {
        continue;
      }
      const double wanted = friction_n_[i] - lever * rate_radps[i] / mobility;
      const double change =
          std::clamp(wanted, -load[i].coulomb_n, load[i].coulomb_n) - friction_n_[i];
      friction_n_[i] += change;
      push(i, change);
      largest_change = std::max(largest_change, std::abs(change));
    }
    if (largest_change < kFrictionToleranceN) {
      break;
    }
  }
}

JointArray LinkageDynamics::accelerate(const std::array<PistonLoad, kAxisCount>& load,
                                       double step_s) {
  step_ = step_s;
  // (M + h/2 D) dw = h (Q - h(w) + G f - D w), D = G^2 d: damping acts on the mean of old and new.
  const JointArray present = rates();
  JointArray impulse = generalised_force(present);
  Matrix3 matrix = mass_matrix();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double lever = levers_[i].stroke_per_angle_m;
    const double damping = lever * lever * load[i].damping_nspm;
    impulse[i] = step_s * (impulse[i] + lever * load[i].force_n - damping * rate_[i]);
    matrix[i][i] += 0.5 * step_s * damping;
  }
  const Matrix3 inverse = inverse_of(matrix);
  const JointArray before = rate_;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    rate_[i] +=
        inverse[i][0] * impulse[0] + inverse[i][1] * impulse[1] + inverse[i][2] * impulse[2];
  }
  add_friction(inverse, load, step_s, rate_);
  JointArray velocity{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    acceleration_[i] = (rate_[i] - before[i]) / step_s;
    velocity[i] = 0.5 * levers_[i].stroke_per_angle_m * (before[i] + rate_[i]);
  }
  return velocity;
}

void LinkageDynamics::move(double step_s) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double turn = step_s * rate_[i];
    angle_[i] += turn;
    joint_[i] = joint_[i].then(Rotation::by_little(turn)).normalised();
  }
  update();
}

JointArray LinkageDynamics::rates() const {
  const double half = 0.5 * step_;
  return {rate_[0] + half * acceleration_[0], rate_[1] + half * acceleration_[1],
          rate_[2] + half * acceleration_[2]};
}

double LinkageDynamics::tip_power_w() const {
  const double half = 0.5 * step_;
  const JointArray mean =
      link_rates({rate_[0] - half * acceleration_[0], rate_[1] - half * acceleration_[1],
                  rate_[2] - half * acceleration_[2]});
  double power = mean[kBucket] * bucket_moment_nm_;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    power += mean[i] * turned(bodies_.link[i]).dot(tip_force_);
  }
  return power;
}

JointArray LinkageDynamics::links_moments() const {
  const Matrix3 joints = mass_matrix();
  const JointArray all = {joints[0][0], joints[1][0], joints[2][0]};
  return {all[0] - all[1], all[1] - all[2], all[2]};
}

double LinkageDynamics::mass_kg() const {
  return body_[kBoom].mass_kg + body_[kArm].mass_kg + body_[kBucket].mass_kg;
}

BaseLoad LinkageDynamics::base_load() const {
  const Matrix3 matrix = mass_matrix();
  const JointArray rate = link_rates(rates());
  const JointArray turns = link_rates(acceleration_);
  BaseLoad load;
  // Sum of mass times acceleration, and its moment about the boom foot.
  Eigen::Vector2d pushes_n = Eigen::Vector2d::Zero();
  Eigen::Vector2d moments_kgm = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    load.links_moment_nm += matrix[0][i] * acceleration_[i];
    pushes_n +=
        turns[i] * turned(bodies_.first_moment[i]) - rate[i] * rate[i] * bodies_.first_moment[i];
    moments_kgm += bodies_.first_moment[i];
    for (std::size_t j = i + 1; j < kAxisCount; ++j) {
      const double arm = cross(bodies_.link[i], bodies_.first_moment[j]);
      load.links_moment_nm -= arm * (rate[j] * rate[j] - rate[i] * rate[i]);
    }
  }
  load.links_moment_nm += cross(boom_foot_m_, pushes_n);
  load.inertia_kgm2 =
      matrix[0][0] + 2.0 * boom_foot_m_.dot(moments_kgm) + mass_kg() * boom_foot_m_.squaredNorm();
  return load;
}

double LinkageDynamics::weight_moment_nm() const {
  Eigen::Vector2d moments_kgm = mass_kg() * boom_foot_m_;
  for (const Eigen::Vector2d& each : bodies_.first_moment) {
    moments_kgm += each;
  }
  return -gravity_ * base_.apply(moments_kgm).x();
}

double LinkageDynamics::energy_j() const {
  const Matrix3 matrix = mass_matrix();
  const JointArray rate = rates();
  double energy = 0.0;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    energy += gravity_ * bodies_.first_moment[i].y();
    for (std::size_t j = 0; j < kAxisCount; ++j) {
      energy += 0.5 * rate[i] * matrix[i][j] * rate[j];
    }
  }
  return energy;
}

}  // namespace graben::plant
