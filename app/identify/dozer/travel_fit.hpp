// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How the tracks answer displacements, on the level with nothing before the blade.

#include <vector>

#include "app/identify/dozer/dozer_estimate.hpp"
#include "app/identify/dozer/dozer_log.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::identify {

/// From logs in which the tracks ran; not known where they did not.
[[nodiscard]] TravelEstimate fit_travel(const std::vector<DozerLog>& logs,
                                        const HstProfile& profile);

}  // namespace graben::identify
