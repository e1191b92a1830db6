#pragma once
/// A planned line as report and as JSON.

#include <filesystem>
#include <string>
#include <vector>

#include "app/runs/plan_run.hpp"

namespace graben::reports {

/// Both throw std::runtime_error, naming the file, when it can't be written.
void write_plan_report(const std::filesystem::path& file, const machines::ExcavatorMachine& machine,
                       const PlanResult& result, const std::vector<runs::PlanSample>& samples,
                       const std::string& subtitle);
void write_plan_json(const std::filesystem::path& file, const ExcavatorProfile& profile,
                     const PlanResult& result, const std::vector<runs::PlanSample>& samples);

}  // namespace graben::reports
