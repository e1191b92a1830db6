#pragma once
/// What a planned task has to say, in words for a reader.

#include <string>

#include "firmware/excavator/tasks/task_program.hpp"

namespace graben::machines {

/// As in a task file: "dig", "lift", ...
[[nodiscard]] const char* step_name(StepKind kind);

/// Why there is no program: which step, whose joint or which fence, and where. Without a full stop.
[[nodiscard]] std::string program_refusal_words(const ExcavatorProfile& profile,
                                                const ProgramRequest& request,
                                                const ProgramResult& result);

}  // namespace graben::machines
