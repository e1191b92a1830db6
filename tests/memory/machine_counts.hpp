// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How many a machine has of what loops of its controller go over, as a table of a TOML file: what
/// a bound of just that machine stands on (tests/bound/machine.py).

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"

namespace graben::memory {

/// [any]: as many as any machine of the kind may have.
void write_most(const ExcavatorSetup& setup);
void write_most(const DozerSetup& setup);

/// [name]: of this one, the most of all of its tasks.
void write_counts(const char* name, const ExcavatorSetup& setup);
void write_counts(const char* name, const DozerSetup& setup);

}  // namespace graben::memory
