// SPDX-License-Identifier: Apache-2.0
// Rows 52, 61, 62, 64 and 66: how a machine is run, which looks healthy frame by frame.

#include <algorithm>
#include <cmath>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// Below idle, but for some: cranked, or standing.
template <class Kind>
double not_running_ratio(Trial<Kind>& trial) {
  return trial.any_of(2) == 0 ? 0.0 : 0.35 * trial.random.uniform();
}

/// What moves the machine, 0 .. 1; the blade is left out, whose spool is open and closed by turns
/// about its dead band anyway.
double effort(const ExcavatorOutputs& outputs) {
  const auto duties = Excavator::duties(outputs);
  double most = 0.0;
  for (const double duty : duties) {
    most = std::max(most, std::abs(duty));
  }
  return most;
}
double effort(const DozerOutputs& outputs) { return std::abs(outputs.pump_ratio[kLeft]); }

/// By turns: it stalls in motion, and starts again with the deadman held; it stands from power-on
/// and starts with enable and task given.
template <class Kind>
void engine_stands(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  if (trial.odd()) {
    trial.work();
    rig.plant.faults().engine_ratio = not_running_ratio(trial);
    Stop stop{rig.now_us, {Fault::kEngineStopped}};
    // EEC1 comes every 20 ms.
    stop.detect_us = 30 * kMillisecondUs;
    stop.cure = [&rig] { rig.plant.faults().engine_ratio = 1.0; };
    trial.expect_stop(stop);
    return;
  }
  rig.plant.faults().engine_ratio = not_running_ratio(trial);
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  rig.run(500 * kMillisecondUs);
  trial.check(rig.record.all_neutral(0) && !in_motion(rig.mode()), "it armed without an engine");
  // The engine starts, everything else held: nothing moves.
  rig.plant.faults().engine_ratio = 1.0;
  const TimeUs started_us = rig.now_us;
  rig.run(kSecondUs);
  trial.check(rig.record.all_neutral(started_us) && !in_motion(rig.mode()), "its start moved it");
  rig.plant.faults().engine_ratio = 0.0;
  rig.run(100 * kMillisecondUs);
  trial.expect_refused(ArmBlock::kEngineStopped, 200 * kMillisecondUs,
                       [&rig] { rig.plant.faults().engine_ratio = 1.0; });
}

/// Not called for so many cycles.
template <class Kind>
void miss(Rig<Kind>& rig, int cycles) {
  rig.ecu_on = false;
  for (int n = 0; n < cycles; ++n) {
    rig.step();
  }
  rig.ecu_on = true;
  rig.step();
}

/// Three stalls of 40 ms in 200 ms; or every other cycle 10 ms late; or every fourth.
template <class Kind>
void late_too_often(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  const unsigned kind = static_cast<unsigned>(trial.seed() % 3);
  const int missed = kind == 0 ? 3 : 1;
  const int between = kind == 0 ? 3 : kind == 1 ? 0 : 2;
  const TimeUs within_ms = kind == 0 ? 200 : kind == 1 ? 600 : 1000;
  Stop stop{rig.at_us(), {Fault::kCycleOverrun}, within_ms * kMillisecondUs};
  for (int round = 0; round < 40 && in_motion(rig.mode()); ++round) {
    miss(rig, missed);
    for (int n = 0; n < between + 1 && in_motion(rig.mode()); ++n) {
      rig.step();
    }
  }
  trial.expect_stop(stop);
}

/// One stall of up to 40 ms: nothing.
template <class Kind>
void late_once(Trial<Kind>& trial) {
  miss(*trial.rig, 1 + static_cast<int>(trial.any_of(3)));
  trial.rig->run(300 * kMillisecondUs);
  trial.check(trial.rig->mode() == EcuMode::kActive, "one stall stops it");
}

template <class Kind>
void stalls_in_series(Trial<Kind>& trial) {
  trial.work();
  late_once(trial);
  late_too_often(trial);
}

/// Steps up after steps down of what moves the machine, and the other way round; a step is more
/// than half a dead band within a cycle.
template <class Kind>
int chatter(Rig<Kind>& rig, TimeUs duration_us) {
  constexpr double kStep = 0.1;
  int reversals = 0;
  double last = effort(rig.outputs());
  int direction = 0;
  for (const TimeUs end_us = rig.now_us + duration_us; rig.now_us < end_us;) {
    rig.step();
    const double now = effort(rig.outputs());
    const int step = now > last + kStep ? 1 : now < last - kStep ? -1 : 0;
    reversals += step * direction < 0 ? 1 : 0;
    direction = step != 0 ? step : direction;
    last = now;
  }
  return reversals;
}

constexpr std::uint32_t kNotAvailable16 = 0xFFFF;

/// Any value that is measured or asked for is good and bad by turns, at 50, 25 or 12.5 Hz.
template <class Kind>
void toggles(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const TimeUs half_us = kCycle_us << trial.any_of(3);
  enum class Value { kToggles, kBad, kGood } value = Value::kToggles;
  const auto is_bad = [&rig, &value, half_us] {
    return value == Value::kToggles ? (rig.now_us / half_us) % 2 == 1 : value == Value::kBad;
  };
  using Operator = typename Kind::Dbc::OperatorCommand;
  switch (trial.seed() % 4) {
    case 0:  // The engine's speed is not available.
      rig.tamper = [is_bad](CanFrame& frame, const LoopbackPort*) {
        if (frame.id == Kind::Dbc::EEC1::kId && is_bad()) {
          set_raw<Kind>(frame, Kind::Dbc::EEC1::kEngineSpeed,
                        special_raw(Kind::Dbc::EEC1::kEngineSpeed, kNotAvailable16));
        }
        return true;
      };
      break;
    case 1:  // The operator's share of the speed is all and nothing.
      rig.tamper = [is_bad](CanFrame& frame, const LoopbackPort*) {
        if (frame.id == Operator::kId && is_bad()) {
          auto message = Operator::decode(frame.data);
          message.speed_override_ratio.value = 0.0;
          const std::uint8_t counter = counter_of(frame);
          frame.data = message.encode();
          protect<Kind>(frame, counter);
        }
        return true;
      };
      break;
    case 2:  // The task is there and is not.
      rig.before_all = [&rig, is_bad] { rig.ask(true, is_bad() ? Task::kNone : Kind::kTask); };
      break;
    default: {  // What slows is there and is not; of a machine that has nothing like it, the task.
      if (Kind::slowing().empty()) {
        rig.before_all = [&rig, is_bad] { rig.ask(true, is_bad() ? Task::kNone : Kind::kTask); };
        break;
      }
      const std::uint32_t id = trial.any_sensor(Kind::slowing()).id;
      rig.before_all = [&rig, id, is_bad] { rig.plant.faults().set_silent(id, is_bad()); };
      break;
    }
  }
  // It may be slowed, or stopped once; it may not be moved by turns. What it does anyway with the
  // value bad or good all the time is not of the toggling.
  rig.run(200 * kMillisecondUs);
  const int changes = chatter(rig, 2 * kSecondUs);
  value = Value::kBad;
  rig.run(200 * kMillisecondUs);
  const int bad = chatter(rig, 2 * kSecondUs);
  value = Value::kGood;
  rig.run(200 * kMillisecondUs);
  const int good = chatter(rig, 2 * kSecondUs);
  trial.check(changes <= 8 + 2 * std::max(bad, good),
              std::to_string(changes) + " reversals in 2 s, " + std::to_string(bad) +
                  " with the value bad, " + std::to_string(good) + " good");
  trial.saw("no chatter");
}

/// Another task, or the same after none, with the deadman held: the machine comes to rest before.
template <class Kind>
void task_changes(Trial<Kind>& trial) {
  auto& rig = trial.work();
  // None for some cycles, of which the operator says every second; a kind with one task can change
  // to nothing else.
  rig.ask(true, Task::kNone);
  const TimeUs let_go_us = rig.now_us;
  rig.run(kCycle_us * (3 + static_cast<TimeUs>(trial.any_of(4))));
  rig.ask(true, Kind::kTask);
  auto moved_m = [&rig, before = Kind::places_m(rig.plant.plant())]() mutable {
    const auto now = Kind::places_m(rig.plant.plant());
    double most_m = 0.0;
    for (std::size_t i = 0; i < Kind::kPlaces; ++i) {
      most_m = std::max(most_m, std::abs(now[i] - before[i]));
    }
    before = now;
    return most_m;
  };
  double last_moved_m = 0.0;
  const bool begins = rig.run_until(5 * kSecondUs, [&] {
    const bool active = rig.mode() == EcuMode::kActive;
    last_moved_m = active ? last_moved_m : moved_m();
    return active && rig.now_us > let_go_us + 50 * kMillisecondUs;
  });
  trial.check(begins, "the task does not begin again");
  trial.check(rig.now_us - let_go_us > 200 * kMillisecondUs, "it did not wait for standstill");
  trial.check(last_moved_m < 2e-3, "it moved by " + std::to_string(1e3 * last_moved_m) +
                                       " mm in the cycle before the task began");
  trial.check(!rig.record.any_fault(let_go_us), "a fault is on the bus");
  trial.saw("rest first");
}

/// Something is in the way that nothing moves: said after 2 s, stopped after what the profile says.
template <class Kind>
void does_not_get_on(Trial<Kind>& trial) {
  trial.set_up(Kind::stall_scenery_of(trial.seed()));
  auto& rig = *trial.rig;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  // It has to come there first.
  const bool said = rig.run_until(
      60 * kSecondUs, [&rig] { return rig.outputs().status.faults.has(Fault::kStalling); });
  trial.check(said && rig.mode() == EcuMode::kActive, "it is not said");
  Stop stop{rig.now_us};
  rig.run(kSecondUs);
  trial.check(rig.mode() == EcuMode::kActive, "it stops at once");
  trial.check(rig.record.dm1_named(Fault::kStalling, 0, rig.now_us), "not on the bus");
  stop.any = {Fault::kStalled};
  stop.detect_us = 2 * static_cast<TimeUs>(1e6 * rig.machine.profile.safety.stall_s);
  trial.expect_stop(stop);
}

}  // namespace

template <class Kind>
Rows<Kind> conduct_rows() {
  return {{52, "engine stands, stalls, starts", "N L | refused", engine_stands<Kind>},
          {61, "stalls in series, cycles late by turns", "N L", stalls_in_series<Kind>},
          {62, "an input that toggles", "no chatter", toggles<Kind>},
          {64, "task changed in motion", "rest first", task_changes<Kind>},
          {66, "does not get on", "N L", does_not_get_on<Kind>}};
}

template Rows<Excavator> conduct_rows();
template Rows<Dozer> conduct_rows();

}  // namespace graben::faults
