// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a machine's figures over days ask of its workshop, in plain words.

#include <optional>
#include <string>
#include <vector>

#include "app/identify/drift/day_figures.hpp"
#include "app/identify/drift/trend.hpp"

namespace graben::identify {

/// One figure over all days.
struct FigureDrift {
  Wears what = Wears::kDeadBand;
  std::string part;
  std::vector<DayValue> values;  ///< Of logs that say it.
  Trend trend;
  /// Of the first log with which its change was beyond its noise and large enough to matter; none:
  /// it never was.
  std::optional<double> first_beyond_s;
  bool is_beyond = false;  ///< With the last log.
};

/// Of logs in the order of their times.
[[nodiscard]] std::vector<FigureDrift> drifts_of(const std::vector<DayFigures>& days);

/// "arm: leakage 3.0 times (+- 0.2) that of 2 September 2026; ... look at ..."; of those that are
/// beyond.
[[nodiscard]] std::vector<std::string> work_orders(const std::vector<FigureDrift>& drifts);

/// A row for each figure, from its first day to its last.
[[nodiscard]] std::string drift_table(const std::vector<FigureDrift>& drifts);

/// Every figure of every log, with what was made of it, as JSON.
[[nodiscard]] std::string drift_json(const std::vector<DayFigures>& days,
                                     const std::vector<FigureDrift>& drifts);

/// "2 September 2026".
[[nodiscard]] std::string day_text(double time_s);

}  // namespace graben::identify
