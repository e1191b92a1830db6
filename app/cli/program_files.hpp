// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where `graben` and its programs are: in one folder of a build; of a package `graben` is in bin,
/// they are in libexec/graben beside it.

#include <filesystem>
#include <string>

namespace graben::cli {

/// `graben`, for what a user calls again or is shown. Throws std::runtime_error where it is not
/// there.
[[nodiscard]] std::filesystem::path graben_file();

/// graben-PROGRAM; a path that names nothing where it is not built.
[[nodiscard]] std::filesystem::path program_file(const std::string& program);

}  // namespace graben::cli
