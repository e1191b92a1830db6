// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/play.hpp"

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/random.hpp"
#include "tests/timing/counts/scene.hpp"
#include "tests/timing/counts/setups.hpp"

namespace graben::timing {
namespace {

const machines::SimulatedExcavator& excavator(Setup setup) {
  static const auto large =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  static const auto small =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  return setup == Setup::kExcavator12t ? small : large;
}

const machines::SimulatedDozer& dozer() {
  static const auto machine = machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine;
}

template <class Bench>
Played played(const Script& script, std::uint32_t hash, Bench& bench) {
  Played result;
  result.start = {script.setup, hash, static_cast<std::uint32_t>(script.cycles)};
  for (int n = 0; n < script.cycles; ++n) {
    result.cycles.push_back(bench.step());
  }
  return result;
}

/// Where it starts: at the task's first pose, at shares of its strokes, or anywhere in them.
plant::ExcavatorStart start_of(const Script& script, const ExcavatorSetup& setup) {
  const ExcavatorProfile& profile = setup.profile;
  plant::Random random(script.seed, plant::Draw::kStart);
  plant::ExcavatorPlant::AxisArray strokes_m{};
  const bool at_task = script.start.empty() && setup.book.count > 0;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    constexpr double kLeast = 0.1;
    const double drawn = kLeast + (1.0 - 2.0 * kLeast) * random.uniform();
    const double share = i < script.start.size() ? script.start[i] : drawn;
    strokes_m[i] = at_task ? setup.book.program[script.task_number].start[i]
                           : share * profile.geometry.cylinder[i].stroke_m;
  }
  const double swing_rad = at_task ? setup.book.program[script.task_number].start[kSwing] : 0.0;
  return {strokes_m, swing_rad};
}

Played play_excavator(const Script& script) {
  machines::Scenario scenario;
  scenario.seed = script.seed;
  scenario.soil = script.soil;
  scenario.errors = machines::Errors::kSensors;
  const machines::SimulatedExcavator machine = arranged(excavator(script.setup), scenario);
  const ExcavatorSetup& setup = excavator_setup(script.setup);
  const Task task = setup.book.count > 0 ? Task::kProgram : Task::kDig;
  Scene<runs::ExcavatorSim> scene(script, setup, machine.hash, task, [&](CanPort& port) {
    return runs::ExcavatorSim::node(machine, start_of(script, setup), port);
  });
  return played(script, machine.hash, scene);
}

Played play_dozer(const Script& script) {
  plant::DozerPlantProfile machine = draw_dozer(dozer(), script.seed);
  machine.seed = script.seed;
  machine.sensor_errors = true;
  Scene<runs::DozerSim> scene(
      script, dozer_setup(script.setup), dozer().hash, Task::kGrade,
      [&](CanPort& port) { return plant::DozerNode(machine, port, dozer().hash); });
  return played(script, dozer().hash, scene);
}

}  // namespace

Played play(const Script& script) {
  if (script.row) {
    return play_row(script);
  }
  return is_dozer(script.setup) ? play_dozer(script) : play_excavator(script);
}

}  // namespace graben::timing
