// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of the simulated machine's run in real time, as JSON: names with their SI units.

#include <nlohmann/json.hpp>

#include "app/runs/plant_runs.hpp"

namespace graben::reports {

[[nodiscard]] nlohmann::ordered_json plant_json(const runs::PlantRunResult& result);
[[nodiscard]] nlohmann::ordered_json plant_json(const runs::GradePlantResult& result);
[[nodiscard]] nlohmann::ordered_json plant_json(const runs::TaskPlantResult& result);

}  // namespace graben::reports
