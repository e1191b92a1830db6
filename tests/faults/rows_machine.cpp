// SPDX-License-Identifier: Apache-2.0
// Rows 33 to 36 and 80: the machine does not do, or does not show, what it was told.

#include <algorithm>
#include <cmath>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A duty, and a travel, at which a spool is certainly open.
constexpr double kOpen_ratio = 0.3;

template <class Kind>
double duty(const Trial<Kind>& trial, unsigned axis) {
  return Kind::duties(trial.rig->outputs())[axis];
}

/// Against the way that the spool is sent now; either way if it is sent nowhere.
template <class Kind>
double against(Trial<Kind>& trial, unsigned axis, double size) {
  const double sent = duty(trial, axis);
  const bool negative = sent == 0.0 ? trial.any_of(2) == 0 : sent > 0.0;
  return negative ? -size : size;
}

/// One whose spool is open now, begun with a random one.
template <class Kind>
unsigned moving_axis(Trial<Kind>& trial) {
  unsigned axis = trial.any_of(Kind::kAxes);
  const bool moves = trial.rig->run_until(Kind::kOpensWithin_us, [&] {
    for (unsigned n = 0; n < Kind::kAxes; ++n) {
      const unsigned other = (axis + n) % Kind::kAxes;
      const double travel = Kind::spools(trial.rig->plant.plant())[other];
      const double sent = duty(trial, other);
      if (std::min(std::abs(sent), std::abs(travel)) > kOpen_ratio && sent * travel > 0.0) {
        axis = other;
        return true;
      }
    }
    return false;
  });
  trial.check(moves, "no spool opens");
  return axis;
}

/// The pilot valve sticks: somewhere on the other side of neutral; or, by every fourth seed, where
/// it is, which shows when the operator lets go.
template <class Kind>
void spool_stuck(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const unsigned axis = moving_axis(trial);
  auto& faults = Kind::axis(rig.plant, axis);
  Stop stop{rig.at_us(), {Fault::kSpoolStuck}, 250 * kMillisecondUs};
  stop.disobeying = true;
  stop.pilot_cut = true;
  stop.cure = [&faults] { faults.spool_held_ratio.reset(); };
  if (trial.seed() % 4 == 3) {
    faults.spool_held_ratio = Kind::spools(rig.plant.plant())[axis];
    rig.ask(false, Task::kNone);
    stop.latches = false;  // nothing is enabled that could be
  } else {
    faults.spool_held_ratio = against(trial, axis, 0.4 + 0.5 * trial.random.uniform());
  }
  trial.expect_stop(stop);
}

/// A spool opens beyond its command, Active or Armed; or, Armed, a stroke drifts with its spool
/// closed.
template <class Kind>
void moves_uncommanded(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  const unsigned axis = trial.any_of(Kind::kAxes);
  auto& faults = Kind::axis(rig.plant, axis);
  const unsigned kind = static_cast<unsigned>(trial.seed() % 3);
  kind == 0 ? trial.work() : trial.arm();
  Stop stop{rig.at_us()};
  stop.pilot_cut = kind != 2;
  if (kind == 2) {
    faults.stroke.drift_mps = trial.any_of(2) == 0 ? 0.05 : -0.05;
    stop.any = {Fault::kMotionImplausible, Fault::kUncommandedMotion};
    stop.detect_us = 2 * kSecondUs;
    stop.cure = [&faults] { faults.stroke.drift_mps = 0.0; };
  } else {
    faults.spool_offset_ratio = against(trial, axis, 0.4 + 0.3 * trial.random.uniform());
    stop.any = {Fault::kSpoolStuck, Fault::kUncommandedMotion};
    stop.detect_us = 300 * kMillisecondUs;
    stop.disobeying = true;
    stop.cure = [&faults] { faults.spool_offset_ratio = 0.0; };
  }
  trial.expect_stop(stop);
}

template <class Kind>
void stroke_stuck(Trial<Kind>& trial) {
  auto& rig = trial.work();
  plant::StrokeFault& stroke = Kind::axis(rig.plant, moving_axis(trial)).stroke;
  stroke.stuck = true;
  Stop stop{rig.at_us(), {Fault::kStrokeStuck}, Kind::kStuckStroke_us};
  stop.cure = [&stroke] { stroke.stuck = false; };
  trial.expect_stop(stop);
}

/// A spool that is held open goes on as the machine stops. By turns: its valve says nothing any
/// more, or that it does what it is sent, while the operator lets go. True way of its cylinder from
/// the first neutral on.
template <class Kind>
void goes_on_after_the_stop(Trial<Kind>& trial) {
  constexpr double kMostWay_m = 0.12;
  auto& rig = trial.work();
  const unsigned axis = moving_axis(trial);
  auto& faults = Kind::axis(rig.plant, axis);
  faults.spool_held_ratio = Kind::spools(rig.plant.plant())[axis];
  if (trial.odd()) {
    rig.plant.faults().set_silent(Kind::Dbc::ValveState::kId, true);
  } else {
    faults.echoes = true;
    rig.ask(false, Task::kNone);
  }
  const bool neutral = rig.run_until(100 * kMillisecondUs, [&rig] { return !rig.enabled(); });
  trial.check(neutral, "no neutral command");
  const TimeUs stopped_us = rig.now_us;
  const double from_m = Kind::strokes_m(rig.plant.plant())[axis];
  const bool cut = rig.run_until(
      10 * kSecondUs, [&rig, stopped_us] { return rig.record.any_pilot_cut(stopped_us); });
  trial.outcome.to_detection_us = cut ? rig.now_us - stopped_us : -1;
  rig.run(kSecondUs);
  trial.outcome.harm = std::abs(Kind::strokes_m(rig.plant.plant())[axis] - from_m);
  trial.outcome.harm_unit = "m stroke";
  trial.check(trial.outcome.harm <= kMostWay_m,
              "goes on by " + std::to_string(1e3 * trial.outcome.harm) + " mm of its stroke");
  // One that the ground holds goes nowhere.
  trial.check(cut || trial.outcome.harm <= 0.05, "no pilot cut asked for");
  trial.saw("N");
  faults.spool_held_ratio.reset();
  faults.echoes = false;
  rig.plant.faults().set_silent(Kind::Dbc::ValveState::kId, false);
  trial.expect_arms_again();
}

/// For one frame, then for good.
template <class Kind>
void reading_jumps(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const Reading reading = Kind::any_reading(rig.plant, trial.random);
  *reading.offset = reading.jump;
  Slowing slowing{rig.now_us, reading.jumped, kCycle_us, 200 * kMillisecondUs};
  rig.before_ecu = [&reading] { *reading.offset = 0.0; };
  trial.expect_slower(slowing);
  rig.before_ecu = nullptr;
  Stop stop{
      rig.at_us(), {reading.missing, reading.jumped}, 50 * kMillisecondUs, 50 * kMillisecondUs};
  *reading.offset = reading.jump;
  stop.cure = [&reading] { *reading.offset = 0.0; };
  trial.expect_stop(stop);
}

}  // namespace

template <class Kind>
Rows<Kind> machine_rows() {
  return {{33, "spool stuck open against its command", "N L | N", spool_stuck<Kind>},
          {34, "spool or cylinder moves uncommanded", "N L", moves_uncommanded<Kind>},
          {35, "stroke stuck while flow is commanded", "N L", stroke_stuck<Kind>},
          {36, "stroke or pose jumps: one frame; for good", "D; N L", reading_jumps<Kind>},
          {80, "spool stays open after the stop, unseen", "N", goes_on_after_the_stop<Kind>}};
}

template Rows<Excavator> machine_rows();
template Rows<Dozer> machine_rows();

}  // namespace graben::faults
