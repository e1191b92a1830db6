// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A profile's file with what was identified in it.

#include <filesystem>
#include <string>
#include <vector>

#include "app/identify/machine/judged_fit.hpp"
#include "app/machines/excavator_file.hpp"

namespace graben::identify {

/// The text of `old`'s file with every value that `fit` found, each with a comment above it: the
/// value before, its deviation, `from` (log, hash, date), the error that is left; and with the same
/// in [provenance]. What is not known stays as it is. Throws std::runtime_error where a value has
/// no place in the text.
[[nodiscard]] std::string identified_text(const std::string& old_text,
                                          const machines::ExcavatorMachine& old,
                                          const JudgedFit& fit, const std::string& from);

/// One value as it was and as it was found, for the reader.
struct ValueChange {
  std::string key;
  std::string before;
  std::string after;
  std::string deviation;  ///< Empty: none is known.
};

/// All of them, in the order of the file's sections.
[[nodiscard]] std::vector<ValueChange> value_changes(const machines::ExcavatorMachine& old,
                                                     const JudgedFit& fit);

/// Both say the same of all that identification changes, to the digits that a file has. Else the
/// first key that differs.
[[nodiscard]] std::string first_difference(const ExcavatorProfile& one,
                                           const ExcavatorProfile& other);

/// Throws std::runtime_error unless this text, as that of `file`, is a profile that says what
/// `wanted` says, so far.
void assert_reads_back(const std::string& text, const std::filesystem::path& file,
                       const ExcavatorProfile& wanted);

}  // namespace graben::identify
