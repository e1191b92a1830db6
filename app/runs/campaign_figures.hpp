#pragma once
/// From a run's summary to a campaign's row.

#include <limits>
#include <vector>

#include "app/runs/campaign_file.hpp"

namespace graben::runs {

inline constexpr double kMilli = 1e3;
inline constexpr double kPercent = 100.0;

/// A column and where its figure comes from.
template <class Summary>
struct CampaignFigure {
  CampaignColumn column;
  double (*of)(const Summary& summary);
};

template <class Summary>
[[nodiscard]] std::vector<CampaignColumn> columns_of(
    const std::vector<CampaignFigure<Summary>>& figures) {
  std::vector<CampaignColumn> columns;
  for (const CampaignFigure<Summary>& figure : figures) {
    columns.push_back(figure.column);
  }
  return columns;
}

/// A run that did not come to its end has no figures: 0 mm would be the best of all.
template <class Summary>
[[nodiscard]] CampaignRow campaign_row(const std::vector<CampaignFigure<Summary>>& figures,
                                       std::size_t end, const Summary& summary) {
  CampaignRow row;
  row.end = end;
  for (const CampaignFigure<Summary>& figure : figures) {
    row.figure.push_back(row.done() ? figure.of(summary)
                                    : std::numeric_limits<double>::quiet_NaN());
  }
  return row;
}

}  // namespace graben::runs
