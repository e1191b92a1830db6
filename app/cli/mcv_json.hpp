// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cases of the MCV optimisation as JSON lines (schema: tests/vectors/README.md).

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "firmware/mcv/optimiser.hpp"

namespace graben::cli {

/// One case: a machine, what its sensors say, and the names for messages.
struct McvCase {
  nlohmann::json id;
  McvMachine machine;
  McvInput input;
};

/// Reads one case. Throws std::runtime_error whose text names the key, the value and what is
/// allowed; a machine or input that passes can be solved.
[[nodiscard]] McvCase parse_mcv_case(const std::string& line);

/// The result of a case as one JSON object.
[[nodiscard]] nlohmann::ordered_json solution_json(const McvCase& mcv_case,
                                                   const McvSolution& solution);

/// "", "pump_flow[j]", "back_flow[i]" or "spool_travel[i]".
[[nodiscard]] std::string limit_name(const Limit& limit);

/// "algorithm1", "connected", "global".
[[nodiscard]] const std::map<std::string, McvPolicy>& policies();

/// The key that is out of any usable range.
[[nodiscard]] std::string defect_text(const McvCheck& check);

/// "ok", "infeasible", "bad_input" or "not_converged".
[[nodiscard]] std::string status_name(SolveStatus status);

}  // namespace graben::cli
