// SPDX-License-Identifier: Apache-2.0
/// A dozer's ECU without an operating system.

#include "app/ecu/dozer_kind.hpp"
#include "tests/memory/bare_ecu.hpp"

namespace graben::memory {

void run_image() { run<ecu::DozerKind>(held_setup<DozerSetup>()); }

}  // namespace graben::memory
