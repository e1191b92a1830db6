#pragma once
/// Files that a command leaves: whole, or as they were before.

#include <filesystem>
#include <string_view>

namespace graben::cli {

/// Before a minute's work: throws std::runtime_error, naming it, where the file cannot be written.
void assert_writable(const std::filesystem::path& file);

/// Writes beside the file and renames into its place, so that whatever goes wrong, it is either new
/// and complete or what it was. Throws std::runtime_error that names it.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace graben::cli
