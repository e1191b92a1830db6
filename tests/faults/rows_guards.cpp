// SPDX-License-Identifier: Apache-2.0
// Rows 67 to 73: single guards of the safety code, each seen by itself. Others stand behind most of
// them, so that a row which only looks at the outcome stays green without them.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A controller that hears what the rig's does, but for what a row alters.
template <class Kind>
struct Shadow {
  explicit Shadow(const typename Kind::Machine& machine)
      : setup(machine.profile), controller(setup) {}

  typename Kind::Setup setup;
  typename Kind::Controller controller;
  typename Kind::Outputs outputs;

  void step(const typename Kind::Inputs& inputs, TimeUs now_us) {
    outputs = controller.step(inputs, now_us);
  }
};

/// Enable alone is old, while all that comes in the same frame is fresh; or it is not valid.
template <class Kind>
void stale_deadman(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  Shadow<Kind> shadow(rig.machine);
  bool spoils = false;
  const bool old = trial.odd();
  const TimeUs age_us = trial.any_time(50 * kMillisecondUs, 5 * kSecondUs);
  // The rig's controller has stepped by then: of the cycle before.
  rig.before_all = [&] {
    typename Kind::Inputs inputs = rig.ecu->inputs();
    if (spoils && old) {
      inputs.driver.enable.stamp_us -= age_us;
    } else if (spoils) {
      inputs.driver.enable.validity =
          trial.seed() % 4 == 0 ? Validity::kError : Validity::kNotAvailable;
    }
    shadow.step(inputs, rig.at_us());
  };
  trial.work();
  trial.check(shadow.outputs.status.mode == EcuMode::kActive, "the shadow does not follow");
  spoils = true;
  rig.step();
  trial.check(!shadow.outputs.enable && shadow.outputs.status.mode != EcuMode::kActive,
              "still enabled");
  rig.before_all = nullptr;
  trial.saw("N");
}

/// A stroke that no cylinder of this machine has, before arming.
template <class Kind>
void stroke_out_of_range(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  const unsigned axis = trial.any_of(Kind::kAxes);
  plant::StrokeFault& stroke = Kind::axis(rig.plant, axis).stroke;
  const auto plant = [&rig]() -> const auto& { return rig.plant.plant(); };
  constexpr double kLeast_m = 0.02;
  const double beyond_m = kLeast_m + 0.2 * trial.random.uniform();
  stroke.jump_m = Kind::longest_m(plant())[axis] - Kind::strokes_m(plant())[axis] + beyond_m;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  trial.check(rig.outputs().status.faults.has(Fault::kStrokeImplausible), "it is not named");
  trial.outcome.codes.add(Fault::kStrokeImplausible);
  rig.ask(true, Kind::kTask);
  trial.expect_refused(ArmBlock::kStroke, 300 * kMillisecondUs, [&stroke] { stroke = {}; });
}

/// Enable is given by hand; then the operator changes to automatic mode and holds it.
template <class Kind>
void enable_not_fresh(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  rig.run(200 * kMillisecondUs);
  rig.driver.set_schedule({{0, {true, OperatorMode::kManual, Task::kNone, 1.0}}});
  rig.run(trial.any_time(100 * kMillisecondUs, 500 * kMillisecondUs));
  rig.ask(true, Task::kNone);
  rig.run(300 * kMillisecondUs);
  trial.expect_refused(ArmBlock::kEnableNotFresh, 200 * kMillisecondUs, nullptr);
}

/// A stroke that moves with its spool closed is stopped while it has come no further than some
/// centimetres; without the pressures that would tell sooner. Armed, or, every second seed of an
/// excavator, Active with no lever moved.
template <class Kind>
void moves_with_its_spool_closed(Trial<Kind>& trial) {
  const bool jogs = std::is_same_v<Kind, Excavator> && trial.odd();
  if (jogs) {
    trial.rig->driver.set_hands(plant::OperatorHands{});
  }
  auto& rig = trial.arm();
  const unsigned axis = trial.any_of(Kind::kAxes);
  const bool has_pressures = axis < Kind::slowing().size();
  const auto pressures = [&rig, axis, has_pressures](bool silent) {
    if (has_pressures) {
      rig.plant.faults().set_silent(Kind::slowing()[axis].id, silent);
    }
  };
  pressures(true);
  if (jogs) {
    rig.ask(true, Task::kJog);
  }
  rig.run(200 * kMillisecondUs);
  plant::StrokeFault& stroke = Kind::axis(rig.plant, axis).stroke;
  const double drift_mps = 0.02 + 0.06 * trial.random.uniform();
  stroke.drift_mps = trial.any_of(2) == 0 ? drift_mps : -drift_mps;
  constexpr double kMost_m = 0.08;
  Stop stop{rig.at_us(),
            {Fault::kUncommandedMotion, Fault::kWrongDirection, Fault::kMotionImplausible},
            static_cast<TimeUs>(1e6 * kMost_m / drift_mps) + 100 * kMillisecondUs};
  stop.cure = [&stroke, &pressures] {
    stroke = {};
    pressures(false);
  };
  trial.expect_stop(stop);
  trial.outcome.harm = drift_mps * 1e-6 * static_cast<double>(trial.outcome.to_detection_us);
  trial.outcome.harm_unit = "m";
}

/// Frames that waited through a stall are thrown away: after it nothing is younger than it.
template <class Kind>
void queued_through_a_stall(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const TimeUs stalled_us = rig.now_us;
  rig.ecu_on = false;
  rig.run(trial.any_time(100 * kMillisecondUs, 400 * kMillisecondUs));
  rig.ecu_on = true;
  rig.step();
  const auto& inputs = rig.ecu->inputs();
  trial.check(inputs.driver.enable.stamp_us < stalled_us &&
                  inputs.engine_speed_radps.stamp_us < stalled_us &&
                  inputs.valve_enabled.stamp_us < stalled_us,
              "frames that waited are taken for fresh ones");
  trial.check(rig.mode() == EcuMode::kFault, "it goes on");
  trial.saw("N L");
}

/// More frames of a message at once than its sender can have sent, all in order.
template <class Kind>
void too_many_at_once(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  CanFrame last;
  rig.tamper = [&last, id](CanFrame& frame, const LoopbackPort*) {
    last = frame.id == id ? frame : last;
    return true;
  };
  const bool heard = rig.run_until(200 * kMillisecondUs, [&last, id] { return last.id == id; });
  trial.check(heard, "no such frame");
  const auto accepted = [&rig] { return rig.ecu->link().accepted; };
  // What a cycle of it brings otherwise, at most.
  std::uint32_t usual = 0;
  for (int n = 0; n < 100; ++n) {
    const std::uint32_t before = accepted();
    rig.step();
    usual = std::max(usual, accepted() - before);
  }
  constexpr int kBurst = 6;
  const std::uint32_t before = accepted();
  rig.before_ecu = [&] {
    CanFrame next = last;
    for (int n = 0; n < kBurst; ++n) {
      protect<Kind>(next, e2e_next_counter(counter_of(next)));
      trial.check(rig.other_port.send(next), "the bus takes no frame");
    }
  };
  rig.step();
  rig.before_ecu = nullptr;
  // e2e.hpp: two of such a block are accepted, the others are too early.
  constexpr std::uint32_t kMostUsed = 2;
  trial.check(accepted() - before <= usual + kMostUsed, std::to_string(accepted() - before) +
                                                            " accepted in a cycle, usually " +
                                                            std::to_string(usual));
  trial.saw("rejected");
}

/// No real spool opens faster than control.spool_rate, whatever is asked for; three times as fast
/// where it catches up with a duty. No duty rises faster than control.duty_rate, here the slowest
/// that a profile may have: what leads a spool stays far below the usual one.
template <class Kind>
void opens_slowly(Trial<Kind>& trial) {
  typename Kind::Scenery scenery = Kind::scenery_of(trial.seed());
  scenery.machine.profile.control.duty_rate_ps = 10.0;
  trial.set_up(scenery);
  auto& rig = *trial.rig;
  const double first = Kind::first_duty(rig.machine);
  const double most = 3.0 * (1.0 - first) * rig.machine.profile.control.spool_rate_ps * 0.01;
  auto last = Kind::real_spools(rig.plant.plant());
  double fastest = 0.0;
  double steepest = 0.0;
  auto last_duty = Kind::duties(rig.outputs());
  rig.before_all = [&] {
    const auto duty = Kind::duties(rig.outputs());
    const auto now = Kind::real_spools(rig.plant.plant());
    for (unsigned i = 0; i < Kind::kAxes; ++i) {
      // From its middle it crosses the dead band in one step; a reversal begins there.
      const bool reverses = last[i] * now[i] <= 0.0;
      const double from = reverses ? first : std::max(first, std::abs(last[i]));
      fastest = std::max(fastest, std::abs(now[i]) - from);
      const double from_duty = last_duty[i] * duty[i] > 0.0 ? std::abs(last_duty[i]) : 0.0;
      steepest = std::max(steepest, std::abs(duty[i]) - from_duty);
    }
    last = now;
    last_duty = duty;
  };
  trial.work();
  rig.run(3 * kSecondUs);
  rig.before_all = nullptr;
  trial.check(fastest <= most, "a spool opens by " + std::to_string(fastest) + " in a cycle, " +
                                   std::to_string(most) + " is the most");
  trial.check(fastest > 0.02 * most, "nothing has asked for more");
  const double steep = rig.machine.profile.control.duty_rate_ps * 0.01 + 1e-9;
  trial.check(steepest <= steep, "a duty rises by " + std::to_string(steepest) + " in a cycle, " +
                                     std::to_string(steep) + " is the most");
  trial.saw("slow");
}

}  // namespace

template <class Kind>
Rows<Kind> guard_rows() {
  return {{67, "deadman old or not valid, all else fresh", "N", stale_deadman<Kind>},
          {68, "stroke beyond its cylinder, before arming", "refused", stroke_out_of_range<Kind>},
          {69, "enable held from manual into automatic", "refused", enable_not_fresh<Kind>},
          {70, "stroke moves, its spool closed", "N L", moves_with_its_spool_closed<Kind>},
          {71, "frames queued through a stall", "N L", queued_through_a_stall<Kind>},
          {72, "frames faster than their sender", "rejected", too_many_at_once<Kind>},
          {73, "spool rate", "slow", opens_slowly<Kind>}};
}

template Rows<Excavator> guard_rows();
template Rows<Dozer> guard_rows();

}  // namespace graben::faults
