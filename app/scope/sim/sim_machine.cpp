// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_machine.hpp"

#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"
#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/scope/sim/sim_faults.hpp"
#include "app/scope/sim/sim_rig.hpp"

namespace graben::scope {
namespace {

/// So far in front of its face the tip has to be when a rock is put down: it is to be run into.
constexpr double kClear_m = 0.2;

}  // namespace

void SimGround::step(plant::ExcavatorPlant& plant) {
  if (plant.profile().soil.has_value() != soil_) {
    plant.set_soil(soil_ ? std::optional(soil_profile_) : std::nullopt);
  }
  const plant::Obstacle* rock = plant.obstacle();
  if (rock != nullptr && rock->gone()) {
    obstacle_ = false;
  }
  if (rock != nullptr && !obstacle_) {
    plant.set_obstacle(std::nullopt);
  }
  const plant::ObstacleProfile& place = obstacle_profile_;
  const double in_front_m = (plant.tip().position_m - place.point_m).dot(place.normal);
  if (rock == nullptr && obstacle_ && in_front_m > kClear_m) {
    plant.set_obstacle(place);
  }
}

namespace {

constexpr const char* kFieldOfForce = "kim";

/// The nodes take the operator's share of the speed from SimOperator.
constexpr double kFullSpeed = 1.0;

std::filesystem::path profile_of(const SimOptions& options, const char* usual,
                                 machines::MachineKind kind, const char* words) {
  const std::filesystem::path file = machines::find_profile(options.profile.value_or(usual));
  if (machines::profile_kind(file) != kind) {
    throw std::runtime_error(
        fmt::format("{}: the task {} needs {}", file.string(), options.task, words));
  }
  return file;
}

void tell(const std::string& notice) {
  if (!notice.empty()) {
    fmt::print("{}\n", notice);
  }
}

machines::SimulatedExcavator excavator_of(const SimOptions& options, const char* usual) {
  machines::Scenario scenario;
  if (options.seed) {
    scenario.errors = machines::Errors::kKim;
    scenario.seed = *options.seed;
  }
  if (options.soil != kFieldOfForce) {
    scenario.ground = options.soil;
    scenario.ground_at_line = options.task == "dig";
  }
  return machines::arranged(
      machines::load_simulated_excavator(
          profile_of(options, usual, machines::MachineKind::kExcavator, "an excavator"),
          options.simulated),
      scenario);
}

SimSite<SimExcavator> dig_site(const SimOptions& options) {
  machines::SimulatedExcavator known = excavator_of(options, "excavator_22t");
  tell(machines::demand_known(known, machines::kCylinders, options.unknown));
  auto machine = std::make_shared<const machines::SimulatedExcavator>(std::move(known));
  const Eigen::Vector3d start_m = machines::dig_start(machine->profile);
  SimSite<SimExcavator> site;
  site.make = [machine, start_m] {
    return std::make_unique<runs::DigRig>(*machine, start_m, kFullSpeed);
  };
  site.is_done = [](const SimExcavator::Rig&) { return false; };
  if (machine->plant.digging) {
    return site;  // No other ground beside it.
  }
  site.ground = std::make_shared<SimGround>(machine->experiment.soil, machine->experiment.obstacle);
  site.ground->want_soil(!options.soil.empty());
  site.before_cycle = [ground = site.ground](SimExcavator::Rig& nodes) {
    ground->step(nodes.plant.plant());
  };
  return site;
}

SimSite<SimExcavator> autodig_site(const SimOptions& options) {
  if (options.soil == kFieldOfForce) {
    throw std::runtime_error("--soil kim: of the task dig alone");
  }
  machines::SimulatedExcavator known = excavator_of(options, "excavator_12t");
  if (!known.profile.has_swing()) {
    throw std::runtime_error(
        fmt::format("{}: the task autodig needs an excavator with a swing drive", known.name));
  }
  const machines::TaskFile task = machines::load_task(
      machines::find_task(options.task_file.value_or("flatten")), known.profile);
  machines::demand_steps(task, "the task autodig");
  tell(machines::demand_known(known, machines::needed_drives(known.profile, task.result.program),
                              options.unknown));
  auto machine = std::make_shared<const machines::SimulatedExcavator>(std::move(known));
  auto book = std::make_shared<TaskBook>();
  book->program[0] = task.result.program;
  book->count = 1;
  SimSite<SimExcavator> site;
  site.make = [machine, book, surface = task.surface] {
    return std::make_unique<runs::AutodigRig>(*machine, *book, book->program[0].start, kFullSpeed);
  };
  site.is_done = [](const SimExcavator::Rig& nodes) {
    return nodes.ecu->outputs().status.progress.kind == StepKind::kDone;
  };
  return site;
}

SimSite<SimDozer> grade_site(const SimOptions& options) {
  machines::DozerScenario scenario;
  scenario.errors = options.seed.has_value();
  scenario.seed = options.seed.value_or(0);
  const auto own = [&options] {
    return machines::load_simulated_dozer(
        profile_of(options, "dozer_9t", machines::MachineKind::kDozer, "a dozer"));
  };
  machines::SimulatedDozer known =
      machines::arranged(options.designed ? *options.designed : own(), scenario);
  tell(machines::demand_known(known, options.unknown));
  auto machine = std::make_shared<const machines::SimulatedDozer>(std::move(known));
  SimSite<SimDozer> site;
  site.make = [machine] { return std::make_unique<runs::GradeRig>(*machine, kFullSpeed); };
  site.is_done = [machine](const SimDozer::Rig& nodes) {
    return nodes.plant.plant().cutting_edge_m().x() >= machine->experiment.length_m;
  };
  return site;
}

template <class Kind>
std::unique_ptr<SimMachine> rig_of(SimSite<Kind> site, FrameTap tap) {
  return std::make_unique<SimRig<Kind>>(std::move(site), sim_faults<Kind>(), std::move(tap));
}

}  // namespace

std::unique_ptr<SimMachine> make_sim_machine(const SimOptions& options, FrameTap tap) {
  if (options.task_file && options.task != "autodig") {
    throw std::runtime_error(
        fmt::format("{}: a task file is of the task autodig alone", *options.task_file));
  }
  if (options.task == "dig") {
    return rig_of(dig_site(options), std::move(tap));
  }
  if (options.task == "grade") {
    if (!options.simulated.is_own() || !options.soil.empty()) {
      throw std::runtime_error("--simulated, --hidden, --soil: of an excavator alone");
    }
    return rig_of(grade_site(options), std::move(tap));
  }
  if (options.task == "autodig") {
    return rig_of(autodig_site(options), std::move(tap));
  }
  throw std::runtime_error(fmt::format("task '{}': allowed: dig, grade, autodig", options.task));
}

}  // namespace graben::scope
