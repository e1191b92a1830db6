// Rows 24 to 32: the bus itself, and who is on it when.

#include <deque>
#include <memory>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr double kLittle_m = 0.004;
constexpr std::uint32_t kForeignId = 0x1FFFFF00;

void inject_foreign(Rig& rig, int count) {
  for (int n = 0; n < count; ++n) {
    CanFrame frame;
    frame.id = kForeignId + static_cast<std::uint32_t>(n % 0x100);
    frame.length = 8;
    rig.bus.inject(frame);
  }
}

void babble(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  rig.bus.set_babble(0);
  Stop stop;
  stop.since_us = rig.at_us();
  stop.any = {Fault::kTransmitFailed, Fault::kStrokeMissing};
  stop.detect_us = 50 * kMillisecondUs;
  stop.bus_carries = false;
  stop.cure = [&rig] { rig.bus.set_babble(std::nullopt); };
  trial.expect_stop(stop);
}

/// As much as 500 kbit/s can bring.
void low_priority_flood(Trial& trial) {
  trial.dig();
  trial.rig->before_all = [&trial] { inject_foreign(*trial.rig, 75); };
  trial.expect_ignored(500 * kMillisecondUs, 0.0);
}

/// Once, or again and again for up to 300 ms.
void bus_off(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  const TimeUs until_us = rig.now_us + (trial.odd() ? 0 : trial.any_time(0, 300'000));
  rig.before_ecu = [&rig, until_us] {
    if (rig.now_us <= until_us) {
      rig.ecu_port.set_state(CanPortState::kBusOff);
    }
  };
  Stop stop;
  stop.since_us = rig.now_us;
  stop.any = {Fault::kBusOff};
  stop.detect_us = kCycle_us;
  stop.bus_carries = trial.odd();
  stop.neutral_us = trial.odd() ? kCycle_us : 0;
  trial.expect_stop(stop);
}

/// Nobody acknowledges: the controller is error-passive, and by every second seed its frames reach
/// nobody.
void error_passive(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  const bool unheard = trial.odd();
  rig.ecu_port.set_state(CanPortState::kErrorPassive);
  if (unheard) {
    rig.tamper = [&rig](CanFrame&, const LoopbackPort* from) { return !rig.from_ecu(from); };
  }
  Stop stop;
  stop.since_us = rig.now_us;
  stop.any = {Fault::kBusPassive};
  stop.detect_us = kCycle_us;
  stop.bus_carries = !unheard;
  stop.neutral_us = unheard ? 0 : kCycle_us;
  stop.cure = [&rig] {
    rig.tamper = nullptr;
    rig.ecu_port.set_state(CanPortState::kActive);
  };
  trial.expect_stop(stop);
}

void interface_down(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  rig.ecu_port.set_state(CanPortState::kDown);
  Stop stop;
  stop.since_us = rig.now_us;
  stop.any = {Fault::kBusDown};
  stop.detect_us = kCycle_us;
  stop.bus_carries = false;
  stop.cure = [&rig] { rig.ecu_port.set_state(CanPortState::kClosed); };
  trial.expect_stop(stop);
}

/// A full queue for one cycle costs its frames; for two to thirty it stops.
void queue_full(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  const std::uint32_t before = rig.ecu->dropped();
  TimeUs until_us = rig.now_us;
  rig.before_ecu = [&rig, &until_us] { rig.ecu_port.set_send_fails(rig.now_us <= until_us); };
  trial.expect_ignored(300 * kMillisecondUs, kLittle_m);
  trial.check(rig.ecu->dropped() > before, "the dropped frames are not counted");
  const int cycles = trial.odd() ? 2 : 3 + static_cast<int>(trial.any_of(28));
  until_us = rig.now_us + (cycles - 1) * kCycle_us;
  Stop stop;
  stop.since_us = rig.now_us;
  stop.any = {Fault::kTransmitFailed};
  stop.detect_us = 20 * kMillisecondUs;
  stop.bus_carries = trial.odd();
  stop.neutral_us = trial.odd() ? 20 * kMillisecondUs : 0;
  trial.expect_stop(stop);
  rig.before_ecu = nullptr;
}

/// A short receive queue that foreign frames fill before ours come: for two cycles, then for good.
void receive_overrun(Trial& trial) {
  constexpr std::size_t kShortQueue = 24;
  trial.set_queue(kShortQueue);
  trial.dig();
  Rig& rig = *trial.rig;
  TimeUs until_us = rig.now_us + kCycle_us;
  rig.before_all = [&rig, &until_us] {
    if (rig.now_us <= until_us) {
      inject_foreign(rig, 40);
    }
  };
  trial.expect_ignored(300 * kMillisecondUs, kLittle_m);
  trial.check(rig.ecu_port.overflow_count() > 0, "nothing was lost");
  Stop stop;
  stop.since_us = rig.at_us();
  stop.any = {Fault::kStrokeMissing, Fault::kSwashMissing, Fault::kSpoolMissing,
              Fault::kOperatorMissing};
  stop.detect_us = stop.neutral_us = 50 * kMillisecondUs;
  until_us = rig.now_us + trial.any_time(60'000, 300'000);
  trial.expect_stop(stop);
  rig.before_all = nullptr;
}

/// The controller's cycle hangs; meanwhile frames with enable queue up and the operator lets go.
void stale_at_the_controller(Trial& trial) {
  Rig& rig = *trial.rig;
  rig.closing.emplace(false);
  rig.ecu_on = false;
  Stop stop;
  stop.since_us = rig.at_us();
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

/// The controller's last commands stay in its CAN controller's queue and come out when the bus is
/// back, one a cycle and in the right order, after the valve side has closed by itself.
void stale_at_the_valve(Trial& trial) {
  Rig& rig = *trial.rig;
  auto queue = std::make_shared<std::deque<CanFrame>>();
  rig.tamper = [queue, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (rig.from_ecu(from) && frame.id == bus::SpoolCommand::kId) {
      queue->push_back(frame);
    }
    return !rig.from_ecu(from);
  };
  rig.closing.emplace(false);
  Stop stop;
  stop.since_us = rig.at_us();
  rig.run(trial.any_time(40'000, 140'000));
  rig.ecu_on = false;
  rig.run(trial.any_time(100'000, 300'000));
  trial.check(!rig.plant.spools_enabled(), "the valve side has not closed");
  rig.tamper = nullptr;
  bool opened = false;
  while (!queue->empty()) {
    rig.bus.inject(queue->front());
    queue->pop_front();
    rig.step();
    opened = opened || rig.plant.spools_enabled();
  }
  rig.run(20 * kMillisecondUs);
  trial.check(!opened && !rig.plant.spools_enabled(), "the valve side opens on stale frames");
  rig.ecu_on = true;
  stop.any = {Fault::kCycleStalled};
  stop.detect_us = rig.now_us - stop.since_us;
  stop.bus_carries = false;
  trial.expect_stop(stop);
}

void reconnect_with_stale_frames(Trial& trial) {
  trial.dig();
  trial.odd() ? stale_at_the_controller(trial) : stale_at_the_valve(trial);
}

/// The deadman is held and the task is given all the time; either end is powered first.
void power_orders(Trial& trial) {
  Rig& rig = *trial.rig;
  rig.ask(true, Task::kDig);
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

Rows bus_rows() {
  return {{24, "babbling node, top priority", "N L", babble},
          {25, "flood at low priority", "I", low_priority_flood},
          {26, "bus-off", "N L", bus_off},
          {27, "error-passive, nobody acknowledges", "N L", error_passive},
          {28, "interface down or gone", "N L", interface_down},
          {29, "ENOBUFS: one cycle; a burst", "I; N L", queue_full},
          {30, "receive queue overrun: short; long", "I; N L", receive_overrun},
          {31, "reconnect with stale frames queued", "N | N L", reconnect_with_stale_frames},
          {32, "machine before or after the controller", "refused", power_orders}};
}

}  // namespace graben::faults
