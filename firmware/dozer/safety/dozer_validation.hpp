// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's signals -> machine state: freshness, validity and plausibility, from one table.

#include <array>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/safety/tuning.hpp"
#include "firmware/dozer/travel/course.hpp"
#include "firmware/drives/drive_validation.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// A coordinate of the body and its rate; a rate is believed with its coordinate.
struct BelievedCoordinate {
  Believed value;
  Signal<double> rate;
};

/// State of the validation from cycle to cycle.
struct DozerValidationState {
  std::array<AcceptedStroke, kBladeCount> stroke_m;
  BelievedCoordinate position_m;
  BelievedCoordinate height_m;
  BelievedCoordinate pitch_rad;
  BelievedCoordinate roll_rad;  ///< Of a machine whose blade tilts.
  BelievedCoordinate offset_m;  ///< Of a track that curves, as the next.
  BelievedCoordinate heading_rad;
};

/// Inputs that may be used.
struct DozerValid : CommonValid {
  std::array<ValidDrive, kBladeCount> drive{};  ///< Lift and tilt; no load is known.
  double position_m = 0.0;
  double height_m = 0.0;
  double pitch_rad = 0.0;
  double velocity_mps = 0.0;
  double climb_mps = 0.0;
  double pitch_rate_radps = 0.0;
  double roll_rad = 0.0;  ///< 0 where the blade has no tilt, as the next.
  double roll_rate_radps = 0.0;
  Course course;  ///< 0 where the track is straight.
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio{};
  std::array<double, kTrackCount> track_speed_mps{};
  std::array<double, kTrackCount> line_pressure_pa{};  ///< 0 where nobody tells it.
  DozerTry tried;                                      ///< Only of Task::kCommission.
  std::array<StrokeWindow, kTriedCount> window{};      ///< The same; without one, as constructed.
  /// Neither its displacements nor the body say what its sensor does, see watch_transmission().
  std::array<bool, kTrackCount> track_outvoted{};

  /// Nothing is tried.
  [[nodiscard]] bool hands_rest() const { return tried.ratio == 0.0; }
  [[nodiscard]] const ValidDrive& blade() const { return drive[kBladeLift]; }
  [[nodiscard]] const ValidDrive& tilt() const { return drive[kBladeTilt]; }
};

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its cylinders can, or a coordinate that is not where its rate
/// takes it, is rejected: the last one ages until it is missing, or the signal comes back to it.
/// `state` goes on by a cycle.
[[nodiscard]] DozerValid validate(const DozerProfile& profile, DriveRows drives,
                                  const DozerInputs& inputs, bool moving, TimeUs now_us,
                                  DozerValidationState& state);

}  // namespace graben
