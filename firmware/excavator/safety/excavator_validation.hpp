#pragma once
/// The excavator's signals -> machine state: freshness, validity and plausibility.

#include "firmware/drives/drive_validation.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// Inputs that may be used; what the machine does not have stays 0. Of the swing motor the left
/// port counts as cap, the right one as rod side.
struct ExcavatorValid : CommonValid {
  std::array<ValidDrive, kDriveCount> drive{};
  std::array<double, kPumpCount> swash_ratio{};
  std::array<double, kPumpCount> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25).

  [[nodiscard]] DriveVector strokes_m() const {
    return {drive[0].stroke_m, drive[1].stroke_m, drive[2].stroke_m, drive[3].stroke_m};
  }
};

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its drive can is rejected: the last one ages until it is
/// missing, or the strokes come back to it. `accepted` keeps that from cycle to cycle. Another
/// machine's swing signals are not looked at.
[[nodiscard]] ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                                      const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                                      Span<Believed> accepted);

}  // namespace graben
