#include "firmware/drives/spool_watch.hpp"

#include <algorithm>

namespace graben {

FaultSet watch_spools(const ExcavatorProfile& profile, SpoolWatchState& state,
                      const SentCommand& sent, const ValidInputs& valid) {
  const SpoolLimits limits{profile.control.dead_time_s, profile.safety.settle_s,
                           profile.safety.spool_tolerance};
  const bool received = !valid.faults.has(Fault::kSpoolMissing);
  FaultSet faults;
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    if (profile.bus.spool_feedback &&
        follow_spool(limits, state.spool[i], sent.duty_ratio[i], received, valid.spool_ratio[i])) {
      faults.add(Fault::kSpoolStuck);
    }
  }
  state.echo_cycles = received && profile.bus.valve_echo
                          ? echo_cycles(state.echo_cycles, sent.enable, valid.valve_enabled)
                          : 0;
  if (state.echo_cycles >= kEchoCycles) {
    faults.add(Fault::kValveNotFollowing);
  }
  return faults;
}

bool spools_centred(const ExcavatorProfile& profile, const ValidInputs& valid) {
  if (!profile.bus.spool_feedback) {
    return true;
  }
  const auto* const first = valid.spool_ratio.data();
  return std::all_of(first, first + profile.drive_count, [&profile](double spool) {
    return spool_centred(spool, profile.safety.spool_tolerance);
  });
}

}  // namespace graben
