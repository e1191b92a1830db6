#pragma once
/// What a task's run leaves behind: the table, the summary file and the report.

#include <filesystem>
#include <string>
#include <vector>

#include "app/machines/task_file.hpp"
#include "app/runs/autodig_run.hpp"

namespace graben::reports {

/// Writes the HTML report. Throws std::runtime_error that names the file.
void write_autodig_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                          const machines::SimulatedExcavator& machine,
                          const machines::TaskFile& task, const runs::AutodigResult& result,
                          const runs::AutodigSummary& summary, const std::string& subtitle);

/// Writes the figures as JSON. Throws std::runtime_error that names the file.
void write_autodig_summary(const std::filesystem::path& file, const runs::AutodigSummary& summary);

/// The short table for a terminal.
[[nodiscard]] std::string autodig_table(const runs::AutodigSummary& summary);

}  // namespace graben::reports
