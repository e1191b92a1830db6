#include "firmware/safety/spool_watch.hpp"

#include <algorithm>

namespace graben {

SpoolWatchResult watch_spools(const ExcavatorProfile& profile, const SpoolWatchState& last,
                              const SentCommand& sent, const ValidInputs& valid) {
  const SpoolLimits limits{profile.control.dead_time_s, profile.safety.settle_s,
                           profile.safety.spool_tolerance};
  const bool received = !valid.faults.has(Fault::kSpoolMissing);
  SpoolWatchResult result;
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    const SpoolFollowResult spool =
        follow_spool(limits, last.spool[i], sent.duty_ratio[i], received, valid.spool_ratio[i]);
    result.state.spool[i] = spool.state;
    if (spool.stuck) {
      result.faults.add(Fault::kSpoolStuck);
    }
  }
  if (received) {
    result.state.echo_cycles = echo_cycles(last.echo_cycles, sent.enable, valid.valve_enabled);
  }
  if (result.state.echo_cycles >= kEchoCycles) {
    result.faults.add(Fault::kValveNotFollowing);
  }
  return result;
}

bool spools_centred(const ExcavatorProfile& profile, const ValidInputs& valid) {
  const auto* const first = valid.spool_ratio.data();
  return std::all_of(first, first + profile.drive_count, [&profile](double spool) {
    return spool_centred(spool, profile.safety.spool_tolerance);
  });
}

}  // namespace graben
