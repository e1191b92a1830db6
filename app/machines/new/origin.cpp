// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/origin.hpp"

#include <fmt/format.h>

#include <sstream>

namespace graben::machines {

std::optional<Origin> origin_of(const std::string& profile_text) {
  // As new_profile.cpp's head has it.
  static const std::string kMade = ": made by `graben new-machine` after ";
  const std::size_t made = profile_text.find(kMade);
  const std::size_t name = made + kMade.size();
  if (made == std::string::npos || profile_text.find('\n') < made) {
    return std::nullopt;
  }
  Origin origin;
  origin.like = profile_text.substr(name, profile_text.find(". ", name) - name);
  std::istringstream lines(profile_text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comment = line.find("  # ");
    if (line.empty() || line.front() == '#' || comment == std::string::npos) {
      continue;
    }
    const std::string from = line.substr(comment + 4);
    if (from == "as " + origin.like) {
      ++origin.kept;
    } else if (from.rfind(origin.like + "'s, ", 0) == 0) {
      ++origin.scaled;
    } else {
      ++origin.own;
    }
  }
  return origin;
}

std::string origin_text(const Origin& origin) {
  return fmt::format("of {} values {} stand as in {}, {} are scaled from its own; told: {}",
                     origin.kept + origin.scaled + origin.own, origin.kept, origin.like,
                     origin.scaled, origin.own);
}

}  // namespace graben::machines
