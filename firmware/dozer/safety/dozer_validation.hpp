#pragma once
/// The dozer's signals -> machine state: freshness, validity and plausibility, from one table.

#include <array>

#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/plausibility.hpp"

namespace graben {

/// A coordinate of the body and its rate; a rate is believed with its coordinate.
struct BelievedCoordinate {
  Believed value;
  Signal<double> rate;
};

/// What the validation needs of the last cycle.
struct DozerValidationState {
  Believed blade_stroke_m;
  BelievedCoordinate position_m;
  BelievedCoordinate height_m;
  BelievedCoordinate pitch_rad;
};

/// Inputs that may be used.
struct ValidDozerInputs : CommonValid {
  double blade_stroke_m = 0.0;  ///< Clamped into the blade's range.
  double blade_spool_ratio = 0.0;
  bool valve_enabled = false;
  double position_m = 0.0;
  double height_m = 0.0;
  double pitch_rad = 0.0;
  double velocity_mps = 0.0;
  double climb_mps = 0.0;
  double pitch_rate_radps = 0.0;
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio{};
  std::array<double, kTrackCount> track_speed_mps{};
  double engine_radps = 0.0;  ///< The profile's idle where the measured one is lost.
  DozerValidationState state;
};

/// How far a coordinate may be from where its last value and its measured rate put it: noise,
/// resolution, and what the rate changes within a frame.
inline constexpr double kPositionMargin_m = 0.10;
inline constexpr double kHeightMargin_m = 0.03;
inline constexpr double kPitchMargin_rad = 0.02;
/// And per second since its last frame, m/s or rad/s.
inline constexpr double kRateMargin_ps = 0.5;

/// Beyond this a body lies on its side, or its sensor does.
inline constexpr double kMostPitch_rad = 0.8;

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its cylinders can, or a coordinate that is not where its rate
/// takes it, is not believed: the last one ages until it is missing, or the signal comes back to
/// it.
[[nodiscard]] ValidDozerInputs validate(const DozerInputs& inputs, const DozerProfile& profile,
                                        const DozerValidationState& last, bool moving,
                                        TimeUs now_us);

}  // namespace graben
