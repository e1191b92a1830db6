// SPDX-License-Identifier: Apache-2.0
#include "app/operate/levers.hpp"

#include <algorithm>
#include <cmath>

namespace graben::operate {
namespace {

bool is_at_rest(const Lever& lever) { return lever.right_ratio == 0.0 && lever.away_ratio == 0.0; }

}  // namespace

bool Levers::are_at_rest() const { return is_at_rest(left) && is_at_rest(right); }

Axes axes_of(const Levers& levers, Task task) {
  const double outward = task == Task::kCoordinated ? 1.0 : -1.0;
  return {-levers.right.away_ratio, outward * levers.left.away_ratio,
          outward * levers.right.right_ratio, -levers.left.right_ratio};
}

double stick_ratio(int raw, const StickRange& range) {
  const double half = 0.5 * (static_cast<double>(range.most) - static_cast<double>(range.least));
  if (half <= 0.0) {
    return 0.0;
  }
  const double middle = static_cast<double>(range.least) + half;
  const double travel = std::clamp((static_cast<double>(raw) - middle) / half, -1.0, 1.0);
  const double dead = std::clamp(static_cast<double>(range.flat) / half, kDeadZone, 0.9);
  const double beyond = std::max(0.0, (std::abs(travel) - dead) / (1.0 - dead));
  const double shaped = (1.0 - kExpo) * beyond + kExpo * beyond * beyond * beyond;
  return std::copysign(shaped, travel);
}

}  // namespace graben::operate
