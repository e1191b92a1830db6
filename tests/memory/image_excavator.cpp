// SPDX-License-Identifier: Apache-2.0
/// An excavator's ECU without an operating system.

#include "app/ecu/excavator_kind.hpp"
#include "tests/memory/bare_ecu.hpp"

namespace graben::memory {

void run_image() { run<ecu::ExcavatorKind>(held_setup<ExcavatorSetup>()); }

}  // namespace graben::memory
