// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Steps of a task file: where each leads, how fast, what ends it, and how often all are done.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

/// `start`, `repeat`, `ground`, the tables `step` and, once the design is known, `rounds`.
void read_steps(TomlReader& reader, const ExcavatorProfile& profile, ProgramRequest& request);
void read_rounds(TomlReader& reader, ProgramRequest& request);

/// A plane that ends a step has to lie on its way: an error where it does not.
void refuse_unmet_planes(TomlReader& reader, const ProgramRequest& request,
                         const TaskProgram& program);

}  // namespace graben::machines
