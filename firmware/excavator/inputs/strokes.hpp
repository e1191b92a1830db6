// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Strokes of the cylinders by whatever the machine measures: encoders, angles of the joints, or
/// IMUs on the links.

#include "firmware/excavator/inputs/inputs.hpp"

namespace graben {

/// Inputs that may be used, with those strokes; `moving`: see validate().
[[nodiscard]] ExcavatorValid validated_strokes(const ExcavatorModel& machine,
                                               const ExcavatorInputs& inputs, const Cycle& cycle,
                                               TimeUs now_us, bool moving, InputState& state);

}  // namespace graben
