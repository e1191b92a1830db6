#pragma once
/// What a digging run leaves behind: the table, the summary file and the report.

#include <filesystem>
#include <string>

#include "app/runs/dig_run.hpp"

namespace graben::reports {

/// Writes the HTML report. Throws std::runtime_error that names the file.
void write_dig_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                      const machines::SimulatedExcavator& machine, const runs::DigResult& result,
                      const runs::DigSummary& summary, const std::string& subtitle);

/// Writes the figures as JSON. Throws std::runtime_error that names the file.
void write_dig_summary(const std::filesystem::path& file, const runs::DigSummary& summary);

/// The short table for a terminal.
[[nodiscard]] std::string dig_table(const runs::DigSummary& summary);

}  // namespace graben::reports
