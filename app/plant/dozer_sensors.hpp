// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's sensors: readings of the true state, faults included.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "app/plant/dozer_faults.hpp"
#include "app/plant/dozer_plant.hpp"
#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/node_faults.hpp"
#include "app/plant/random.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"

namespace graben::plant {

/// The stroke comes in steps of its encoder's resolution. With a seed the height also has a
/// constant bias, uniform within the profile's bounds, and each reading of pose, rates and track
/// speeds white noise of the profile's standard deviation; each call is one reading.
class DozerSensorModel {
 public:
  DozerSensorModel(const DozerSensorErrors& errors, std::optional<std::uint64_t> seed);

  [[nodiscard]] double stroke_m(double true_stroke_m) const;
  [[nodiscard]] double position_m(double true_position_m);
  [[nodiscard]] double height_m(double true_height_m);
  [[nodiscard]] double pitch_rad(double true_pitch_rad);
  [[nodiscard]] double velocity_mps(double true_velocity_mps);
  [[nodiscard]] double climb_mps(double true_climb_mps);
  [[nodiscard]] double heading_rad(double true_heading_rad);
  [[nodiscard]] double pitch_rate_radps(double true_pitch_rate_radps);
  [[nodiscard]] double track_speed_mps(double true_track_speed_mps);

 private:
  DozerSensorErrors errors_;
  std::optional<Random> pose_noise_;
  std::optional<Random> track_noise_;
  double height_bias_m_ = 0.0;
};

/// The body as a pose sensor sees it.
struct SensedPose {
  double position_m = 0.0;
  double height_m = 0.0;
  double pitch_rad = 0.0;
  double velocity_mps = 0.0;
  double climb_mps = 0.0;
  double pitch_rate_radps = 0.0;
  double roll_rad = 0.0;
  double roll_rate_radps = 0.0;
  double offset_m = 0.0;  ///< Of a track that curves, as the next.
  double heading_rad = 0.0;
  double yaw_rate_radps = 0.0;
};

/// Of `one` so much, of `other` the rest.
[[nodiscard]] SensedPose between(const SensedPose& one, const SensedPose& other, double share);

/// What the bus is told of stroke, body and tracks. Each is read once a cycle.
class DozerReadings {
 public:
  explicit DozerReadings(const DozerPlantProfile& profile);

  /// A cycle on: the pose sensor takes in where the body is, and tells of where it was; by
  /// `later_ps` seconds a second later than it should, from 0 on.
  void sense(const DozerPlant& plant, double later_ps = 0.0);

  [[nodiscard]] dbc::dozer::BladeStroke stroke(const DozerPlant& plant, const DozerFaults& faults);
  [[nodiscard]] dbc::dozer::BodyPosition position(const PoseFaults& faults);
  [[nodiscard]] dbc::dozer::BodyPitch pitch(const PoseFaults& faults);
  [[nodiscard]] dbc::dozer::BodyVelocity velocity(const PoseFaults& faults);
  /// Of a machine whose blade tilts.
  [[nodiscard]] dbc::dozer::TiltState tilt(const DozerPlant& plant, const DozerFaults& faults);
  /// On a design whose track curves.
  [[nodiscard]] dbc::dozer::BodyCourse course(const PoseFaults& faults);
  [[nodiscard]] dbc::dozer::TrackSpeed tracks(const DozerPlant& plant, const DozerFaults& faults);

 private:
  DozerSensorModel sensors_;
  std::size_t late_cycles_;
  bool started_ = false;
  double later_cycles_ = 0.0;    ///< By a fault.
  std::deque<SensedPose> pose_;  ///< The oldest first.
  SensedPose told_;
  FaultyReading stroke_;
  FaultyReading position_;
  FaultyReading height_;
  FaultyReading pitch_;
  FaultyReading pitch_rate_;
  FaultyReading velocity_;
  FaultyReading climb_;
  FaultyReading tilt_stroke_;
  FaultyReading roll_;
  FaultyReading roll_rate_;
  FaultyReading offset_;
  FaultyReading heading_;
  FaultyReading yaw_rate_;
  std::array<FaultyReading, kTrackCount> track_;
};

}  // namespace graben::plant
