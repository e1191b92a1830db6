// SPDX-License-Identifier: Apache-2.0
// Rows 85, 87 and 88: what says how the machine goes lies, and looks plausible.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/runs/grade_truth.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr std::array<double, 3> kSpeeds = {1.0, 0.3, 0.1};

/// What an engine's start may move of a machine that has been stopped: what stands on its oil and
/// its ground; 10 mm in 60 seeds.
constexpr double kMostStart_m = 0.015;

/// At a tenth of the speed an excavator may go on by its loads for as long as its engine stands,
/// and after it: the task's way in kLooked_us (firmware/safety/README.md, what is not seen).
constexpr double kMostGoesOn_m = 0.06;
constexpr bool goes_on_by_its_load(const Rig<Excavator>& /*rig*/) { return true; }
constexpr bool goes_on_by_its_load(const Rig<Dozer>& /*rig*/) { return false; }

/// Half of the excavators have IMUs for stroke sensors: what else watches their motion sees less.
Rig<Excavator>& work(Trial<Excavator>& trial) {
  if (trial.seed() % 4 < 2) {
    trial.set_up(Excavator::imu_scenery_of(trial.seed()));
    trial.rig->run(3 * kSecondUs);  // Until its links' angles are known.
  }
  return trial.work();
}
Rig<Dozer>& work(Trial<Dozer>& trial) { return trial.work(); }

template <class Kind>
double most_moved_m(const typename Kind::PlaceArray& from_m, const Rig<Kind>& rig) {
  const auto now_m = Kind::places_m(rig.plant.plant());
  double most_m = 0.0;
  for (std::size_t i = 0; i < Kind::kPlaces; ++i) {
    most_m = std::max(most_m, std::abs(now_m[i] - from_m[i]));
  }
  return most_m;
}

/// EEC1 goes on with its last value while the engine stalls and later starts, deadman and task
/// held; at full speed, at 0.3 and 0.1 of it by turns.
template <class Kind>
void engine_speed_frozen(Trial<Kind>& trial) {
  constexpr TimeUs kLooked_us = 3 * kSecondUs;
  Rig<Kind>& rig = work(trial);
  const double speed_ratio = kSpeeds[trial.seed() % kSpeeds.size()];
  rig.ask(true, Kind::kTask, speed_ratio);
  rig.run(kSecondUs);
  plant::NodeFaults& faults = rig.plant.faults();
  faults.engine_speed.stuck = true;
  faults.engine_ratio = 0.0;
  const TimeUs stalled_us = rig.at_us();
  const TimeUs stands_us = trial.any_time(2 * kSecondUs, 6 * kSecondUs);
  if (rig.run_until(stands_us, [&rig] { return !in_motion(rig.mode()); })) {
    trial.outcome.to_detection_us = rig.at_us() - stalled_us;
    trial.outcome.codes.add(rig.outputs().status.fault);
    rig.run(stands_us - (rig.now_us - stalled_us));
  }
  const auto from_m = Kind::places_m(rig.plant.plant());
  const TimeUs starts_us = rig.now_us;
  faults.engine_ratio = 1.0;
  rig.run(kLooked_us);
  trial.outcome.harm = most_moved_m(from_m, rig);
  trial.outcome.harm_unit = "m";
  const bool stopped = rig.record.all_neutral(starts_us) && !in_motion(rig.mode());
  const bool may_go_on = goes_on_by_its_load(rig) && speed_ratio == kSpeeds.back();
  trial.check(stopped || may_go_on, "not stopped before the engine starts");
  trial.check(trial.outcome.harm <= (stopped ? kMostStart_m : kMostGoesOn_m),
              fmt::format("its start moved it by {:.0f} mm", 1e3 * trial.outcome.harm));
  trial.saw("N L");
  faults.engine_speed = {};
  if (!stopped) {
    rig.ask(false, Task::kNone);
    rig.run(kSecondUs);  // It comes to rest.
  }
  trial.expect_arms_again();
}

/// The edge against the design, as it truly is.
class EdgeOff {
 public:
  explicit EdgeOff(const Rig<Dozer>& rig) : rig_(rig), truth_(rig.machine.profile) {}
  void look() {
    const plant::DozerPlant& plant = rig_.plant.plant();
    most_m = std::max(most_m, std::abs(truth_.worst_error_m(runs::true_pose(plant),
                                                            {plant.blade().angle_rad(), 0.0})));
  }
  double most_m = 0.0;

 private:
  const Rig<Dozer>& rig_;
  runs::GradeTruth truth_;
};

/// It stops, and its edge comes no further off the grade until then than is allowed.
void expect_stop_on_grade(const Stop& stop, Trial<Dozer>& trial) {
  constexpr double kMostOff_m = 0.15;
  Rig<Dozer>& rig = *trial.rig;
  EdgeOff off(rig);
  rig.run_until(stop.detect_us, [&] {
    off.look();
    return !in_motion(rig.mode());
  });
  trial.outcome.harm = off.most_m;
  trial.outcome.harm_unit = "m edge";
  trial.check(off.most_m <= kMostOff_m, fmt::format("edge {:.0f} mm off", 1e3 * off.most_m));
  trial.expect_stop(stop);
}

/// Both pumps stay where they are as they are to go slower: their feedback says so, or shows what
/// they are told.
void pumps_stay(Trial<Dozer>& trial) {
  Rig<Dozer>& rig = trial.work();
  plant::DozerFaults& faults = rig.plant.faults();
  trial.check(rig.run_until(Dozer::kOpensWithin_us,
                            [&rig] { return rig.plant.plant().velocity_mps() > 1.0; }),
              "it never is fast");
  faults.pumps_stay = true;
  faults.pump_feedback_echoes = trial.odd();
  rig.ask(true, Dozer::kTask, 0.3);
  Stop stop{rig.at_us(),
            {Fault::kTracksAstray, Fault::kDisplacementRunaway, Fault::kDisplacementDisagrees},
            3 * kSecondUs};
  stop.cure = [&faults] {
    faults.pumps_stay = false;
    faults.pump_feedback_echoes = false;
  };
  expect_stop_on_grade(stop, trial);
}

/// The whole pose comes later and later, by 20 ms each second.
void pose_later(Trial<Dozer>& trial) {
  Rig<Dozer>& rig = trial.work();
  plant::PoseFaults& pose = rig.plant.faults().pose;
  pose.later_ps = 0.02;
  Stop stop{rig.at_us(), {Fault::kPoseDisagrees}, 15 * kSecondUs};
  stop.cure = [&pose] { pose = {}; };
  expect_stop_on_grade(stop, trial);
}

}  // namespace

Rows<Excavator> engine_rows(const Excavator&) {
  return {{85, "engine's speed frozen, engine stalls and starts", "N L",
           engine_speed_frozen<Excavator>},
          {87, "both pumps stay where they are", "not of this machine: it has no transmission",
           nullptr},
          {88, "pose comes later and later", "not of this machine: it has no pose", nullptr}};
}

Rows<Dozer> engine_rows(const Dozer&) {
  return {
      {85, "engine's speed frozen, engine stalls and starts", "N L", engine_speed_frozen<Dozer>},
      {87, "both pumps stay where they are", "N L", pumps_stay},
      {88, "pose comes later and later", "N L", pose_later}};
}

}  // namespace graben::faults
