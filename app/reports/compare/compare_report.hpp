// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two runs over each other in one page: the first one's frames, the second's curves beside them,
/// and the differences.

#include <filesystem>
#include <string>
#include <vector>

#include "app/reports/page_setup.hpp"
#include "app/reports/run_reports.hpp"
#include "app/runs/run_log.hpp"

namespace graben::reports {

/// `first_log` is the file of `first`; `notes` are those of compared_notes(). Its frames go into
/// the page. Both runs begin where their controllers became active. Throws std::runtime_error where
/// the machines are of different kinds, a profile is wrong, or the page cannot be written.
void write_compare_report(const ReportTarget& target, const std::filesystem::path& first_log,
                          const runs::RunLog& first, const runs::RunLog& second,
                          const std::vector<runs::ComparedFigure>& figures,
                          const std::vector<std::string>& notes, const SetupOptions& options);

}  // namespace graben::reports
