// SPDX-License-Identifier: Apache-2.0
// Row 86: the tool at its mark, by a sensor that has slipped while nobody looked.

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// More than what the sensors of a sound machine are off by, times the links.
constexpr double kTolerance_m = 0.08;
constexpr TimeUs kRest_us = kSecondUs;
constexpr TimeUs kTouch_us = 1200 * kMillisecondUs;

/// Where the machine's tool truly is at its start.
Eigen::Vector3d tool_m(const Excavator::Scenery& scenery) {
  const ExcavatorGeometry& geometry = scenery.machine.profile.geometry;
  const SwingKinematics kinematics(geometry);
  DriveVector drive;
  drive << scenery.start_strokes_m, scenery.start_swing_rad;
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drive).value).position_m;
}

template <class Kind>
void by_hand(Rig<Kind>& rig) {
  rig.driver.set_schedule({{0, {false, OperatorMode::kManual, Task::kNone, 1.0}}});
  rig.run(kRest_us);
}

template <class Kind>
MarkResult check_at_mark(Rig<Kind>& rig) {
  by_hand(rig);
  rig.driver.touch_mark();
  rig.run(kTouch_us);
  return rig.outputs().status.mark.result;
}

/// The boom's stroke sensor slips by 30 mm: seen at the mark, and nothing arms until it is mended
/// and a check passes.
void slipped(Trial<Excavator>& trial) {
  Excavator::Scenery scenery = Excavator::scenery_of(trial.seed());
  scenery.machine.plant.soil.reset();
  scenery.machine.profile.mark = {tool_m(scenery), kTolerance_m, 0.0, false};
  trial.set_up(scenery);
  auto& rig = *trial.rig;
  trial.check(check_at_mark(rig) == MarkResult::kPassed, "a sound machine misses its mark");
  plant::StrokeFault& stroke = rig.plant.faults().axis[kBoom].stroke;
  stroke.jump_m = trial.odd() ? 0.03 : -0.03;
  trial.check(check_at_mark(rig) == MarkResult::kMissed, "it is not seen");
  const MarkTold& told = rig.outputs().status.mark;
  trial.outcome.harm = told.off_m.norm();
  trial.outcome.harm_unit = "m";
  trial.check(rig.outputs().status.faults.has(Fault::kMarkMissed), "it is not named");
  trial.outcome.codes.add(Fault::kMarkMissed);
  rig.ask(false, Task::kNone);
  rig.run(300 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  trial.expect_refused(ArmBlock::kMark, 500 * kMillisecondUs, [&] {
    stroke = {};
    trial.check(check_at_mark(rig) == MarkResult::kPassed, "mended, it misses its mark");
  });
}

}  // namespace

Rows<Excavator> mark_rows(const Excavator&) {
  return {{86, "a stroke sensor has slipped by 30 mm, seen at the mark", "refused", slipped}};
}

Rows<Dozer> mark_rows(const Dozer&) {
  return {{86, "a stroke sensor has slipped, seen at the mark", "shown by unit_mark", nullptr}};
}

}  // namespace graben::faults
