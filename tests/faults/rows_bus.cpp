// SPDX-License-Identifier: Apache-2.0
// Rows 24 to 32: the bus itself, and who is on it when.

#include <algorithm>
#include <deque>
#include <memory>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr std::uint32_t kForeignId = 0x1FFFFF00;

template <class Kind>
void inject_foreign(Rig<Kind>& rig, int count) {
  for (int n = 0; n < count; ++n) {
    CanFrame frame;
    frame.id = kForeignId + static_cast<std::uint32_t>(n % 0x100);
    frame.length = 8;
    rig.bus.inject(frame);
  }
}

template <class Kind>
void babble(Trial<Kind>& trial) {
  auto& rig = trial.work();
  rig.bus.set_babble(0);
  Stop stop{rig.at_us(), {Fault::kTransmitFailed, Fault::kStrokeMissing}, 50 * kMillisecondUs};
  stop.bus_carries = false;
  stop.cure = [&rig] { rig.bus.set_babble(std::nullopt); };
  trial.expect_stop(stop);
}

/// As much as 500 kbit/s can bring.
template <class Kind>
void low_priority_flood(Trial<Kind>& trial) {
  trial.work();
  trial.rig->before_all = [&trial] { inject_foreign(*trial.rig, 75); };
  trial.expect_ignored(500 * kMillisecondUs, 0.0);
}

/// Once, or again and again for up to 300 ms.
template <class Kind>
void bus_off(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const TimeUs until_us = rig.now_us + (trial.odd() ? 0 : trial.any_time(0, 300'000));
  rig.before_ecu = [&rig, until_us] {
    if (rig.now_us <= until_us) {
      rig.ecu_port.set_state(CanPortState::kBusOff);
    }
  };
  trial.expect_stop(
      {rig.now_us, {Fault::kBusOff}, kCycle_us, trial.odd() ? kCycle_us : 0, trial.odd()});
}

/// Nobody acknowledges: the controller is error-passive, and by every second seed its frames reach
/// nobody.
template <class Kind>
void error_passive(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const bool unheard = trial.odd();
  rig.ecu_port.set_state(CanPortState::kErrorPassive);
  if (unheard) {
    rig.tamper = [&rig](CanFrame&, const LoopbackPort* from) { return !rig.from_ecu(from); };
  }
  Stop stop{rig.now_us, {Fault::kBusPassive}, kCycle_us, unheard ? 0 : kCycle_us, !unheard};
  stop.cure = [&rig] {
    rig.tamper = nullptr;
    rig.ecu_port.set_state(CanPortState::kActive);
  };
  trial.expect_stop(stop);
}

template <class Kind>
void interface_down(Trial<Kind>& trial) {
  auto& rig = trial.work();
  rig.ecu_port.set_state(CanPortState::kDown);
  Stop stop{rig.now_us, {Fault::kBusDown}, kCycle_us};
  stop.bus_carries = false;
  stop.cure = [&rig] { rig.ecu_port.set_state(CanPortState::kClosed); };
  trial.expect_stop(stop);
}

/// A full queue for one cycle costs its frames; for two to thirty it stops.
template <class Kind>
void queue_full(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const std::uint32_t before = rig.ecu->dropped();
  TimeUs until_us = rig.now_us;
  rig.before_ecu = [&rig, &until_us] { rig.ecu_port.set_send_fails(rig.now_us <= until_us); };
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  trial.check(rig.ecu->dropped() > before, "the dropped frames are not counted");
  const int cycles = trial.odd() ? 2 : 3 + static_cast<int>(trial.any_of(28));
  until_us = rig.now_us + (cycles - 1) * kCycle_us;
  trial.expect_stop({rig.now_us,
                     {Fault::kTransmitFailed},
                     20 * kMillisecondUs,
                     trial.odd() ? 20 * kMillisecondUs : 0,
                     trial.odd()});
  rig.before_ecu = nullptr;
}

/// A short receive queue that foreign frames fill before ours come: for two cycles, then for good.
template <class Kind>
void receive_overrun(Trial<Kind>& trial) {
  constexpr std::size_t kShortQueue = 24;
  trial.set_queue(kShortQueue);
  auto& rig = trial.work();
  TimeUs until_us = rig.now_us + kCycle_us;
  rig.before_all = [&rig, &until_us] {
    if (rig.now_us <= until_us) {
      inject_foreign(rig, 40);
    }
  };
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  trial.check(rig.ecu_port.overflow_count() > 0, "nothing was lost");
  Stop stop{rig.at_us(), Kind::missing()};
  stop.any.push_back(Fault::kOperatorMissing);
  // Of a body of which some frames come and some do not.
  stop.any.push_back(Fault::kPoseDisagrees);
  stop.detect_us = stop.neutral_us = 50 * kMillisecondUs;
  until_us = rig.now_us + trial.any_time(60'000, 300'000);
  trial.expect_stop(stop);
  rig.before_all = nullptr;
}

/// The controller's cycle hangs; meanwhile frames with enable queue up and the operator lets go.
template <class Kind>
void stale_at_the_controller(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  rig.closing.emplace(false);
  rig.ecu_on = false;
  Stop stop{rig.at_us()};
  rig.run(30 * kMillisecondUs);
  rig.ask(false, Task::kNone);
  rig.run(trial.any_time(30'000, 200'000));
  rig.ecu_on = true;
  stop.any = {Fault::kCycleStalled};
  stop.detect_us = rig.now_us - stop.since_us;
  stop.bus_carries = false;
  stop.latches = false;  // the deadman has been let go already
  trial.expect_stop(stop);
}

template <class Kind>
bool is_command(const CanFrame& frame) {
  const auto& ids = Kind::command_ids();
  return std::find(ids.begin(), ids.end(), frame.id) != ids.end();
}

/// The controller's last commands stay in its CAN controller's queue and come out when the bus is
/// back, one a cycle and in the right order, after the valve side has closed by itself.
template <class Kind>
void stale_at_the_valve(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  auto queue = std::make_shared<std::deque<CanFrame>>();
  rig.tamper = [queue, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (rig.from_ecu(from) && is_command<Kind>(frame)) {
      queue->push_back(frame);
    }
    return !rig.from_ecu(from);
  };
  rig.closing.emplace(false);
  Stop stop{rig.at_us()};
  rig.run(trial.any_time(40'000, 140'000));
  rig.ecu_on = false;
  rig.run(trial.any_time(100'000, 300'000));
  trial.check(!rig.enabled(), "the valve side has not closed");
  rig.tamper = nullptr;
  bool opened = false;
  while (!queue->empty()) {
    for (const TimeUs of_cycle_us = queue->front().stamp_us;
         !queue->empty() && queue->front().stamp_us == of_cycle_us; queue->pop_front()) {
      rig.bus.inject(queue->front());
    }
    rig.step();
    opened = opened || rig.enabled();
  }
  rig.run(20 * kMillisecondUs);
  trial.check(!opened && !rig.enabled(), "the valve side opens on stale frames");
  rig.ecu_on = true;
  stop.any = {Fault::kCycleStalled};
  stop.detect_us = rig.now_us - stop.since_us;
  stop.bus_carries = false;
  trial.expect_stop(stop);
}

template <class Kind>
void reconnect_with_stale_frames(Trial<Kind>& trial) {
  trial.work();
  trial.odd() ? stale_at_the_controller(trial) : stale_at_the_valve(trial);
}

/// The deadman is held and the task is given all the time; either end is powered first.
template <class Kind>
void power_orders(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  rig.ask(true, Kind::kTask);
  if (trial.odd()) {
    rig.machine_on = false;
  } else {
    rig.kill_ecu();
  }
  rig.run(trial.any_time(100'000, kSecondUs));
  rig.machine_on = true;
  if (!rig.ecu) {
    rig.start_ecu();
  }
  trial.expect_refused(ArmBlock::kEnableNotFresh, 1500 * kMillisecondUs, nullptr);
}

}  // namespace

template <class Kind>
Rows<Kind> bus_rows() {
  return {{24, "babbling node, top priority", "N L", babble<Kind>},
          {25, "flood at low priority", "I", low_priority_flood<Kind>},
          {26, "bus-off", "N L", bus_off<Kind>},
          {27, "error-passive, nobody acknowledges", "N L", error_passive<Kind>},
          {28, "interface down or gone", "N L", interface_down<Kind>},
          {29, "ENOBUFS: one cycle; a burst", "I; N L", queue_full<Kind>},
          {30, "receive queue overrun: short; long", "I; N L", receive_overrun<Kind>},
          {31, "reconnect with stale frames queued", "N | N L", reconnect_with_stale_frames<Kind>},
          {32, "machine before or after the controller", "refused", power_orders<Kind>}};
}

template Rows<Excavator> bus_rows();
template Rows<Dozer> bus_rows();

}  // namespace graben::faults
