// SPDX-License-Identifier: Apache-2.0
#include "app/plant/link_imus.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

/// Between two moments that are kept; the reading is of the third of them.
constexpr double kBetween_s = 0.01;
constexpr std::size_t kAfter = 1;
constexpr std::size_t kOf = 2;
constexpr std::size_t kBefore = 3;
constexpr double kLatency_s = 0.02;

template <class Merit>
constexpr dbc::Coded<Merit> works() {
  return {Merit::kFunctional, dbc::RawState::kValid};
}

constexpr dbc::Physical reading(double value) { return {value, dbc::RawState::kValid}; }

}  // namespace

LinkImuModel::LinkImuModel(const ExcavatorPlantProfile& profile, std::optional<std::uint64_t> seed)
    : imu_(profile.machine.imu),
      geometry_(profile.machine.geometry),
      linkage_(profile.machine.geometry),
      errors_(profile.sensors),
      gravity_mps2_(profile.gravity_mps2) {
  if (!seed) {
    return;
  }
  noise_.emplace(*seed, Draw::kImuNoise);
  Random bias(*seed, Draw::kImuBias);
  for (Bias& each : bias_) {
    each.tilt_rad = bias.symmetric(errors_.imu_tilt_bias_rad);
    for (double& rate : each.rate_radps) {
      rate = bias.symmetric(errors_.imu_rate_bias_radps);
    }
  }
}

LinkImuModel::Moment LinkImuModel::moment_of(const ExcavatorPlant& plant) const {
  const JointArray& joint = plant.joint_angles_rad();
  Moment moment;
  moment.swing_rad = plant.swing_rad();
  const Eigen::Vector2d ahead(std::cos(moment.swing_rad), std::sin(moment.swing_rad));
  const RockingBase* const rocking = plant.rocking();
  const double base_rad = rocking != nullptr ? rocking->angle_rad() : 0.0;
  const auto on_ground = [&](const Eigen::Vector2d& at_m) {
    return rocking != nullptr ? rocking->on_ground(at_m) : at_m;
  };
  Eigen::Vector2d pin_m = geometry_.boom_foot_m;
  double link_rad = 0.0;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const bool on_rocker = imu_.mount[i].on_rocker;
    Eigen::Vector2d foot_m = pin_m;
    double body_rad = link_rad + joint[i];
    if (on_rocker) {
      // The arm's frame: `pin_m` is the bucket's pin, at its far end.
      foot_m += Rotation::by(link_rad).apply(geometry_.linkage.rocker_pivot_m -
                                             Eigen::Vector2d(geometry_.arm_length_m, 0.0));
      body_rad = link_rad + linkage_.rocker_angle(joint[i]);
    }
    const Eigen::Vector2d place =
        on_ground(foot_m + Rotation::by(body_rad).apply(imu_.mount[i].at_m));
    moment.angle_rad[i] = body_rad + base_rad;
    moment.place_m[i] = {place.x() * ahead.x(), place.x() * ahead.y(), place.y()};
    link_rad += joint[i];
    const double length_m = i == kBoom ? geometry_.boom_length_m : geometry_.arm_length_m;
    pin_m += Rotation::by(link_rad).apply({length_m, 0.0});
  }
  moment.angle_rad[kBodyImu] = base_rad;
  moment.place_m[kBodyImu].setZero();
  return moment;
}

void LinkImuModel::look(const ExcavatorPlant& plant) {
  const Moment now = moment_of(plant);
  if (!has_past_) {
    past_.fill(now);
    has_past_ = true;
  }
  std::rotate(past_.begin(), past_.end() - 1, past_.end());
  past_.front() = now;
}

Eigen::Vector2d LinkImuModel::seen(std::size_t imu, const Eigen::Vector2d& v) const {
  const ImuMount& mount = imu_.mount[imu];
  const Rotation back = Rotation::by(-mount.turn_rad - bias_[imu].tilt_rad);
  const Eigen::Vector2d turned_back = back.apply(v);
  return {mount.backwards ? -turned_back.x() : turned_back.x(), turned_back.y()};
}

double LinkImuModel::noise(double deviation) { return noise_ ? deviation * noise_->normal() : 0.0; }

dbc::j1939::ARI LinkImuModel::rates(std::size_t imu) {
  using Message = dbc::j1939::ARI;
  const double lifts_radps =
      (past_[kAfter].angle_rad[imu] - past_[kBefore].angle_rad[imu]) / (2.0 * kBetween_s);
  const double swings_radps =
      (past_[kAfter].swing_rad - past_[kBefore].swing_rad) / (2.0 * kBetween_s);
  const Eigen::Vector2d upright = Rotation::by(-past_[kOf].angle_rad[imu]).apply({0.0, 1.0});
  const Eigen::Vector2d about = swings_radps * seen(imu, upright);
  const std::array<double, 3> truth = {imu_.mount[imu].backwards ? -lifts_radps : lifts_radps,
                                       about.x(), about.y()};
  std::array<double, 3> shown{};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    shown[i] = truth[i] + bias_[imu].rate_radps[i] + noise(errors_.imu_rate_noise_radps);
  }
  return {reading(shown[0]),
          reading(shown[1]),
          reading(shown[2]),
          works<Message::PitchRateMerit>(),
          works<Message::RollRateMerit>(),
          works<Message::YawRateMerit>(),
          reading(kLatency_s)};
}

dbc::j1939::ACS LinkImuModel::forces(std::size_t imu) {
  using Message = dbc::j1939::ACS;
  const Eigen::Vector3d acceleration =
      (past_[kAfter].place_m[imu] - 2.0 * past_[kOf].place_m[imu] + past_[kBefore].place_m[imu]) /
      (kBetween_s * kBetween_s);
  const double swing_rad = past_[kOf].swing_rad;
  const Eigen::Vector2d ahead(std::cos(swing_rad), std::sin(swing_rad));
  const Eigen::Vector2d in_plane(acceleration.head<2>().dot(ahead),
                                 acceleration.z() + gravity_mps2_);
  const Eigen::Vector2d shown = seen(imu, Rotation::by(-past_[kOf].angle_rad[imu]).apply(in_plane));
  return {reading(acceleration.head<2>().dot(turned(ahead)) + noise(errors_.imu_force_noise_mps2)),
          reading(shown.x() + noise(errors_.imu_force_noise_mps2)),
          reading(shown.y() + noise(errors_.imu_force_noise_mps2)),
          works<Message::LateralMerit>(),
          works<Message::LongitudinalMerit>(),
          works<Message::VerticalMerit>()};
}

}  // namespace graben::plant
