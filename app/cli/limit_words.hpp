#pragma once
/// What holds lambda, in words and in shares of time.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "firmware/core/codes.hpp"

namespace graben::cli {

/// "none", "pump flow: Pump 1", "back flow: boom", ...
[[nodiscard]] std::string limit_words(const Limit& limit);

/// Share of the cycles for each limit, by its name.
using LimitShares = std::vector<std::pair<std::string, double>>;

class LimitCount {
 public:
  void add(const Limit& limit);
  /// "none" first, the others by their names.
  [[nodiscard]] LimitShares shares() const;

 private:
  std::map<std::string, long> cycles_;
  long all_ = 0;
};

}  // namespace graben::cli
