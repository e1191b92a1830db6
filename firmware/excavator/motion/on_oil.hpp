// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Boom and arm corrected by the oil's state instead of the servo, as far as it leads.

#include "firmware/excavator/motion/motion.hpp"

namespace graben {

/// Off the dig's path.
void correct_off_path(const ExcavatorModel& machine, const MotionSources& sources,
                      const EstimationState& estimates, double lambda, double speed_override_ratio,
                      Motion& motion);

/// Off a program's plan: what is on its way is part of where they are.
void correct_off_plan(const ExcavatorModel& machine, const MotionSources& sources,
                      const EstimationState& estimates, double lambda, double speed_override_ratio,
                      Motion& motion);

}  // namespace graben
