// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tests/fuzz/dozer_bus.hpp"
#include "tests/fuzz/excavator_bus.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace graben::test {
namespace {
constexpr TimeUs kRecovery_us = 4 * kSecondUs;
constexpr int kStaysCycles = 20;
/// After a longer one the controller throws away what is queued.
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
constexpr std::size_t kMostTaken = 192;

void count(const ScriptedPort& port, bool active) {
  // Looked up once: libFuzzer takes every text that is compared for something to feed.
  static std::uint64_t& cycles = tally("cycles");
  static std::uint64_t& active_cycles = tally("cycles Active");
  static std::uint64_t& received = tally("frames received");
  static std::uint64_t& sent = tally("frames sent");
  ++cycles;
  active_cycles += active ? 1U : 0U;
  received += port.received.size();
  sent += port.sent.size();
}
}  // namespace

template <class Kind>
BusRun<Kind>::BusRun(const typename Kind::Machine& machine)
    : partner(machine.profile, machine.hash, port, kStart_us),
      ecu_(machine.profile, machine.hash, port),
      evidence_(machine.profile, machine.hash),
      rules_(machine.profile) {}

template <class Kind>
std::string BusRun<Kind>::cycle(TimeUs elapsed_us) {
  now_ += elapsed_us;
  partner.run_until(now_);
  port.received.clear();
  port.sent.clear();
  const bool was_active = port.shown == CanPortState::kActive;
  ecu_.step(now_, 0);
  count(port, is_active());
  // More than a cycle takes is thrown away.
  port.received.resize(std::min(port.received.size(), kMostTaken));
  evidence_.note(port.received, elapsed_us > kStalled_us || !was_active, now_);
  BusCycle<Kind> seen;
  seen.now = now_;
  seen.elapsed_us = has_run_ ? elapsed_us : 0;
  seen.bus_active = was_active && port.shown == CanPortState::kActive;
  seen.against_motion = evidence_.against_motion(now_);
  seen.released_us = evidence_.released_us();
  seen.sent = &port.sent;
  seen.outputs = &ecu_.outputs();
  has_run_ = true;
  return rules_.check(seen);
}

template <class Kind>
std::string BusRun<Kind>::recover() {
  port.mend();
  partner.mend();
  partner.hand = {};
  int active = 0;
  for (TimeUs passed_us = 0; passed_us < kRecovery_us; passed_us += kPeriod_us) {
    partner.lead_to_active();
    if (std::string wrong = cycle(kPeriod_us); !wrong.empty()) {
      return wrong;
    }
    active = is_active() ? active + 1 : 0;
    if (active >= kStaysCycles) {
      return "";
    }
  }
  const MachineStatus& status = ecu_.outputs().status;
  return fmt::format("does not recover: mode {}, fault {}, why not armed {:X}",
                     static_cast<int>(status.mode), static_cast<int>(status.fault),
                     status.why_not_armed);
}

template class BusRun<ExcavatorBus>;
template class BusRun<DozerBus>;

}  // namespace graben::test
