// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files that a run leaves: the report, which is the scope's page with what it shows inside, one
/// HTML file that opens from disk without a network; a log as the report carries it; and JSON.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace graben::reports {

/// `setup` is a `Setup` of app/scope/page/src/model/api.ts, of mode "report" or "plan", and goes
/// into `page`, which has a place for it. A value that is not finite becomes null, and a gap in the
/// plot. The report is written beside `file` and renamed into place, so that whatever goes wrong,
/// `file` is either the complete new report or what it was before. Throws std::runtime_error,
/// naming the file and the reason, when it cannot be written.
void write_report(const std::filesystem::path& file, std::string_view page,
                  const nlohmann::json& setup);

/// Writes figures for other programs. Throws std::runtime_error that names the file.
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& figures);

/// gzip (RFC 1952) in base64 (RFC 4648, with padding), which a browser unpacks by itself. Throws
/// std::runtime_error where zlib has no memory left.
[[nodiscard]] std::string packed(std::string_view text);

/// The same of a file's bytes. Throws std::runtime_error, naming it, where it cannot be read.
[[nodiscard]] std::string packed_file(const std::filesystem::path& file);

}  // namespace graben::reports
