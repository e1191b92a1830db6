// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a planned line or task has to say, as text for a reader.

#include <string>

#include "firmware/excavator/motion/program/line_plan.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

/// Why the machine can't be there: whose joint, and by how much where that is known.
[[nodiscard]] std::string blind_words(const ExcavatorGeometry& geometry, const BlindSpot& blind);

/// Where it is of what, a "line" or a "step".
[[nodiscard]] std::string place_words(const BlindPlace& place, const char* of_what);

/// What made the plan slower than it was asked for; "none" if nothing did.
/// Of a program's fences, as their file counts them: "fence[2], the wall"; after them comes "the
/// design surface".
[[nodiscard]] std::string fence_name(const ProgramRequest& request, int fence);

[[nodiscard]] std::string plan_limit_words(const PlanResult& result);

/// As in a task file: "dig", "lift", ...
[[nodiscard]] const char* step_name(StepKind kind);

/// What ends a step: "end", "full", "force", "plane".
[[nodiscard]] const char* until_name(UntilKind kind);

/// Why there is no program: whose joint or which fence, and where on the step, which is called
/// `of_what` ("step" or "line"). Without a full stop.
[[nodiscard]] std::string refusal_words_of(const char* of_what, const ExcavatorProfile& profile,
                                           const ProgramRequest& request,
                                           const ProgramResult& result);

/// The same, after which step it is.
[[nodiscard]] std::string program_refusal_words(const ExcavatorProfile& profile,
                                                const ProgramRequest& request,
                                                const ProgramResult& result);

/// What planning has raised to keep the design's clearance, a line each with how far and where;
/// empty without any. Not of a dig in layers, whose line nobody has written.
[[nodiscard]] std::string raised_text(const ProgramRequest& request, const ProgramResult& result);

/// The most that a dig of steps was raised by, m.
[[nodiscard]] double most_raised_m(const ProgramRequest& request, const ProgramResult& result);

}  // namespace graben::machines
