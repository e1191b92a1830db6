#pragma once
/// A campaign of digging runs.

#include "app/runs/campaign_file.hpp"
#include "app/runs/dig_run.hpp"

namespace graben::runs {

[[nodiscard]] const CampaignKind& dig_campaign();
[[nodiscard]] CampaignRow dig_campaign_row(const DigResult& result);

}  // namespace graben::runs
