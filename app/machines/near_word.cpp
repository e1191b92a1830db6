// SPDX-License-Identifier: Apache-2.0
#include "app/machines/near_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace graben::machines {
namespace {

std::size_t slips(const std::string& from, const std::string& to) {
  std::vector<std::vector<std::size_t>> least(from.size() + 1,
                                              std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i) {
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      const std::size_t wrong = from[i - 1] == to[j - 1] ? 0 : 1;
      least[i][j] =
          std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + wrong});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[from.size()][to.size()];
}

std::size_t same_letters(const std::string& from, const std::string& to) {
  const auto end = std::mismatch(
      from.begin(), from.begin() + static_cast<std::ptrdiff_t>(std::min(from.size(), to.size())),
      to.begin());
  return static_cast<std::size_t>(end.first - from.begin());
}

}  // namespace

std::string near_word(const std::string& word, const std::vector<std::string>& words) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& other : words) {
    const std::size_t count = slips(word, other);
    // A word of which no letter is left was not meant.
    const bool is_nearer =
        count < fewest || (count == fewest && !nearest.empty() &&
                           same_letters(word, other) > same_letters(word, nearest));
    if (is_nearer && count < std::max(word.size(), other.size())) {
      fewest = count;
      nearest = other;
    }
  }
  return nearest;
}

std::string near_word_hint(const std::string& word, const std::vector<std::string>& words) {
  const std::string near = near_word(word, words);
  return near.empty() ? near : fmt::format("; did you mean '{}'?", near);
}

}  // namespace graben::machines
