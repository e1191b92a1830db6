// SPDX-License-Identifier: Apache-2.0
// Row 51: hoses or a valve reversed, while every sensor shows what was commanded.

#include <cmath>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr double kMostWrong_rad = 0.05;
constexpr TimeUs kSwingSeen_us = 500 * kMillisecondUs;
/// Of a cylinder's wrong way.
constexpr double kMostStroke_m = 0.06;

/// What answers a drive that runs the wrong way, or cannot: at its end it stands.
const std::vector<Fault> kWrongWay = {Fault::kWrongDirection, Fault::kMotionImplausible,
                                      Fault::kUncommandedMotion, Fault::kStrokeStuck};

Stop wrong_way(TimeUs since_us, TimeUs within_us) { return {since_us, kWrongWay, within_us}; }

/// The platform turns the wrong way: from its first motion on.
void swing_reversed(Trial<Excavator>& trial) {
  trial.set_up(Excavator::swinging_scenery_of(trial.seed()));
  auto& rig = *trial.rig;
  rig.plant.faults().swing.reversed = true;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Task::kProgram);
  const double from_rad = rig.plant.plant().swing_rad();
  constexpr double kMoves_rad = 0.002;
  const auto turned_rad = [&] { return std::abs(rig.plant.plant().swing_rad() - from_rad); };
  rig.run_until(10 * kSecondUs, [&] { return turned_rad() > kMoves_rad; });
  const TimeUs since_us = rig.at_us();
  rig.run_until(2 * kSecondUs, [&] { return !in_motion(rig.mode()); });
  trial.check(rig.at_us() - since_us <= kSwingSeen_us && !in_motion(rig.mode()),
              std::to_string((rig.at_us() - since_us) / kMillisecondUs) + " ms until it was seen");
  trial.outcome.to_detection_us = rig.at_us() - since_us;
  trial.outcome.harm = turned_rad();
  trial.outcome.harm_unit = "rad";
  trial.check(turned_rad() <= kMostWrong_rad,
              std::to_string(turned_rad()) + " rad the wrong way when it was seen");
  bool named = false;
  for (const Fault fault : kWrongWay) {
    if (rig.outputs().status.fault == fault) {
      trial.outcome.codes.add(fault);
      named = true;
    }
  }
  trial.check(named,
              "another fault: " + std::to_string(static_cast<int>(rig.outputs().status.fault)));
  rig.run(500 * kMillisecondUs);
  trial.check(rig.record.all_neutral(since_us + trial.outcome.to_detection_us + 2 * kCycle_us),
              "not neutral");
  trial.saw("N L");
}

/// A cylinder's, from its first motion on.
template <class Kind>
void cylinder_reversed(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  const unsigned axis = trial.any_of(Kind::kAxes);
  Kind::axis(rig.plant, axis).reversed = true;
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  const auto stroke_m = [&rig, axis] { return Kind::strokes_m(rig.plant.plant())[axis]; };
  const double before_m = stroke_m();
  constexpr double kMoves_m = 0.002;
  rig.run_until(15 * kSecondUs, [&] {
    return !in_motion(rig.mode()) || std::abs(stroke_m() - before_m) > kMoves_m;
  });
  const TimeUs since_us = rig.at_us();
  double most_m = 0.0;
  rig.run_until(2 * kSecondUs, [&] {
    most_m = std::max(most_m, std::abs(stroke_m() - before_m));
    return !in_motion(rig.mode());
  });
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m stroke";
  trial.check(most_m <= kMostStroke_m, std::to_string(1e3 * most_m) + " mm the wrong way");
  Stop stop = wrong_way(since_us, 2 * kSecondUs);
  stop.cure = [&rig, axis] { Kind::axis(rig.plant, axis).reversed = false; };
  trial.expect_stop(stop);
}

void excavator_reversed(Trial<Excavator>& trial) {
  trial.odd() ? swing_reversed(trial) : cylinder_reversed(trial);
}

}  // namespace

Rows<Excavator> direction_rows(const Excavator&) {
  return {{51, "hoses or valve reversed", "N L", excavator_reversed}};
}
Rows<Dozer> direction_rows(const Dozer&) {
  return {{51, "hoses or valve reversed", "N L", cylinder_reversed<Dozer>}};
}

}  // namespace graben::faults
