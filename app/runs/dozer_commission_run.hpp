// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Commissioning of a simulated dozer, see led_commission.hpp.

#include <filesystem>

#include "app/commission/dozer_sequence.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/runs/led_commission.hpp"

namespace graben::runs {

/// `log_file`: candump log; none if empty.
[[nodiscard]] CommissionResult run_dozer_commission(const machines::SimulatedDozer& machine,
                                                    const commission::DozerOptions& options,
                                                    const std::filesystem::path& log_file,
                                                    const TakeFrame& take,
                                                    const Progress& progress);

}  // namespace graben::runs
