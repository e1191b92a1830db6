// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tasks that are said by what is to be made of the ground, in one line: trench, bench, level,
/// slope, truck loading. Dug in layers until their design is met.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

/// Of the table `area`. The cut leads from `far` to `near`, both of the design, with the floor of
/// the bucket clear of it; the bucket is emptied at `dump`.
[[nodiscard]] ProgramRequest read_area(TomlReader& reader, const ExcavatorProfile& profile);

}  // namespace graben::machines
