#pragma once
/// What a grading run leaves behind: the table, the summary file and the report.

#include <filesystem>
#include <string>

#include "app/runs/grade_run.hpp"

namespace graben::cli {

/// Writes the HTML report. Throws std::runtime_error that names the file.
void write_grade_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                        const machines::DozerMachine& machine, const GradeResult& result,
                        const GradeSummary& summary, const std::string& subtitle);

/// Writes the figures as JSON. Throws std::runtime_error that names the file.
void write_grade_summary(const std::filesystem::path& file, const GradeSummary& summary);

/// The short table for a terminal.
[[nodiscard]] std::string grade_table(const GradeSummary& summary);

}  // namespace graben::cli
