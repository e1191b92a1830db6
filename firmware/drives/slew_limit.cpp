#include "firmware/drives/slew_limit.hpp"

#include <algorithm>
#include <cmath>

namespace graben {

double limited(double wanted, double last, double change_max) {
  const double open = std::max(0.0, std::signbit(wanted) ? -last : last);  // on wanted's side
  const double limit = open + change_max;
  return std::clamp(wanted, -limit, limit);
}

double spool_duty(const MonotoneTable& opening_to_duty, double threshold, double opening) {
  if (opening != 0.0 && std::abs(opening) >= threshold) {
    return std::copysign(std::clamp(opening_to_duty.at(std::abs(opening)), 0.0, 1.0), opening);
  }
  return 0.0;
}

}  // namespace graben
