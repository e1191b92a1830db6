#include "platform/linux/receive_stamp.hpp"

namespace graben {
namespace {

constexpr TimeUs kMaxAgeUs = kSecondUs;
/// Time synchronisation slews by 500 ppm at most, 5 us a cycle; what is more than this is a step.
constexpr TimeUs kMaxSlewUs = kMillisecondUs;

}  // namespace

void ReceiveStamp::set_now(TimeUs monotonic_us, TimeUs wall_us) {
  const TimeUs slew_us = (wall_us - wall_us_) - (monotonic_us - monotonic_us_);
  if (has_now_ && (slew_us > kMaxSlewUs || slew_us < -kMaxSlewUs)) {
    believed_ = false;
  }
  monotonic_us_ = monotonic_us;
  wall_us_ = wall_us;
  has_now_ = true;
}

TimeUs ReceiveStamp::monotonic_us(TimeUs wall_stamp_us) const {
  const TimeUs age_us = wall_us_ - wall_stamp_us;
  const bool possible = age_us >= 0 && age_us <= kMaxAgeUs;
  return believed_ && possible ? monotonic_us_ - age_us : monotonic_us_;
}

}  // namespace graben
