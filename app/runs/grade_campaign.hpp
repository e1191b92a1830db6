#pragma once
/// A campaign of grading runs.

#include "app/runs/campaign_file.hpp"
#include "app/runs/grade_run.hpp"

namespace graben::runs {

[[nodiscard]] const CampaignKind& grade_campaign();
[[nodiscard]] CampaignRow grade_campaign_row(const machines::SimulatedDozer& machine,
                                             const GradeResult& result);

}  // namespace graben::runs
