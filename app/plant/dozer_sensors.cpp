// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_sensors.hpp"

#include <cmath>

namespace graben::plant {
namespace {

/// Between two messages.
constexpr double kCycle_s = 0.01;

double noisy(double value, double deviation, std::optional<Random>& noise) {
  return noise ? value + deviation * noise->normal() : value;
}

}  // namespace

SensedPose between(const SensedPose& one, const SensedPose& other, double share) {
  const auto mean = [&](double SensedPose::*part) {
    return share * one.*part + (1.0 - share) * other.*part;
  };
  return {mean(&SensedPose::position_m),    mean(&SensedPose::height_m),
          mean(&SensedPose::pitch_rad),     mean(&SensedPose::velocity_mps),
          mean(&SensedPose::climb_mps),     mean(&SensedPose::pitch_rate_radps),
          mean(&SensedPose::roll_rad),      mean(&SensedPose::roll_rate_radps),
          mean(&SensedPose::offset_m),      mean(&SensedPose::heading_rad),
          mean(&SensedPose::yaw_rate_radps)};
}

DozerSensorModel::DozerSensorModel(const DozerSensorErrors& errors,
                                   std::optional<std::uint64_t> seed)
    : errors_(errors) {
  if (seed) {
    pose_noise_.emplace(*seed, Draw::kPoseNoise);
    track_noise_.emplace(*seed, Draw::kTrackNoise);
    height_bias_m_ = Random(*seed, Draw::kSensorBias).symmetric(errors.height_bias_m);
  }
}

double DozerSensorModel::stroke_m(double true_stroke_m) const {
  const double resolution = errors_.stroke_resolution_m;
  return resolution > 0.0 ? std::round(true_stroke_m / resolution) * resolution : true_stroke_m;
}

double DozerSensorModel::position_m(double true_position_m) {
  return noisy(true_position_m, errors_.position_noise_m, pose_noise_);
}

double DozerSensorModel::height_m(double true_height_m) {
  return noisy(true_height_m + height_bias_m_, errors_.height_noise_m, pose_noise_);
}

double DozerSensorModel::pitch_rad(double true_pitch_rad) {
  return noisy(true_pitch_rad, errors_.pitch_noise_rad, pose_noise_);
}

double DozerSensorModel::velocity_mps(double true_velocity_mps) {
  return noisy(true_velocity_mps, errors_.velocity_noise_mps, pose_noise_);
}

double DozerSensorModel::climb_mps(double true_climb_mps) {
  return noisy(true_climb_mps, errors_.climb_noise_mps, pose_noise_);
}

double DozerSensorModel::heading_rad(double true_heading_rad) {
  return noisy(true_heading_rad, errors_.heading_noise_rad, pose_noise_);
}

double DozerSensorModel::pitch_rate_radps(double true_pitch_rate_radps) {
  return noisy(true_pitch_rate_radps, errors_.pitch_rate_noise_radps, pose_noise_);
}

double DozerSensorModel::track_speed_mps(double true_track_speed_mps) {
  return noisy(true_track_speed_mps, errors_.track_speed_noise_mps, track_noise_);
}

DozerReadings::DozerReadings(const DozerPlantProfile& profile)
    : sensors_(profile.sensors, profile.sensor_errors ? std::optional(profile.seed) : std::nullopt),
      late_cycles_(
          static_cast<std::size_t>(std::lround(profile.sensors.pose_latency_s / kCycle_s))),
      pose_(1) {}

void DozerReadings::sense(const DozerPlant& plant, double later_ps) {
  pose_.push_back({plant.position_m(), plant.height_m(), plant.pitch_rad(), plant.station_mps(),
                   plant.climb_mps(), plant.pitch_rate_radps(), plant.roll_rad(),
                   plant.roll_rate_radps()});
  if (plant.plan()) {
    pose_.back().offset_m = plant.plan()->offset_m();
    pose_.back().heading_rad = plant.plan()->heading_rad();
    pose_.back().yaw_rate_radps = plant.plan()->yaw_rate_radps();
  }
  later_cycles_ = later_ps == 0.0 ? 0.0 : later_cycles_ + later_ps;
  const auto later = static_cast<std::size_t>(later_cycles_);
  const double share = later_cycles_ - static_cast<double>(later);
  const std::size_t kept = late_cycles_ + later + (share > 0.0 ? 2 : 1);
  // At first it tells of where the body has stood.
  while (pose_.size() > kept || (pose_.size() > 1 && !started_)) {
    pose_.pop_front();
  }
  told_ = share > 0.0 && pose_.size() > 1 ? between(pose_[0], pose_[1], share) : pose_.front();
  started_ = true;
}

dbc::dozer::BladeStroke DozerReadings::stroke(const DozerPlant& plant, const DozerFaults& faults) {
  return {stroke_.show(sensors_.stroke_m(plant.blade_stroke_m()), ReadingFault(faults.stroke))};
}

dbc::dozer::BodyPosition DozerReadings::position(const PoseFaults& faults) {
  return {position_.show(sensors_.position_m(told_.position_m), faults.position),
          height_.show(sensors_.height_m(told_.height_m), faults.height)};
}

dbc::dozer::BodyPitch DozerReadings::pitch(const PoseFaults& faults) {
  return {pitch_.show(sensors_.pitch_rad(told_.pitch_rad), faults.pitch),
          pitch_rate_.show(sensors_.pitch_rate_radps(told_.pitch_rate_radps), faults.pitch_rate)};
}

dbc::dozer::BodyVelocity DozerReadings::velocity(const PoseFaults& faults) {
  return {velocity_.show(sensors_.velocity_mps(told_.velocity_mps), faults.velocity),
          climb_.show(sensors_.climb_mps(told_.climb_mps), faults.climb)};
}

dbc::dozer::TiltState DozerReadings::tilt(const DozerPlant& plant, const DozerFaults& faults) {
  // The unit that measures the pitch measures the roll.
  const double stroke_m = plant.tilt() ? plant.tilt()->stroke_m() : 0.0;
  return {tilt_stroke_.show(sensors_.stroke_m(stroke_m), ReadingFault(faults.tilt_stroke)),
          roll_.show(sensors_.pitch_rad(told_.roll_rad), faults.pose.roll),
          roll_rate_.show(sensors_.pitch_rate_radps(told_.roll_rate_radps), faults.pose.roll_rate)};
}

dbc::dozer::BodyCourse DozerReadings::course(const PoseFaults& faults) {
  // What measures the place along the track measures the one beside it; the unit that measures the
  // pitch turns with the body.
  return {offset_.show(sensors_.position_m(told_.offset_m), faults.offset),
          heading_.show(sensors_.heading_rad(told_.heading_rad), faults.heading),
          yaw_rate_.show(sensors_.pitch_rate_radps(told_.yaw_rate_radps), faults.yaw_rate)};
}

dbc::dozer::TrackSpeed DozerReadings::tracks(const DozerPlant& plant, const DozerFaults& faults) {
  const auto shown = [&](unsigned track) {
    return track_[track].show(sensors_.track_speed_mps(plant.track_speeds_mps()[track]),
                              faults.path[track].speed);
  };
  const dbc::Physical left = shown(kLeft);
  return {left, shown(kRight)};
}

}  // namespace graben::plant
