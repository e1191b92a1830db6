// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A mark of where task files have the machine, by which a later run knows whether it was given the
/// same place again.

#include <cstdint>

#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::ecu {

/// Of the site's points as they lie under the machine, whatever is designed there; without such
/// points of the designs themselves. Never 0.
[[nodiscard]] std::uint32_t site_mark(const TaskBook& book);

}  // namespace graben::ecu
