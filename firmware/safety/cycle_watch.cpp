#include "firmware/safety/cycle_watch.hpp"

#include <algorithm>

namespace graben {
namespace {

/// A stalled cycle must not turn into one large step of a rate limit.
constexpr double kLongestPeriod_s = 0.02;
/// Without a cycle for this long, what the machine did meanwhile is not known.
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
/// A cycle that comes later than this after the last one is an overrun.
constexpr TimeUs kLate_us = 15 * kMillisecondUs;

}  // namespace

CycleWatchResult watch_cycle(const CycleState& last, TimeUs now_us) {
  const TimeUs elapsed_us = last.has_stepped ? now_us - last.last_us : 0;
  CycleWatchResult result;
  result.elapsed_s = static_cast<double>(std::clamp<TimeUs>(elapsed_us, 0, kStalled_us)) * 1e-6;
  result.period_s = std::min(result.elapsed_s, kLongestPeriod_s);
  result.state = {now_us, elapsed_us > kLate_us ? std::min(last.late_cycles + 1, 2) : 0, true};
  if (elapsed_us > kStalled_us) {
    result.fault = Fault::kCycleStalled;
  } else if (result.state.late_cycles >= 2) {
    result.fault = Fault::kCycleOverrun;
  }
  return result;
}

}  // namespace graben
