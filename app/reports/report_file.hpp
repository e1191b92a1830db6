#pragma once
/// The report of a run: the scope's page with what it shows inside, one HTML file that opens from
/// disk without a network.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace graben::reports {

/// `setup` is a `Setup` of app/scope/page/src/model/api.ts, of mode "report" or "plan". A value
/// that is not finite becomes null, and a gap in the plot. The report is written beside `file` and
/// renamed into place, so that whatever goes wrong, `file` is either the complete new report or
/// what it was before. Throws std::runtime_error, naming the file and the reason, when it cannot be
/// written.
void write_report(const std::filesystem::path& file, const nlohmann::json& setup);

}  // namespace graben::reports
