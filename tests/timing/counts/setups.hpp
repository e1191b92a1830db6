// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The machines whose controllers are counted.

#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "tests/timing/counts/trace.hpp"

namespace graben::timing {

/// Of an excavator; the 12 t one has two tasks, truck_by_steps and flatten.
[[nodiscard]] const ExcavatorSetup& excavator_setup(Setup setup);
[[nodiscard]] const DozerProfile& dozer_setup(Setup setup);

}  // namespace graben::timing
