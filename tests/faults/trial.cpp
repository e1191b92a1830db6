#include "tests/faults/trial.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "app/machines/scenario.hpp"
#include "firmware/motion/rounded_rectangle.hpp"

namespace graben::faults {
namespace {

/// No row's draws are another's.
constexpr std::uint64_t kSeedsPerRow = 1'000'003;
constexpr TimeUs kFirstInjection_us = 2 * kSecondUs;
constexpr TimeUs kLastInjection_us = 6 * kSecondUs;
/// A field that wants less says nothing of whether it is slower.
constexpr double kMoving_mps = 0.08;
/// Of every stroke, at the start.
constexpr double kLeastShare = 0.08;
/// Above the ground, so that the machine does not start in the soil.
constexpr double kLowestStart_m = -0.9;

const machines::ExcavatorMachine& shipped() {
  static const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile("excavator_22t"));
  return machine;
}

bool well_inside(const ExcavatorGeometry& geometry, const StrokeResult& strokes) {
  bool inside = strokes.status == ReachStatus::kOk;
  for (unsigned i = 0; i < kAxisCount && inside; ++i) {
    const double share = strokes.strokes_m[i] / geometry.cylinder[i].stroke_m;
    inside = share > kLeastShare && share < 1.0 - kLeastShare;
  }
  return inside;
}

}  // namespace

machines::ExcavatorMachine machine_of(std::uint64_t seed) {
  machines::Scenario scenario;
  scenario.seed = seed;
  scenario.soil = seed % 4 < 2;
  scenario.errors = seed % 2 == 0 ? machines::Errors::kSensors : machines::Errors::kAll;
  return machines::arranged(shipped(), scenario);
}

Eigen::Vector3d start_of(const machines::ExcavatorMachine& machine, std::uint64_t seed) {
  plant::Random random(seed, plant::Draw::kStart);
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  const RoundedRectangle path(machine.profile.dig_path);
  for (;;) {
    const PathPoint point = path.at_share(random.uniform());
    constexpr double kAround_m = 0.4;
    constexpr double kTurned_rad = 0.3;
    const TipPose pose{point.position_m.x() + random.symmetric(kAround_m),
                       point.position_m.y() + random.symmetric(kAround_m),
                       point.attitude_rad + random.symmetric(kTurned_rad)};
    const StrokeResult strokes = kinematics.strokes_from_pose(pose);
    if (pose.y_m > kLowestStart_m && well_inside(machine.profile.geometry, strokes)) {
      return strokes.strokes_m;
    }
  }
}

Trial::Trial(std::uint64_t seed, int row)
    : random(seed + kSeedsPerRow * static_cast<std::uint64_t>(row), plant::Draw::kStart),
      seed_(seed) {
  machine_ = machine_of(seed);
  start_strokes_m_ = start_of(machine_, seed);
  rig.emplace(machine_, start_strokes_m_, LoopbackBus::kQueueCapacity);
}

void Trial::set_up(const machines::ExcavatorMachine& machine,
                   const Eigen::Vector3d& start_strokes_m, std::size_t ecu_queue) {
  machine_ = machine;
  start_strokes_m_ = start_strokes_m;
  rig.emplace(machine_, start_strokes_m_, ecu_queue);
}

void Trial::set_queue(std::size_t ecu_queue) { rig.emplace(machine_, start_strokes_m_, ecu_queue); }

void Trial::dig() {
  rig->run(200 * kMillisecondUs);
  rig->ask(true, Task::kNone);
  rig->run(100 * kMillisecondUs);
  rig->ask(true, Task::kDig);
  check(rig->run_until(kSecondUs, [this] { return rig->mode() == EcuMode::kActive; }),
        "the dig does not begin");
  rig->run(any_time(kFirstInjection_us, kLastInjection_us));
  const bool moves = rig->run_until(4 * kSecondUs, [this] { return wanted_mps() > kMoving_mps; });
  check(moves && rig->mode() == EcuMode::kActive && rig->plant.spools_enabled(),
        fmt::format("no dig under way before the fault: mode {}, fault {}",
                    static_cast<int>(rig->mode()), static_cast<int>(rig->outputs().status.fault)));
}

void Trial::arm() {
  rig->run(200 * kMillisecondUs);
  rig->ask(true, Task::kNone);
  rig->run(any_time(kSecondUs, 2 * kSecondUs));
  check(rig->mode() == EcuMode::kArmed, "not armed before the fault");
}

void Trial::check(bool is_right, const std::string& what) {
  if (!is_right) {
    outcome.failures.push_back(what);
  }
}

void Trial::saw(const std::string& reaction) {
  outcome.seen += (outcome.seen.empty() ? "" : "; ") + reaction;
}

unsigned Trial::any_of(unsigned count) { return static_cast<unsigned>(random.uniform() * count); }

std::uint32_t Trial::any_id(std::initializer_list<std::uint32_t> ids) {
  return *(ids.begin() + any_of(static_cast<unsigned>(ids.size())));
}

TimeUs Trial::any_time(TimeUs least_us, TimeUs most_us) {
  const double cycles = static_cast<double>((most_us - least_us) / kCycle_us + 1);
  return least_us + kCycle_us * static_cast<TimeUs>(random.uniform() * cycles);
}

double Trial::wanted_mps() const {
  const auto& wanted = rig->record.wanted;
  return wanted.empty() ? 0.0 : wanted.back().speed_mps;
}

}  // namespace graben::faults
