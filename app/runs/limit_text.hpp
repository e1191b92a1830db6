#pragma once
/// What holds lambda, in words and in shares of time.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "firmware/core/codes.hpp"

namespace graben::runs {

/// Of a kind's actuators, in the order of their indices.
using ActuatorNames = std::vector<const char*>;
[[nodiscard]] const ActuatorNames& excavator_actuators();
[[nodiscard]] const ActuatorNames& dozer_actuators();

/// "none", "pump flow: Pump 1", "back flow: boom", ...
[[nodiscard]] std::string limit_words(const Limit& limit, const ActuatorNames& actuators);

/// Share of the cycles for each limit, by its words.
using LimitShares = std::vector<std::pair<std::string, double>>;

class LimitCount {
 public:
  explicit LimitCount(const ActuatorNames& actuators) : actuators_(actuators) {}

  void add(const Limit& limit);
  /// "none" first, the others by their words.
  [[nodiscard]] LimitShares shares() const;

 private:
  const ActuatorNames& actuators_;
  std::map<std::string, long> cycles_;
  long all_ = 0;
};

}  // namespace graben::runs
