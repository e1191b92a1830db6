// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The word that somebody may have meant.

#include <string>
#include <vector>

namespace graben::machines {

/// The one of `words` that fewest slips lead to: a letter too many, too few or wrong, or two
/// neighbours swapped (Damerau 1964, each pair swapped once). Of equals the one that begins
/// alike for longer. Empty where even the nearest is
/// farther away than a slip for every three letters, and two at least.
[[nodiscard]] std::string near_word(const std::string& word, const std::vector<std::string>& words);

/// "; did you mean 'dig'?", or nothing.
[[nodiscard]] std::string near_word_hint(const std::string& word,
                                         const std::vector<std::string>& words);

}  // namespace graben::machines
