// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What identification found, for its reader: text, one HTML page that opens without a network, and
/// JSON.

#include <string>
#include <vector>

#include "app/identify/machine/judged_fit.hpp"
#include "app/machines/excavator_file.hpp"

namespace graben::reports {

/// A profile's prediction and what it is called. `score` has to outlive this.
struct ScoreColumn {
  std::string title;
  const identify::PredictionScore* score = nullptr;
};

/// A row for each drive and direction that moved.
[[nodiscard]] std::string prediction_table(const std::vector<ScoreColumn>& columns);
[[nodiscard]] std::string prediction_json(const std::vector<ScoreColumn>& columns);

struct IdentifyReport {
  const machines::ExcavatorMachine& machine;  ///< With the old profile.
  const identify::JudgedFit& fit;
  const std::vector<identify::MachineLog>& logs;
  std::string from;  ///< Logs with their hashes, date.
};

[[nodiscard]] std::string identify_page(const IdentifyReport& report);
[[nodiscard]] std::string identify_json(const IdentifyReport& report);

}  // namespace graben::reports
