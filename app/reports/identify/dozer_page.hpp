// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What identification found of a dozer, as one HTML page that opens without a network.

#include <string>
#include <vector>

#include "app/identify/dozer/dozer_fit.hpp"
#include "app/identify/dozer/dozer_text.hpp"
#include "app/machines/dozer_file.hpp"

namespace graben::reports {

struct DozerReport {
  const machines::DozerMachine& machine;  ///< With the old profile.
  const DozerProfile& found;              ///< With the new one.
  const identify::DozerEstimate& estimate;
  const std::vector<identify::DozerChange>& changes;
  const identify::DozerScore& before;
  const identify::DozerScore& after;
  std::string from;  ///< Logs with their hashes, date.
};

[[nodiscard]] std::string dozer_page(const DozerReport& report);

}  // namespace graben::reports
