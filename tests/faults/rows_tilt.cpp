// SPDX-License-Identifier: Apache-2.0
// Rows 78 and 79: a dozer whose blade tilts, on a track that curves. What tells of its tilt, its
// roll and its course is silent, frozen, jumps or drifts, or its tilt's spool is held.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/machines/design_file.hpp"
#include "app/runs/grade_truth.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A little up and down, 5 % to either side by turns, and curves of 25 m to either side.
machines::DesignLine winding() {
  machines::DesignLine line;
  constexpr int kPoints = 24;
  constexpr double kApart_m = 5.0;
  for (int i = 0; i < kPoints; ++i) {
    const bool odd = i % 2 == 1;
    line.corners.push_back({i * kApart_m, i == 0 ? -0.07 : (odd ? -0.15 : -0.12)});
    line.cross.push_back(i == 0 ? 0.0 : (odd ? 0.05 : -0.05));
    line.curvature.push_back(i < 2 ? 0.0 : (i / 4 % 2 == 0 ? 0.04 : -0.04));
  }
  return line;
}

const machines::SimulatedDozer& tilting() {
  static const machines::SimulatedDozer machine =
      machines::with_design(machines::load_simulated_dozer(machines::find_profile("dozer_9t_tilt")),
                            winding(), 0.5, "winding");
  return machine;
}

Dozer::Scenery scenery_of(std::uint64_t seed) {
  Dozer::Scenery scenery{tilting()};
  if (seed % 2 == 1) {
    scenery.machine.plant = machines::draw_dozer(scenery.machine, seed);
  }
  scenery.machine.plant.seed = seed;
  scenery.machine.plant.sensor_errors = true;
  return scenery;
}

plant::ReadingFault frozen() {
  plant::ReadingFault fault;
  fault.stuck = true;
  return fault;
}

plant::ReadingFault jumped(double by) {
  plant::ReadingFault fault;
  fault.jump = by;
  return fault;
}

plant::ReadingFault drifting(double by_ps) {
  plant::ReadingFault fault;
  fault.drift_ps = by_ps;
  return fault;
}

struct Case {
  const char* name;
  void (*apply)(plant::DozerFaults& faults);
  std::vector<Fault> any;  ///< One of these tells it.
  TimeUs detect_us;        ///< At most; of what is frozen it is long before it is wrong.
  double most_m;           ///< The worse end of the edge off the design until then.
};

constexpr TimeUs kAtOnce_us = 100 * kMillisecondUs;
constexpr double kHardly_m = 0.025;

const std::vector<Case>& tilt_cases() {
  using Faults = plant::DozerFaults;
  static const std::vector<Case> all = {
      {"tilt's message silent",
       [](Faults& of) { of.set_silent(dbc::dozer::TiltState::kId, true); },
       {Fault::kStrokeMissing, Fault::kPoseMissing},
       kAtOnce_us,
       kHardly_m},
      {"tilt's stroke frozen",
       [](Faults& of) { of.tilt_stroke.stuck = true; },
       {Fault::kStrokeStuck, Fault::kMotionImplausible},
       5 * kSecondUs,
       0.08},
      {"tilt's stroke jumps by 30 mm",
       [](Faults& of) { of.tilt_stroke.jump_m = 0.03; },
       {Fault::kStrokeMissing, Fault::kStrokeJump},
       kAtOnce_us,
       kHardly_m},
      {"tilt's stroke drifts by 50 mm/s",
       [](Faults& of) { of.tilt_stroke.drift_mps = 0.05; },
       {Fault::kMotionImplausible},
       kSecondUs,
       0.08},
      {"tilt's spool held open",
       [](Faults& of) { of.tilt_spool_held_ratio = 0.6; },
       {Fault::kSpoolStuck},
       200 * kMillisecondUs,
       kHardly_m},
      {"tilt's spool held closed",
       [](Faults& of) { of.tilt_spool_held_ratio = 0.0; },
       {Fault::kSpoolStuck},
       5 * kSecondUs,
       kHardly_m},
  };
  return all;
}

/// Of ten seeds, 1 to 10, the second to the eleventh.
const std::vector<Case>& pose_cases() {
  using Faults = plant::DozerFaults;
  static const std::vector<Case> all = {
      {"the whole pose in error",
       [](Faults& of) { of.pose.set_state(dbc::RawState::kError); },
       {Fault::kSensorError},
       kAtOnce_us,
       kHardly_m},
      {"roll frozen",
       [](Faults& of) { of.pose.roll = frozen(); },
       {Fault::kPoseDisagrees},
       8 * kSecondUs,
       0.06},
      {"roll rate frozen",
       [](Faults& of) { of.pose.roll_rate = frozen(); },
       {Fault::kPoseDisagrees},
       8 * kSecondUs,
       kHardly_m},
      {"roll drifts by 0.1 rad/s",
       [](Faults& of) { of.pose.roll = drifting(0.1); },
       {Fault::kPoseDisagrees},
       400 * kMillisecondUs,
       kHardly_m},
      {"course's message silent",
       [](Faults& of) { of.set_silent(dbc::dozer::BodyCourse::kId, true); },
       {Fault::kPoseMissing},
       kAtOnce_us,
       kHardly_m},
      {"offset jumps by 0.5 m",
       [](Faults& of) { of.pose.offset = jumped(0.5); },
       {Fault::kPoseMissing, Fault::kPoseImplausible},
       kAtOnce_us,
       kHardly_m},
      {"offset drifts by 0.2 m/s",
       [](Faults& of) { of.pose.offset = drifting(0.2); },
       {Fault::kPoseDisagrees},
       kSecondUs,
       kHardly_m},
      {"heading frozen",
       [](Faults& of) { of.pose.heading = frozen(); },
       {Fault::kPoseDisagrees},
       8 * kSecondUs,
       kHardly_m},
      {"heading drifts by 0.1 rad/s",
       [](Faults& of) { of.pose.heading = drifting(0.1); },
       {Fault::kPoseDisagrees},
       400 * kMillisecondUs,
       kHardly_m},
      {"yaw rate frozen",
       [](Faults& of) { of.pose.yaw_rate = frozen(); },
       {Fault::kPoseDisagrees},
       8 * kSecondUs,
       kHardly_m},
      {"yaw rate off by 0.3 rad/s",
       [](Faults& of) { of.pose.yaw_rate = jumped(0.3); },
       {Fault::kPoseDisagrees},
       kAtOnce_us,
       kHardly_m},
      {"roll jumps by 0.03 rad",
       [](Faults& of) { of.pose.roll = jumped(0.03); },
       {Fault::kPoseMissing, Fault::kPoseImplausible},
       kAtOnce_us,
       kHardly_m},
      {"heading jumps by 0.05 rad",
       [](Faults& of) { of.pose.heading = jumped(0.05); },
       {Fault::kPoseMissing, Fault::kPoseImplausible},
       kAtOnce_us,
       kHardly_m},
  };
  return all;
}

/// Both ends of the edge and the design are judged by the plant's own truth.
double worst_m(const runs::GradeTruth& truth, const plant::DozerPlant& plant) {
  return std::abs(truth.worst_error_m(runs::true_pose(plant),
                                      {plant.blade().angle_rad(), plant.tilt()->angle_rad()}));
}

void go_wrong(Trial<Dozer>& trial, const std::vector<Case>& cases) {
  trial.set_up(scenery_of(trial.seed()));
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  const Case& wrong = cases[trial.seed() % cases.size()];
  plant::DozerFaults& faults = rig.plant.faults();
  wrong.apply(faults);
  const runs::GradeTruth truth(rig.machine.profile);
  Stop stop{rig.at_us(), wrong.any, wrong.detect_us};
  const bool held = faults.tilt_spool_held_ratio.has_value();
  stop.pilot_cut = held;
  stop.cure = [&trial, &faults, &rig, held] {
    constexpr double kClosed_ratio = 0.05;
    trial.check(!held || std::abs(rig.plant.plant().tilt()->spool_travel_ratio()) < kClosed_ratio,
                "the tilt's spool has not closed without pilot pressure");
    faults = {};
  };
  rig.run_until(wrong.detect_us, [&] {
    trial.outcome.harm = std::max(trial.outcome.harm, 1e3 * worst_m(truth, rig.plant.plant()));
    return !in_motion(rig.mode());
  });
  trial.outcome.harm_unit = "mm";
  trial.check(trial.outcome.harm <= 1e3 * wrong.most_m,
              fmt::format("edge {:.0f} mm off", trial.outcome.harm));
  trial.expect_stop(stop);
  for (std::string& failure : trial.outcome.failures) {
    failure = fmt::format("{}: {}", wrong.name, failure);
  }
}

void tilt_wrong(Trial<Dozer>& trial) { go_wrong(trial, tilt_cases()); }
void pose_wrong(Trial<Dozer>& trial) { go_wrong(trial, pose_cases()); }

}  // namespace

Rows<Dozer> tilt_rows(const Dozer&) {
  return {
      {78, "a blade's tilt silent, frozen, jumping, drifting, its spool held", "N L", tilt_wrong},
      {79, "roll or course silent, frozen, jumping, drifting", "N L", pose_wrong}};
}
Rows<Excavator> tilt_rows(const Excavator&) {
  return {
      {78, "a blade's tilt silent, frozen, jumping, drifting, its spool held",
       "an excavator has none", nullptr},
      {79, "roll or course silent, frozen, jumping, drifting", "an excavator has none", nullptr}};
}

}  // namespace graben::faults
