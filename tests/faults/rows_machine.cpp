// Rows 33 to 40 and 49: the machine does not do, or does not show, what it was told.

#include <cmath>

#include "firmware/motion/rounded_rectangle.hpp"
#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A duty that certainly opens its spool.
constexpr double kOpen_ratio = 0.3;

double duty(const Trial& trial, unsigned axis) { return trial.rig->outputs().duty_ratio[axis]; }

/// Against the way that the spool is sent now; either way if it is sent nowhere.
double against(Trial& trial, unsigned axis, double size) {
  const double sent = duty(trial, axis);
  const bool negative = sent == 0.0 ? trial.any_of(2) == 0 : sent > 0.0;
  return negative ? -size : size;
}

/// One whose spool is open now, begun with a random one.
unsigned moving_axis(Trial& trial) {
  unsigned axis = trial.any_of(kAxisCount);
  const bool moves = trial.rig->run_until(6 * kSecondUs, [&] {
    for (unsigned n = 0; n < kAxisCount; ++n) {
      const unsigned other = (axis + n) % kAxisCount;
      if (std::abs(duty(trial, other)) > kOpen_ratio) {
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
void spool_stuck(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  const unsigned axis = moving_axis(trial);
  plant::AxisFaults& faults = rig.plant.faults().axis[axis];
  Stop stop;
  stop.since_us = rig.at_us();
  stop.any = {Fault::kSpoolStuck};
  stop.detect_us = 250 * kMillisecondUs;
  stop.disobeying = true;
  stop.pilot_cut = true;
  stop.cure = [&faults] { faults.spool_held_ratio.reset(); };
  if (trial.seed() % 4 == 3) {
    faults.spool_held_ratio = rig.plant.plant().spool_travels_ratio()[axis];
    rig.ask(false, Task::kNone);
    stop.latches = false;  // nothing is enabled that could be
  } else {
    faults.spool_held_ratio = against(trial, axis, 0.4 + 0.5 * trial.random.uniform());
  }
  trial.expect_stop(stop);
}

/// A spool opens beyond its command, Active or Armed; or, Armed, a stroke drifts with its spool
/// closed.
void moves_uncommanded(Trial& trial) {
  Rig& rig = *trial.rig;
  const unsigned axis = trial.any_of(kAxisCount);
  plant::AxisFaults& faults = rig.plant.faults().axis[axis];
  const unsigned kind = static_cast<unsigned>(trial.seed() % 3);
  kind == 0 ? trial.dig() : trial.arm();
  Stop stop;
  stop.since_us = rig.at_us();
  stop.pilot_cut = true;
  if (kind == 2) {
    faults.stroke.drift_mps = trial.any_of(2) == 0 ? 0.05 : -0.05;
    stop.any = {Fault::kUncommandedMotion};
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

void stroke_stuck(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  plant::StrokeFault& stroke = rig.plant.faults().axis[moving_axis(trial)].stroke;
  stroke.stuck = true;
  Stop stop;
  stop.since_us = rig.at_us();
  stop.any = {Fault::kStrokeStuck};
  stop.detect_us = 3 * kSecondUs;
  stop.cure = [&stroke] { stroke.stuck = false; };
  trial.expect_stop(stop);
}

/// For one frame, then for good.
void stroke_jumps(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  plant::StrokeFault& stroke = rig.plant.faults().axis[trial.any_of(kAxisCount)].stroke;
  const double jump_m = (trial.any_of(2) == 0 ? 1.0 : -1.0) * (0.06 + 0.2 * trial.random.uniform());
  stroke.jump_m = jump_m;
  Slowing slowing;
  slowing.since_us = rig.now_us;
  slowing.fault = Fault::kStrokeJump;
  slowing.detect_us = kCycle_us;
  slowing.hold_us = 200 * kMillisecondUs;
  rig.before_ecu = [&stroke] { stroke.jump_m = 0.0; };
  trial.expect_slower(slowing);
  rig.before_ecu = nullptr;
  Stop stop;
  stop.since_us = rig.at_us();
  stop.any = {Fault::kStrokeMissing, Fault::kStrokeJump};
  stop.detect_us = stop.neutral_us = 50 * kMillisecondUs;
  stroke.jump_m = jump_m;
  stop.cure = [&stroke] { stroke.jump_m = 0.0; };
  trial.expect_stop(stop);
}

void pressure_wrong(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  // Only in motion can a number that stands still be told from a pressure.
  const unsigned axis = trial.odd() ? trial.any_of(kAxisCount) : trial.farthest_axis(8 * kSecondUs);
  plant::AxisFaults& faults = rig.plant.faults().axis[axis];
  // A chamber that is nearly empty may stay at one pressure, and a sensor may show 1.2 MPa less.
  constexpr double kFilled_pa = 3e6;
  const double cap_pa = rig.plant.plant().cap_pressures_pa()[axis];
  const double rod_pa = rig.plant.plant().rod_pressures_pa()[axis];
  const bool any_side = std::min(cap_pa, rod_pa) > kFilled_pa;
  const bool cap = any_side ? trial.any_of(2) == 0 : cap_pa > rod_pa;
  // Before the watch has seen 0.06 m of way, to and fro.
  constexpr double kJudged_m = 0.02;
  plant::PressureFault& pressure = cap ? faults.cap : faults.rod;
  Slowing slowing;
  slowing.since_us = rig.at_us();
  slowing.fault = Fault::kPressureImplausible;
  if (trial.odd()) {
    pressure.rail_pa = rig.machine.profile.safety.pressure_rail_pa;
    slowing.detect_us = 400 * kMillisecondUs;
  } else {
    // Until its cylinder has gone a way of 0.06 m.
    pressure.stuck = true;
    slowing.detect_us = 10 * kSecondUs;
    const double from_m = rig.plant.plant().strokes_m()[axis];
    double moved_m = 0.0;
    const bool judged = rig.run_until(slowing.detect_us - kCycle_us, [&] {
      moved_m = std::max(moved_m, std::abs(rig.plant.plant().strokes_m()[axis] - from_m));
      return moved_m > kJudged_m;
    });
    if (!judged && !rig.outputs().status.faults.has(slowing.fault)) {
      // A pressure stuck high takes lambda down so far that the cylinder hardly moves.
      trial.saw("moved < 0.02 m");
      return;
    }
  }
  slowing.cure = [&pressure] { pressure = {}; };
  trial.expect_slower(slowing);
}

/// A pump's feedback is wrong, or the pump itself.
void swash_wrong(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  plant::PumpFaults& pump = rig.plant.faults().pump[trial.any_of(kPumpCount)];
  const double ratio = trial.any_of(2) == 0 ? 0.3 : 0.95;
  (trial.odd() ? pump.shown_swash_ratio : pump.actual_swash_ratio) = ratio;
  Slowing slowing;
  slowing.since_us = rig.at_us();
  slowing.fault = Fault::kSwashDisagrees;
  slowing.detect_us = 800 * kMillisecondUs;
  slowing.back_us = 1500 * kMillisecondUs;
  slowing.cure = [&pump] { pump = {}; };
  trial.expect_slower(slowing);
}

TipPose pose_at(const RoundedRectangle& path, double share) {
  const PathPoint point = path.at_share(share - std::floor(share));
  return {point.position_m.x(), point.position_m.y(), point.attitude_rad};
}

/// Where on the path a cylinder comes closest to one of its ends.
struct Closest {
  double share = 0.0;
  double left_m = 1e3;
  bool reachable = true;
};

Closest closest_to_an_end(const ExcavatorProfile& profile, const ExcavatorKinematics& kinematics) {
  constexpr int kPoints = 200;
  const RoundedRectangle path(profile.dig_path);
  Closest closest;
  for (int k = 0; k < kPoints; ++k) {
    const double share = static_cast<double>(k) / kPoints;
    const StrokeResult strokes = kinematics.strokes_from_pose(pose_at(path, share));
    closest.reachable = closest.reachable && strokes.status == ReachStatus::kOk;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const double left_m = std::min(strokes.strokes_m[i],
                                     profile.geometry.cylinder[i].stroke_m - strokes.strokes_m[i]);
      if (left_m < closest.left_m) {
        closest = {share, left_m, closest.reachable};
      }
    }
  }
  return closest;
}

/// The path is pushed out to one side until a cylinder would no longer reach it, and the machine
/// starts a little before that place.
void runs_at_its_end(Trial& trial) {
  machines::ExcavatorMachine machine = machine_of(trial.seed());
  DigPath& path = machine.profile.dig_path;
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  // Towards x_min the field itself is slower at the arm's end than the limit there.
  double& edge_m = trial.any_of(2) == 0 ? path.x_max_m : path.y_max_m;
  constexpr double step_m = 0.005;
  while (closest_to_an_end(machine.profile, kinematics).reachable) {
    edge_m += step_m;
  }
  edge_m -= step_m;
  const Closest closest = closest_to_an_end(machine.profile, kinematics);
  constexpr double kBefore_share = 0.05;
  const StrokeResult start =
      kinematics.strokes_from_pose(pose_at(RoundedRectangle(path), closest.share - kBefore_share));
  trial.set_up(machine, start.strokes_m);
  Rig& rig = *trial.rig;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Task::kDig);
  rig.run(50 * kMillisecondUs);
  double least_left_m = 1.0;
  bool active = true;
  bool slowed = false;
  rig.run_until(10 * kSecondUs, [&] {
    const auto strokes_m = rig.plant.plant().strokes_m();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const double most_m = machine.profile.geometry.cylinder[i].stroke_m;
      least_left_m = std::min({least_left_m, strokes_m[i], most_m - strokes_m[i]});
    }
    active = active && rig.mode() == EcuMode::kActive;
    const auto& statuses = rig.record.statuses;
    slowed = slowed || (!statuses.empty() && statuses.back().limit.kind == LimitKind::kStrokeEnd);
    return false;
  });
  trial.check(active, "did not go on");
  trial.check(slowed, "no limit StrokeEnd on the bus; closest " +
                          std::to_string(1e3 * least_left_m) + " mm");
  constexpr double kPeakShare = 1.1;
  const double peak_pa = rig.plant.plant().peak_chamber_pressure_pa();
  trial.check(peak_pa <= kPeakShare * machine.plant.port_relief_pa,
              "a chamber saw " + std::to_string(1e-6 * peak_pa) + " MPa");
  trial.saw("D");
}

}  // namespace

Rows machine_rows() {
  return {{33, "spool stuck open against its command", "N L | N", spool_stuck},
          {34, "spool or cylinder moves uncommanded", "N L", moves_uncommanded},
          {35, "stroke stuck while flow is commanded", "N L", stroke_stuck},
          {36, "stroke jumps: one frame; for good", "D; N L", stroke_jumps},
          {37, "pressure stuck or at its rail", "D", pressure_wrong},
          {38, "swash disagrees with its command", "D", swash_wrong},
          {39, "HST displacement runs away", "not of this machine", nullptr},
          {40, "track speeds disagree", "not of this machine", nullptr},
          {49, "cylinder runs towards its end stop", "D", runs_at_its_end}};
}

}  // namespace graben::faults
