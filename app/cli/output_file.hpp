// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files that a command leaves: whole, or as they were before.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace graben::cli {

/// Every file that a command writes may be in a folder that is not there yet: makes it. An empty
/// name is none. Throws std::runtime_error, naming the file.
void make_folder_of(const std::filesystem::path& file);

/// Before a minute's work: makes the file's folder, and throws std::runtime_error, naming it, where
/// the file cannot be written.
void assert_writable(const std::filesystem::path& file);

/// Throws std::runtime_error, naming both, where a file that is to be written is one of those that
/// are read, or is written already. Names that are empty are none.
void assert_apart(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Writes beside the file and renames into its place, so that whatever goes wrong, it is either new
/// and complete or what it was. Throws std::runtime_error that names it.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace graben::cli
