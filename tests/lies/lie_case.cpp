// SPDX-License-Identifier: Apache-2.0
#include "tests/lies/lie_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/runs/code_text.hpp"
#include "app/runs/grade_truth.hpp"
#include "app/runs/plant_faults.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"
#include "tests/faults/trial.hpp"

namespace graben::lies {
namespace {

using faults::Dozer;
using faults::Excavator;
using faults::Rig;
using faults::Trial;

/// From the stop on, until oil and linkage have come to rest.
constexpr TimeUs kStands_us = 400 * kMillisecondUs;
/// Way at full speed before the lie comes, and after it, in time.
constexpr double kLeastBefore_s = 2.0;
constexpr double kMostBefore_s = 6.0;
constexpr double kLookedFor_s = 20.0;
/// However slow it is.
constexpr double kLongest_s = 60.0;

TimeUs microseconds(double seconds) { return static_cast<TimeUs>(std::llround(seconds * 1e6)); }

template <class Faults>
void apply(const runs::PlantFaultTable<Faults>& table, const std::vector<std::string>& told,
           Faults& faults) {
  for (const std::string& text : told) {
    const runs::ToldFault fault = runs::told_fault(text + "@0");
    const auto found = table.find(fault.name);
    if (found == table.end()) {
      throw std::runtime_error(fmt::format("no fault '{}'", fault.name));
    }
    found->second(faults, fault.value);
  }
}

/// How far the truth is off, as the lie's row counts it. From the stop on what is shown stays as it
/// was then: only what still moves counts.
class ExcavatorOff {
 public:
  ExcavatorOff(const LieCase& lie, const Rig<Excavator>& rig)
      : rig_(rig),
        of_swing_(std::any_of(lie.faults.begin(), lie.faults.end(),
                              [](const auto& name) { return name.rfind("swing-angle", 0) == 0; })) {
    hear();
    if (!lie.from_start) {
      bias_m_ = heard_m_ - true_m();
      swing_bias_rad_ = heard_rad_ - rig_.plant.plant().swing_rad();
    }
  }
  void hear() {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      if (rig_.ecu->inputs().axis[i].stroke_m.validity == Validity::kValid) {
        heard_m_[i] = Excavator::heard_stroke_m(rig_.ecu->inputs(), i);
      }
    }
    heard_rad_ = rig_.ecu->inputs().swing.angle_rad.value;
  }
  [[nodiscard]] double now() const {
    if (of_swing_) {
      return std::abs(heard_rad_ - swing_bias_rad_ - rig_.plant.plant().swing_rad());
    }
    const ExcavatorKinematics kinematics(rig_.machine.profile.geometry);
    const KinematicState shown = kinematics.state(within_m(heard_m_ - bias_m_));
    const KinematicState is = kinematics.state(within_m(true_m()));
    if (shown.status != ReachStatus::kOk || is.status != ReachStatus::kOk) {
      throw std::logic_error("strokes within their cylinders have no pose");
    }
    return std::hypot(shown.tip.x_m - is.tip.x_m, shown.tip.y_m - is.tip.y_m);
  }

 private:
  /// A cylinder on its stop is pressed a little beyond it, where the linkage has no pose.
  [[nodiscard]] Eigen::Vector3d within_m(Eigen::Vector3d strokes_m) const {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      strokes_m[i] =
          std::clamp(strokes_m[i], 0.0, rig_.machine.profile.geometry.cylinder[i].stroke_m);
    }
    return strokes_m;
  }
  [[nodiscard]] Eigen::Vector3d true_m() const {
    const auto strokes_m = rig_.plant.plant().strokes_m();
    return {strokes_m[0], strokes_m[1], strokes_m[2]};
  }
  const Rig<Excavator>& rig_;
  bool of_swing_;
  Eigen::Vector3d heard_m_ = Eigen::Vector3d::Zero();
  double heard_rad_ = 0.0;
  Eigen::Vector3d bias_m_ = Eigen::Vector3d::Zero();
  double swing_bias_rad_ = 0.0;
};

class DozerOff {
 public:
  DozerOff(const LieCase& /*lie*/, const Rig<Dozer>& rig)
      : rig_(rig), truth_(rig.machine.profile) {}
  void hear() {}  // Against the design it counts by itself.
  [[nodiscard]] double now() const {
    const plant::DozerPlant& plant = rig_.plant.plant();
    const double tilt_rad = plant.tilt() ? plant.tilt()->angle_rad() : 0.0;
    return std::abs(
        truth_.worst_error_m(runs::true_pose(plant), {plant.blade().angle_rad(), tilt_rad}));
  }

 private:
  const Rig<Dozer>& rig_;
  runs::GradeTruth truth_;
};

template <class Kind, class Off, class Table>
LieOutcome run(const LieCase& lie, const typename Kind::Scenery& scenery, Task task,
               const Table& table, std::uint64_t seed) {
  Trial<Kind> trial(seed, 0);
  trial.set_up(scenery);
  Rig<Kind>& rig = *trial.rig;
  LieOutcome outcome;
  const auto begin = [&] { apply(table, lie.faults, rig.plant.faults()); };
  if (lie.from_start) {
    begin();
  }
  rig.run(200 * kMillisecondUs);
  rig.ask(true, Task::kNone, lie.speed_ratio);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, task, lie.speed_ratio);
  const bool active = rig.run_until(kSecondUs, [&] { return rig.mode() == EcuMode::kActive; });
  if (lie.from_start && !active) {
    outcome.seen_s = 0.0;
    outcome.fault = "not armed";
    return outcome;
  }
  if (!lie.from_start) {
    const double before_s =
        kLeastBefore_s + (kMostBefore_s - kLeastBefore_s) * trial.random.uniform();
    rig.run(microseconds(before_s / lie.speed_ratio));
    outcome.works = rig.mode() == EcuMode::kActive;
    begin();
  }
  Off off(lie, rig);
  const TimeUs since_us = rig.at_us();
  const auto look = [&] { outcome.off = std::max(outcome.off, off.now()); };
  const double looked_s =
      lie.looked_s > 0.0 ? lie.looked_s : std::min(kLookedFor_s / lie.speed_ratio, kLongest_s);
  const bool seen = rig.run_until(microseconds(looked_s), [&] {
    off.hear();
    look();
    return rig.mode() == EcuMode::kFault;
  });
  if (seen) {
    outcome.seen_s = 1e-6 * static_cast<double>(rig.at_us() - since_us);
    outcome.fault = runs::fault_words(rig.outputs().status.fault);
    rig.run_until(kStands_us, [&] {
      look();
      return false;
    });
  }
  return outcome;
}

}  // namespace

const std::vector<std::string>& machines() {
  static const std::vector<std::string> names = {"22t", "12t", "retrofit", "zx200", "dozer"};
  return names;
}

LieOutcome tried(const LieCase& lie, std::uint64_t seed) {
  const std::string& machine = lie.machine;
  if (std::find(machines().begin(), machines().end(), machine) == machines().end()) {
    throw std::runtime_error(fmt::format("no machine '{}'", machine));
  }
  if (machine == "dozer") {
    return run<Dozer, DozerOff>(lie, Dozer::scenery_of(seed), Task::kGrade,
                                runs::dozer_plant_faults(), seed);
  }
  const bool swings = machine == "12t";
  const Excavator::Scenery scenery =
      swings ? Excavator::swinging_scenery_of(seed, lie.seconds)
             : Excavator::found_scenery_of(seed, machine == "22t" ? "" : machine, lie.soil,
                                           lie.seconds);
  return run<Excavator, ExcavatorOff>(lie, scenery, swings ? Task::kProgram : Task::kDig,
                                      runs::excavator_plant_faults(), seed);
}

}  // namespace graben::lies
