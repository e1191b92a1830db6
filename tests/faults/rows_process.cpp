// SPDX-License-Identifier: Apache-2.0
// Rows 41 to 48 and 50: the controller's own time and memory, and whom it answers.

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"
#include "tests/unit/firmware/flip_bit.hpp"

namespace graben::faults {
namespace {

/// The controller misses its cycle: the next one comes 20 ms after the last.
template <class Kind>
void miss_a_cycle(Rig<Kind>& rig) {
  rig.ecu_on = false;
  rig.step();
  rig.ecu_on = true;
}

template <class Kind>
void overruns(Trial<Kind>& trial) {
  auto& rig = trial.work();
  miss_a_cycle(rig);
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  Stop stop;
  miss_a_cycle(rig);
  rig.step();
  stop.since_us = rig.at_us();
  miss_a_cycle(rig);
  stop.any = {Fault::kCycleOverrun};
  stop.detect_us = stop.neutral_us = 20 * kMillisecondUs;
  trial.expect_stop(stop);
}

/// Not called for 300 ms: it hangs, or is stopped.
template <class Kind>
void stalls(Trial<Kind>& trial) {
  auto& rig = trial.work();
  rig.closing.emplace(false);
  Stop stop{rig.at_us()};
  rig.ecu_on = false;
  rig.run(300 * kMillisecondUs);
  rig.ecu_on = true;
  stop.any = {Fault::kCycleStalled};
  stop.detect_us = rig.now_us - stop.since_us;
  stop.bus_carries = false;
  trial.expect_stop(stop);
}

/// Started again after 0.2 to 0.6 s, with the deadman held and the task given.
template <class Kind>
void killed(Trial<Kind>& trial) {
  auto& rig = trial.work();
  rig.closing.emplace(false);
  Stop stop{rig.at_us()};
  rig.kill_ecu();
  rig.run(trial.any_time(200'000, 600'000));
  rig.start_ecu();
  rig.run(50 * kMillisecondUs);
  stop.detect_us = rig.now_us - stop.since_us;
  stop.bus_carries = false;
  trial.expect_stop(stop);
}

/// Another profile; or another version of the DBC.
template <class Kind>
void other_identity(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  if (trial.odd()) {
    rig.plant.faults().wrong_identity = true;
  } else {
    rig.tamper = [](CanFrame& frame, const LoopbackPort*) {
      if (frame.id == Kind::Dbc::MachineIdentity::kId) {
        auto message = Kind::Dbc::MachineIdentity::decode(frame.data);
        message.dbc_version.value = Kind::Dbc::kDbcVersion + 1U;
        frame.data = message.encode();
      }
      return true;
    };
  }
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  trial.expect_refused(ArmBlock::kIdentity, 1500 * kMillisecondUs, [&rig] {
    rig.plant.faults().wrong_identity = false;
    rig.tamper = nullptr;
  });
  trial.outcome.codes.add(Fault::kIdentityMismatch);
  trial.check(rig.record.status_named(Fault::kIdentityMismatch, 0) &&
                  rig.record.dm1_named(Fault::kIdentityMismatch, 0, kSecondUs),
              "the mismatch is not on the bus");
}

/// Enable held, or the task given, from power-on; the same after a fault.
template <class Kind>
void not_at_rest(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  constexpr TimeUs kTried_us = 500 * kMillisecondUs;
  switch (trial.seed() % 4) {
    case 0:
      rig.ask(true, Task::kNone);
      trial.expect_refused(ArmBlock::kEnableNotFresh, kTried_us, nullptr);
      return;
    case 1:
      rig.ask(false, Kind::kTask);
      rig.run(300 * kMillisecondUs);
      rig.ask(true, Kind::kTask);
      trial.expect_refused(ArmBlock::kTaskNotAtRest, kTried_us, nullptr);
      return;
    default:
      break;
  }
  trial.work();
  rig.driver.set_silent(true);
  rig.run(200 * kMillisecondUs);
  rig.driver.set_silent(false);
  if (trial.seed() % 4 == 2) {
    trial.expect_refused(ArmBlock::kFaultLatched, kTried_us, nullptr);
    return;
  }
  rig.ask(false, Kind::kTask);
  rig.run(500 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  trial.expect_refused(ArmBlock::kTaskNotAtRest, kTried_us, nullptr);
}

template <class Kind>
void bit_flips(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const auto [memory, size] = Kind::memory(*rig.ecu);
  test::flip_bit_at(memory, trial.any_of(static_cast<unsigned>(8 * size)));
  trial.expect_stop({rig.now_us, {Fault::kMemoryCorrupt}, kCycle_us, kCycle_us});
}

/// A babbling node, the operator silent, and late cycles.
template <class Kind>
void all_at_once(Trial<Kind>& trial) {
  auto& rig = trial.work();
  rig.closing.emplace(false);
  Stop stop{rig.at_us()};
  rig.bus.set_babble(0);
  rig.driver.set_silent(true);
  miss_a_cycle(rig);
  rig.step();
  miss_a_cycle(rig);
  stop.any = {Fault::kTransmitFailed, Fault::kCycleOverrun, Fault::kOperatorMissing,
              Fault::kStrokeMissing};
  stop.detect_us = 60 * kMillisecondUs;
  stop.bus_carries = false;
  stop.cure = [&rig] {
    rig.bus.set_babble(std::nullopt);
    rig.driver.set_silent(false);
  };
  trial.expect_stop(stop);
}

}  // namespace

template <class Kind>
Rows<Kind> process_rows() {
  return {
      {41, "one cycle overruns; two in a row", "I; N L", overruns<Kind>},
      {42, "control thread stalls for 300 ms", "N L", stalls<Kind>},
      {43, "process killed in motion, starts again", "N L", killed<Kind>},
      {44, "process stopped (SIGSTOP): as 42", "N L", stalls<Kind>},
      {45, "wall clock steps", "on the bus of a real kernel: tests/hil", nullptr},
      {46, "profile hash or DBC version differs", "refused", other_identity<Kind>},
      {47, "task or enable not at rest", "refused", not_at_rest<Kind>},
      {48, "bit flips in what is stored", "N L", bit_flips<Kind>},
      {63, "every signal that ends the process", "on the bus of a real kernel: tests/hil", nullptr},
      {50, "24, 2 and 41 together", "N L", all_at_once<Kind>}};
}

template Rows<Excavator> process_rows();
template Rows<Dozer> process_rows();

}  // namespace graben::faults
