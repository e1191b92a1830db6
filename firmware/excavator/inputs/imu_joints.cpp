// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/inputs/imu_joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/core/whole.hpp"
#include "firmware/excavator/inputs/tuning.hpp"
#include "firmware/excavator/kinematics/bucket_linkage.hpp"
#include "firmware/excavator/kinematics/tuning.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

/// Middle of the turn in which each joint's angle is taken. [rad; derived: the boom's range is
/// about level, kArmCentre_rad, kBucketCentre_rad]
constexpr std::array<double, kAxisCount> kCentre_rad = {0.0, kArmCentre_rad, kBucketCentre_rad};

Eigen::Vector2d turned_by(const Eigen::Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Acceleration of the end of a vector that turns, against that of its foot.
Eigen::Vector2d acceleration(const Eigen::Vector2d& v, const AngleMotion& motion) {
  return motion.acceleration_radps2 * Eigen::Vector2d(-v.y(), v.x()) -
         motion.rate_radps * motion.rate_radps * v;
}

/// A place on the links: where it is from the boom foot, and how it is accelerated.
struct Place {
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration_mps2 = Eigen::Vector2d::Zero();

  [[nodiscard]] Place plus(const Eigen::Vector2d& on_link_m, const AngleMotion& motion) const {
    const Eigen::Vector2d arm_m = turned_by(on_link_m, motion.angle_rad);
    return {at_m + arm_m, acceleration_mps2 + acceleration(arm_m, motion)};
  }
};

/// In the axes of the link.
AngleReading reading_of(const ImuMount& mount, const ImuInputs& from, double period_s,
                        double angle_rad) {
  const double front = mount.backwards ? -1.0 : 1.0;
  const ImuRates& rates = from.rates.value;
  const ImuForces& forces = from.forces.value;
  const Eigen::Vector2d turning =
      turned_by({front * rates.roll_radps, rates.yaw_radps}, mount.turn_rad);
  return {period_s, front * rates.pitch_radps,
          turned_by({front * forces.longitudinal_mps2, forces.vertical_mps2}, mount.turn_rad),
          turning.dot(turned_by({0.0, 1.0}, -angle_rad))};
}

Validity validity_of(const ImuInputs& imu) {
  return std::min(imu.rates.validity, imu.forces.validity);
}

TimeUs stamp_of(const ImuInputs& imu) { return std::min(imu.rates.stamp_us, imu.forces.stamp_us); }

/// `last`: the reading before, and the bias.
void watch_frozen(const AngleNoise& noise, const LinkAngle& last, const AngleReading& next,
                  const ImuRates& rates, FrozenWatch& watch) {
  const Eigen::Vector2d change_mps2 = next.force_mps2 - last.last.force_mps2;
  const bool same_force = change_mps2.isZero(0.0);
  const bool same_rates = rates.pitch_radps == watch.rates.pitch_radps &&
                          rates.roll_radps == watch.rates.roll_radps &&
                          rates.yaw_radps == watch.rates.yaw_radps;
  watch.rates = rates;
  watch.turned_rad =
      same_force ? watch.turned_rad + (next.rate_radps - last.bias_radps) * next.period_s : 0.0;
  watch.same_forces = same_force ? std::min(watch.same_forces + 1, kImuSameForces) : 0;
  // A gyro without noise may rest while its link is shaken a little.
  const int shaken = change_mps2.norm() > noise.force_mps2 ? 1 : 0;
  watch.same_rates = same_rates ? std::min(watch.same_rates + shaken, kImuSameRates) : 0;
}

/// Takes the newest reading of an IMU, if there is one. True if the link goes on by it.
bool take_reading(const ImuProfile& profile, const AngleNoise& noise, const ImuInputs& imu,
                  std::size_t index, bool at_rest, ImuState& state) {
  const TimeUs stamp_us = stamp_of(imu);
  LinkAngle& link = state.link[index];
  if (validity_of(imu) != Validity::kValid ||
      (stamp_us == state.stamp_us[index] && link.readings > 0)) {
    return false;
  }
  const double said_s = imu.rates.value.latency_s;
  const double latency_s = said_s < 0.0 ? profile.latency_s : said_s;
  const double period_s = as_double(stamp_us - state.stamp_us[index]) / kSecondUs -
                          (latency_s - state.latency_s[index]);
  const AngleReading reading = reading_of(profile.mount[index], imu, period_s, link.angle_rad);
  state.stamp_us[index] = stamp_us;
  state.latency_s[index] = latency_s;
  if (link.readings == 0 || !(period_s > 0.0 && period_s < kImuGapMost_s)) {
    begin_angle(noise, reading, link);
    return false;
  }
  watch_frozen(noise, link, reading, imu.rates.value, state.frozen[index]);
  carry_angle(noise, reading, at_rest, link);
  return link.runs();
}

/// Pin of a link and what it stands on there; `before` is the pin of the link before it.
Place pin_of(const ExcavatorGeometry& geometry, const ImuMount& mount, int axis,
             const Place& before, const AngleMotion& under) {
  if (axis == kBoom) {
    return before;
  }
  if (axis == kArm) {
    return before.plus({geometry.boom_length_m, 0.0}, under);
  }
  return before.plus(mount.on_rocker ? geometry.linkage.rocker_pivot_m
                                     : Eigen::Vector2d(geometry.arm_length_m, 0.0),
                     under);
}

void correct_links(const ExcavatorGeometry& geometry, const ImuProfile& profile,
                   const AngleNoise& noise, const std::array<bool, kImuCount>& is_new,
                   ImuState& state) {
  Place pin;
  const double turning_radps = state.link[kBoom].then.turning_radps;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const ImuMount& mount = profile.mount[axis];
    const AngleMotion none;
    pin = pin_of(geometry, mount, static_cast<int>(axis), pin,
                 axis == 0 ? none : state.link[axis - 1].then);
    if (!is_new[axis]) {
      continue;
    }
    Place sensor = pin.plus(mount.at_m, state.link[axis].then);
    sensor.acceleration_mps2.x() -=
        turning_radps * turning_radps * (geometry.boom_foot_m.x() + sensor.at_m.x());
    watch_gyro(noise, mount.at_m, sensor.acceleration_mps2, state.link[axis]);
    correct_angle(noise, sensor.acceleration_mps2, state.link[axis]);
  }
  if (is_new[kBodyImu]) {
    // It stands where the machine stands, near the swing axis.
    correct_angle(noise, Eigen::Vector2d::Zero(), state.link[kBodyImu]);
  }
}

/// Angle of a link and its error's standard deviation, as of its frame.
JointAngle link_angle(const ImuProfile& profile, const ImuState& state, unsigned index) {
  const double ahead_s = state.latency_s[index];
  return {state.link[index].ahead_rad(ahead_s),
          std::hypot(state.link[index].sd_rad(ahead_s), profile.angle_error_rad)};
}

/// The bucket against the arm where its IMU is on the rocker.
bool through_linkage(const ExcavatorGeometry& geometry, JointAngle& joint) {
  const BucketLinkageSolver linkage(geometry.linkage, geometry.cylinder[kBucket].base_m,
                                    geometry.arm_length_m);
  const LinkageState bucket = linkage.from_rocker(joint.angle_rad);
  joint = {bucket.angle_rad, joint.sd_rad * std::abs(bucket.per_rocker)};
  return bucket.closed;
}

bool find_joints(const ExcavatorKinematics& kinematics, const ImuProfile& profile,
                 const ImuState& state, JointAngles& joints) {
  JointAngle under;
  if (profile.has_body()) {
    under = link_angle(profile, state, kBodyImu);
  }
  bool closed = true;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const JointAngle link = link_angle(profile, state, axis);
    JointAngle& joint = joints.joint[axis];
    joint = {link.angle_rad - under.angle_rad, std::hypot(link.sd_rad, under.sd_rad)};
    if (profile.mount[axis].on_rocker) {
      closed = through_linkage(kinematics.geometry(), joint) && closed;
    }
    joint.angle_rad = wrap_near(joint.angle_rad, kCentre_rad[axis]);
    under = link;
  }
  const StrokeResult strokes = kinematics.strokes_from_joints(
      {joints.joint[0].angle_rad, joints.joint[1].angle_rad, joints.joint[2].angle_rad});
  // An angle at the end of its range is a little beyond it as often as not: the strokes that it
  // would have say how much, and that is for the validation to judge.
  closed = closed && strokes.status != ReachStatus::kNotFinite &&
           strokes.status != ReachStatus::kLinkageOpen && !strokes.strokes_m.isZero(0.0);
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    joints.stroke_m[axis] = strokes.strokes_m[static_cast<int>(axis)];
  }
  return closed;
}

/// Of what the strokes are made of.
Validity worst_validity(const ImuProfile& profile, const ExcavatorInputs& inputs,
                        const ImuState& state) {
  Validity worst = Validity::kValid;
  for (unsigned index = 0; index < kImuCount; ++index) {
    if (profile.mount[index].address == 0) {
      continue;
    }
    const LinkAngle& link = state.link[index];
    worst = std::min(worst, validity_of(inputs.imu[index]));
    const bool strays = std::abs(link.bias_radps) > kImuBiasMost * profile.rate_bias_radps;
    const bool wrong = link.contradicts() || strays || state.frozen[index].is_frozen();
    if (worst == Validity::kValid && wrong) {
      worst = Validity::kError;
    } else if (worst == Validity::kValid &&
               !(link.runs() && link.sd_rad(state.latency_s[index]) < kLinkKnown_rad)) {
      worst = Validity::kNotAvailable;
    }
  }
  return worst;
}

}  // namespace

bool FrozenWatch::is_frozen() const {
  return (same_forces >= kImuSameForces && std::abs(turned_rad) > kImuFrozenTurn_rad) ||
         same_rates >= kImuSameRates;
}

ImuStrokes next_imu_strokes(const ExcavatorKinematics& kinematics, const ImuProfile& profile,
                            const ExcavatorInputs& inputs, bool still, double period_s,
                            ImuState& state) {
  const AngleNoise noise = {profile.rate_noise_radps, profile.rate_bias_radps,
                            profile.force_noise_mps2};
  state.rest_s = still ? std::min(state.rest_s + period_s, kImuRest_s) : 0.0;
  const bool at_rest = state.rest_s >= kImuRest_s;
  std::array<bool, kImuCount> is_new{};
  for (unsigned index = 0; index < kImuCount; ++index) {
    is_new[index] = profile.mount[index].address != 0 &&
                    take_reading(profile, noise, inputs.imu[index], index, at_rest, state);
  }
  correct_links(kinematics.geometry(), profile, noise, is_new, state);
  ImuStrokes result;
  Validity validity = worst_validity(profile, inputs, state);
  if (validity == Validity::kValid) {
    result.joints.known = find_joints(kinematics, profile, state, result.joints);
    validity = result.joints.known ? validity : Validity::kNotAvailable;
  }
  TimeUs stamp_us = stamp_of(inputs.imu[kBoom]);
  for (unsigned index = 0; index < kImuCount; ++index) {
    if (profile.mount[index].address != 0) {
      stamp_us = std::min(stamp_us, stamp_of(inputs.imu[index]));
    }
  }
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    result.stroke_m[axis] = {result.joints.stroke_m[axis], validity, stamp_us};
  }
  return result;
}

}  // namespace graben
