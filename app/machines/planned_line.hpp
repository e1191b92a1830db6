// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One straight line, planned as a task that has no other step.

#include <string>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"

namespace graben::machines {

/// Why a task of this line alone is refused, in the task's words: whose joint or which range, and
/// where on the line. Without a full stop; empty if it can be done.
[[nodiscard]] std::string line_refusal(const ExcavatorProfile& profile, const LineRequest& line);

}  // namespace graben::machines
