#pragma once
/// Checks of options that CLI11's own let too much through.

#include <CLI/CLI.hpp>

namespace graben::cli {

/// CLI::Range lets "nan" pass.
[[nodiscard]] CLI::Validator number_between(double least, double most);
/// An unsigned option takes "-1" for its largest value.
[[nodiscard]] CLI::Validator whole_number();

}  // namespace graben::cli
