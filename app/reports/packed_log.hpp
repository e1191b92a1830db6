#pragma once
/// A log as a report carries it.

#include <filesystem>
#include <string>
#include <string_view>

namespace graben::reports {

/// gzip (RFC 1952) in base64 (RFC 4648, with padding): what a browser unpacks by itself. Throws
/// std::runtime_error where zlib has no memory left.
[[nodiscard]] std::string packed(std::string_view text);

/// The same of a file's bytes. Throws std::runtime_error, naming it, where it cannot be read.
[[nodiscard]] std::string packed_file(const std::filesystem::path& file);

}  // namespace graben::reports
