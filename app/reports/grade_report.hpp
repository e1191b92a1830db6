#pragma once
/// What a grading run leaves behind: the table, the summary file and the report.

#include <filesystem>
#include <string>

#include "app/runs/grade_run.hpp"

namespace graben::reports {

/// Writes the HTML report. Throws std::runtime_error that names the file.
void write_grade_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                        const machines::SimulatedDozer& machine, const runs::GradeResult& result,
                        const runs::GradeSummary& summary, const std::string& subtitle);

/// Writes the figures as JSON. Throws std::runtime_error that names the file.
void write_grade_summary(const std::filesystem::path& file, const runs::GradeSummary& summary);

/// The short table for a terminal.
[[nodiscard]] std::string grade_table(const runs::GradeSummary& summary);

}  // namespace graben::reports
