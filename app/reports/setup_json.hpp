#pragma once
/// What of `Setup` (page/src/model/api.ts) is the same whatever the frames come from.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace graben::reports {

struct SetupOptions {
  /// A profile beside the shipped ones: file or shipped name. Comes first.
  std::optional<std::string> profile;
  /// What the controller was given, by its number: files or shipped names. None: what is shipped
  /// and can be planned on the machine, in the order of the names.
  std::vector<std::string> tasks;
};

/// {"machines": [...], "words": {...}}. Throws std::runtime_error with what is wrong with a profile
/// or a task. Tasks that are told must all fit one machine, with a profile that one.
[[nodiscard]] nlohmann::json shared_setup(const SetupOptions& options);

/// `Words`.
[[nodiscard]] nlohmann::json words_json();

}  // namespace graben::reports
