// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's profile as a file with what was identified in it.

#include <filesystem>
#include <string>
#include <vector>

#include "app/identify/dozer/dozer_fit.hpp"
#include "app/machines/dozer_file.hpp"

namespace graben::identify {

/// A value of the file as it was and as it was found.
struct DozerChange {
  std::string section;
  std::string key;
  std::string before;
  std::string after;
  std::string deviation;  ///< Empty: none is known.

  [[nodiscard]] std::string path() const { return section + "." + key; }
};

/// All of them, in the order of the file's sections.
[[nodiscard]] std::vector<DozerChange> dozer_changes(const machines::DozerMachine& old,
                                                     const DozerEstimate& found);

/// The text of `old`'s file with them, each with its deviation and `from` (log, hash, date) in a
/// comment and in [provenance]. Throws std::runtime_error where a value has no place in the text.
[[nodiscard]] std::string identified_dozer_text(const std::string& old_text,
                                                const std::vector<DozerChange>& changes,
                                                const std::string& from);

/// Throws std::runtime_error unless this text, as that of `file`, is a profile that says what
/// `wanted` says, so far as identification changes it.
void assert_dozer_reads_back(const std::string& text, const std::filesystem::path& file,
                             const DozerProfile& wanted);

}  // namespace graben::identify
