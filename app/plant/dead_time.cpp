#include "app/plant/dead_time.hpp"

#include <cmath>
#include <utility>

namespace graben::plant {

DeadTime::DeadTime(double dead_time_s, double step_s)
    : past_(static_cast<std::size_t>(std::lround(dead_time_s / step_s)), 0.0) {}

double DeadTime::step(double value) {
  if (past_.empty()) {
    return value;
  }
  const double delayed = std::exchange(past_[next_], value);
  next_ = next_ + 1 == past_.size() ? 0 : next_ + 1;
  return delayed;
}

}  // namespace graben::plant
