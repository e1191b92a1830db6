#include "firmware/excavator/safety/excavator_validation.hpp"

#include <algorithm>

#include "firmware/excavator/swing.hpp"
#include "firmware/hydraulics/flow.hpp"

namespace graben {
namespace {

/// All drives' signals alike: the swing as the travel at its lever, extending to the left.
std::array<DriveInputs, kDriveCount> drive_inputs(const ExcavatorInputs& inputs,
                                                  const SwingProfile& swing) {
  return {inputs.axis[kBoom], inputs.axis[kArm], inputs.axis[kBucket],
          swing_inputs(inputs.swing, swing)};
}

}  // namespace

ExcavatorValid validate(const ExcavatorProfile& profile, DriveRows drives,
                        const ExcavatorInputs& inputs, bool moving, TimeUs now_us,
                        Span<Believed> accepted) {
  ExcavatorValid valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_machine(profile.bus, inputs, {profile.pump[0].rated_speed_radps, profile.safety.idle_radps},
               fresh, now_us, valid);
  read_drives(drives, drive_inputs(inputs, profile.swing), moving, fresh, accepted, valid.drive,
              valid.faults);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    if (profile.bus.swash_feedback) {
      read_required({&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing,
                     Fault::kSensorError},
                    fresh, valid.faults);
    } else {
      valid.swash_ratio[j] = profile.dig_swash_ratio[j];
    }
  }
  sort_faults(moving, {{Fault::kStrokeJump, Fault::kStrokeMissing}}, valid);
  return valid;
}

}  // namespace graben
