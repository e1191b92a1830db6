#include "firmware/safety/spool_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double kCycle_s = 0.01;
constexpr double kDeadTimeSpread = 1.3;

int cycles_under_way(const ExcavatorProfile& profile) {
  const double time_s = kDeadTimeSpread * profile.control.dead_time_s + profile.safety.settle_s;
  const double cycles = std::ceil(time_s / kCycle_s);
  return static_cast<int>(std::clamp(cycles, 1.0, double{SpoolWatchState::kMostCycles}));
}

struct Range {
  double least = 0.0;
  double most = 0.0;
};

/// Of the duties of the last `cycles`.
Range sent_range(const SpoolWatchState& state, int cycles, unsigned axis) {
  Range range{1.0, -1.0};
  for (int n = 0; n < cycles; ++n) {
    const int place =
        (state.newest + SpoolWatchState::kMostCycles - n) % SpoolWatchState::kMostCycles;
    const double duty = state.sent[static_cast<unsigned>(place)].duty_ratio[axis];
    range = {std::min(range.least, duty), std::max(range.most, duty)};
  }
  return range;
}

}  // namespace

SpoolWatchResult watch_spools(const ExcavatorProfile& profile, const SpoolWatchState& last,
                              const SentCommand& sent, const ValidInputs& valid) {
  SpoolWatchResult result;
  result.state = last;
  SpoolWatchState& state = result.state;
  state.newest = (last.newest + 1) % SpoolWatchState::kMostCycles;
  state.sent[static_cast<unsigned>(state.newest)] = sent;
  if (valid.faults.has(Fault::kSpoolMissing)) {
    state.wrong_cycles.fill(0);
    state.echo_cycles = 0;
    return result;
  }
  const int cycles = cycles_under_way(profile);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const Range range = sent_range(state, cycles, i);
    const double spool = valid.spool_ratio[i];
    const bool wrong = spool < range.least - profile.safety.spool_tolerance ||
                       spool > range.most + profile.safety.spool_tolerance;
    state.wrong_cycles[i] = wrong ? std::min(last.wrong_cycles[i] + 1, kSpoolWrongCycles) : 0;
    if (state.wrong_cycles[i] >= kSpoolWrongCycles) {
      result.faults.add(Fault::kSpoolStuck);
    }
  }
  state.echo_cycles =
      valid.valve_enabled == sent.enable ? 0 : std::min(last.echo_cycles + 1, kEchoCycles);
  if (state.echo_cycles >= kEchoCycles) {
    result.faults.add(Fault::kValveNotFollowing);
  }
  return result;
}

bool spools_centred(const ExcavatorProfile& profile, const ValidInputs& valid) {
  return std::all_of(valid.spool_ratio.begin(), valid.spool_ratio.end(), [&profile](double spool) {
    return std::abs(spool) <= profile.safety.spool_tolerance;
  });
}

}  // namespace graben
