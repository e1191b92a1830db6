#include "firmware/safety/spool_follow.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
constexpr double kDeadTimeSpread = 1.3;
}

SpoolFollowResult follow_spool(const SpoolLimits& limits, const SpoolState& last, double duty_ratio,
                               bool received, double spool_ratio) {
  SpoolFollowResult result{false, {last.sent}};
  result.state.sent.add(duty_ratio);
  if (!received) {
    return result;
  }
  const CommandHistory::Range range = result.state.sent.range(
      cycles_under_way(kDeadTimeSpread * limits.dead_time_s + limits.settle_s));
  const bool wrong =
      spool_ratio < range.least - limits.tolerance || spool_ratio > range.most + limits.tolerance;
  result.state.wrong_cycles = wrong ? std::min(last.wrong_cycles + 1, kSpoolWrongCycles) : 0;
  result.stuck = result.state.wrong_cycles >= kSpoolWrongCycles;
  return result;
}

int echo_cycles(int last, bool sent, bool echoed) {
  return echoed == sent ? 0 : std::min(last + 1, kEchoCycles);
}

bool spool_centred(double spool_ratio, double tolerance) {
  return std::abs(spool_ratio) <= tolerance;
}

}  // namespace graben
