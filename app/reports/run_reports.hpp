// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Results of a run for its reader: the report, one HTML page, and the figures as JSON. All throw
/// std::runtime_error that names the file where it can't be written.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/machines/task_file.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/plan_run.hpp"

namespace graben::reports {

/// File of a report, and the page (scope_page()) that it is made of.
struct ReportTarget {
  std::filesystem::path file;
  std::string_view page;
};

/// The reports of runs have the frames of `log_file` inside.
void write_dig_report(const ReportTarget& target, const std::filesystem::path& log_file,
                      const machines::SimulatedExcavator& machine, const runs::DigResult& result,
                      const runs::DigSummary& summary, const std::string& subtitle);
void write_grade_report(const ReportTarget& target, const std::filesystem::path& log_file,
                        const machines::SimulatedDozer& machine, const runs::GradeResult& result,
                        const runs::GradeSummary& summary, const std::string& subtitle);
void write_autodig_report(const ReportTarget& target, const std::filesystem::path& log_file,
                          const machines::SimulatedExcavator& machine,
                          const machines::TaskFile& task, const runs::AutodigResult& result,
                          const runs::AutodigSummary& summary, const std::string& subtitle);
void write_plan_report(const ReportTarget& target, const machines::ExcavatorMachine& machine,
                       const PlanResult& result, const std::vector<runs::PlanSample>& samples,
                       const std::string& subtitle);
/// Of a whole task.
void write_task_plan_report(const ReportTarget& target, const machines::ExcavatorMachine& machine,
                            const machines::TaskFile& task,
                            const std::vector<runs::PlanSample>& samples,
                            const std::string& subtitle);

/// Figures by their names, in SI units.
void write_summary(const std::filesystem::path& file, const runs::RunFigures& figures);
/// The same, with a list of the steps as they were done, and the places of an area as it was built
/// (`built_map`, see runs::BuiltPlace; empty without one).
void write_autodig_summary(const std::filesystem::path& file, const runs::AutodigSummary& summary);
void write_plan_json(const std::filesystem::path& file, const ExcavatorProfile& profile,
                     const PlanResult& result, const std::vector<runs::PlanSample>& samples);
/// `Task` of the page, as it is planned.
void write_task_plan_json(const std::filesystem::path& file, const machines::TaskFile& task,
                          const ExcavatorProfile& profile);

}  // namespace graben::reports
