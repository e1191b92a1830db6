// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much of a profile that `graben new-machine` made is its own, by the comment at each value.

#include <optional>
#include <string>

namespace graben::machines {

/// Numbers of values.
struct Origin {
  std::string like;  ///< The profile that it was made after, such as "dozer_9t".
  int own = 0;       ///< Told, or what told values give.
  int scaled = 0;    ///< Of the other machine, scaled by what was told.
  int kept = 0;      ///< As in the other machine.
};

/// None of a text that was not made so.
[[nodiscard]] std::optional<Origin> origin_of(const std::string& profile_text);

/// "of 70 values 65 stand as in dozer_9t, 4 are scaled from its own; told: 1".
[[nodiscard]] std::string origin_text(const Origin& origin);

}  // namespace graben::machines
