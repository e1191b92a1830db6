#pragma once
/// What a planned line or task has to say, as text for a reader.

#include <string>

#include "firmware/excavator/tasks/line_plan.hpp"
#include "firmware/excavator/tasks/task_program.hpp"

namespace graben::machines {

/// Why the machine can't be there: whose joint, and by how much where that is known.
[[nodiscard]] std::string blind_words(const ExcavatorGeometry& geometry, const BlindSpot& blind);

/// Where it is of what, a "line" or a "step".
[[nodiscard]] std::string place_words(const BlindPlace& place, const char* of_what);

/// Why there is no plan, and for a blind spot where on the line it begins. Without a full stop.
[[nodiscard]] std::string refusal_words(const ExcavatorGeometry& geometry,
                                        const PlanResult& result);

/// What made the plan slower than it was asked for; "none" if nothing did.
[[nodiscard]] std::string plan_limit_words(const PlanResult& result);

/// "the swing would leave its range, -3 .. 3 rad", as a task's refusal has it.
[[nodiscard]] std::string swing_end_words(const SwingProfile& swing);

/// As in a task file: "dig", "lift", ...
[[nodiscard]] const char* step_name(StepKind kind);

/// Why there is no program: which step, whose joint or which fence, and where. Without a full stop.
[[nodiscard]] std::string program_refusal_words(const ExcavatorProfile& profile,
                                                const ProgramRequest& request,
                                                const ProgramResult& result);

}  // namespace graben::machines
