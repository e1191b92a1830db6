#include "firmware/drives/spool_follow.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
constexpr double kDeadTimeSpread = 1.3;
}  // namespace

double spool_arrives_s(double dead_time_s, double settle_s) {
  return kDeadTimeSpread * dead_time_s + settle_s;
}

bool follow_spool(const SpoolLimits& limits, SpoolState& state, double duty_ratio, bool received,
                  double spool_ratio) {
  state.sent.add(duty_ratio);
  if (!received) {
    state.wrong_cycles = 0;
    return false;
  }
  const CommandHistory::Range range =
      state.sent.range(cycles_under_way(spool_arrives_s(limits.dead_time_s, limits.settle_s)));
  const bool wrong =
      spool_ratio < range.least - limits.tolerance || spool_ratio > range.most + limits.tolerance;
  state.wrong_cycles = wrong ? std::min(state.wrong_cycles + 1, kSpoolWrongCycles) : 0;
  return state.wrong_cycles >= kSpoolWrongCycles;
}

int echo_cycles(int last, bool sent, bool echoed) {
  return echoed == sent ? 0 : std::min(last + 1, kEchoCycles);
}

bool spool_centred(double spool_ratio, double tolerance) {
  return std::abs(spool_ratio) <= tolerance;
}

}  // namespace graben
