// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/commission_dozer.hpp"
#include "app/cli/commission_on_bus.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/commission/commission_windows.hpp"
#include "app/commission/dozer_plan.hpp"
#include "app/commission/wrong_way.hpp"
#include "app/machines/profile_file.hpp"
#include "app/runs/commission_run.hpp"

namespace graben::cli {
namespace {

struct CommissionCommand : BusCommission {
  machines::SimulatedChoice simulated;
  machines::Found found;
  bool found_told = false;
  std::optional<std::uint64_t> seed;
  bool force = false;
};

/// "boom-extended" and its like.
std::vector<std::string> end_names() {
  std::vector<std::string> names;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (const char* const end : {"retracted", "extended"}) {
      names.push_back(fmt::format("{}-{}", commission::axis_name(axis), end));
    }
  }
  return names;
}

std::vector<std::string> drive_names() {
  std::vector<std::string> names;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    names.emplace_back(commission::axis_name(axis));
  }
  names.emplace_back(commission::axis_name(kSwing));
  names.insert(names.end(), std::begin(commission::kDozerDrives),
               std::end(commission::kDozerDrives));
  return names;
}

/// Its pressures' noise, without biases of a day, which would be no machine's.
void take_noise(std::uint64_t seed, plant::ExcavatorPlantProfile& plant) {
  plant.seed = seed;
  plant.sensor_errors = true;
  plant.sensors.stroke_bias_m = plant.sensors.swing_bias_rad = 0.0;
  plant.sensors.pressure_bias_ratio = 0.0;
}

void commission_in_memory(const CommissionCommand& options) {
  machines::SimulatedExcavator machine = machines::load_simulated_excavator(
      machines::find_profile(options.profile), options.simulated);
  machines::make_as_found(machine.plant, {}, false, options.found);
  if (options.seed) {
    take_noise(*options.seed, machine.plant);
  }
  runs::CommissionOptions run = runs::usual_commission(machine);
  choose(options.choice, run.sequence);
  if (!options.windows.empty()) {
    commission::read_windows(options.windows, run.sequence);
    leave_touches(options.choice, run.sequence);
  }
  const auto steps = planned_steps(run.sequence);
  if (steps.empty()) {
    std::string why = left_out_text(options.choice, run.sequence);
    why.erase(why.find_last_not_of('\n') + 1);
    throw std::runtime_error("nothing is left to be tried: " + why);
  }
  assert_apart({machines::find_profile(options.profile).string(), options.windows,
                options.simulated.name.value_or("")},
               {options.log});
  if (std::filesystem::exists(options.log) && !options.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.log));
  }
  make_folder_of(options.log);
  run.log_file = options.log;
  runs::CommissionResult result;
  {
    ProgressBar bar("commission");
    result = runs::run_commission(machine, run, nullptr, bar.progress_until_stopped());
  }
  std::vector<std::string> texts;
  for (const commission::SequenceStep& step : steps) {
    texts.push_back(step_text(step));
  }
  print_steps(texts, result.steps,
              [&](std::size_t at) { return speed_text(steps[at], result.steps[at]); });
  fmt::print(
      "(took: with the way to its start; duty, speed: the largest that was tried, that came of "
      "it)\n");
  fmt::print("machine time {:.0f} s\nlog {}\n", result.machine_s, options.log);
  if (result.end != runs::CommissionEnd::kDone) {
    throw std::runtime_error(fmt::format("stopped at \"{}\": {}", texts[result.step],
                                         stop_text(result, &commission::wrong_text)));
  }
  fmt::print("{}{}", left_out_text(options.choice, run.sequence), next_text(options));
}

/// Of a dozer, what only an excavator has is refused.
void commission_a_dozer(const CommissionCommand& options) {
  if (options.simulated.name || options.found_told) {
    throw std::runtime_error(fmt::format(
        "{}: --simulated and --found are of an excavator; a dozer has --hidden", options.profile));
  }
  commission_dozer({options, options.simulated.hidden, options.seed, options.force});
}

void run_commission(const CommissionCommand& options) {
  if (!options.interface.empty()) {
    commission_on_bus(options);
    return;
  }
  const auto kind = machines::profile_kind(machines::find_profile(options.profile));
  kind == machines::MachineKind::kDozer ? commission_a_dozer(options)
                                        : commission_in_memory(options);
}

/// What is tried, of both kinds of run.
void add_choice(CLI::App& command, CommissionCommand& options, std::vector<CLI::Option*>& added) {
  SequenceChoice& choice = options.choice;
  added.push_back(command
                      .add_option("--only", choice.only,
                                  "Drives to try, the swing too, instead of all; of a "
                                  "dozer blade, tilt, tracks")
                      ->check(one_of(drive_names()))
                      ->delimiter(','));
  added.push_back(
      command.add_option("--no-touch", choice.no_touch, "Ends of strokes that are not touched")
          ->check(one_of(end_names()))
          ->delimiter(','));
  added.push_back(command.add_flag("--no-steps", choice.no_steps, "No steps at five speeds"));
  added.push_back(
      command.add_flag("--no-bursts", choice.no_bursts, "No pulses for the lowest mode"));
  added.push_back(command.add_flag("--no-pairs", choice.no_pairs, "No two drives at once"));
}

/// What only a bus has.
void add_bus_options(CLI::App& command, CommissionCommand& options, CLI::Option& can,
                     const std::vector<CLI::Option*>& choices) {
  CLI::Option* const gamepad =
      command
          .add_option("--gamepad", options.gamepad,
                      "Input device; the only gamepad there is unless told. Its left shoulder "
                      "button is the deadman")
          ->needs(&can);
  command
      .add_flag("--keyboard", options.keyboard,
                "The terminal's keyboard, space held, in place of a gamepad. FOR SIMULATION AND "
                "TESTS ONLY")
      ->needs(&can)
      ->excludes(gamepad);
  command
      .add_option("--silent-after", options.silent_after_s,
                  "A gamepad that has sent nothing for so long while its button is held has let "
                  "go, 0.5 .. 60 s: move a stick a little now and then")
      ->check(number_between(0.5, 60.0))
      ->capture_default_str();
  CLI::Option* const resume =
      command
          .add_flag("--resume", options.resume,
                    "Goes on with what LOG.progress.json beside the log says is not done yet, with "
                    "the same drives, parts and windows")
          ->needs(&can);
  for (CLI::Option* const choice : choices) {
    resume->excludes(choice);
  }
}

}  // namespace

void add_commission(CLI::App& app, int& status) {
  auto options = std::make_shared<CommissionCommand>();
  CLI::App* command = add_command(app, "commission");
  CLI::Option* const can =
      command->add_option("--can", options->interface, "CAN interface, such as can0");
  add_profile_option(*command, options->profile);
  add_simulated_options(*command, options->simulated);
  add_found_option(*command, options->found);
  command
      ->add_option("--seed", options->seed,
                   "Of the noise of the simulated machine's pressures; without it they have none")
      ->check(whole_number());
  for (const char* const simulated : {"--simulated", "--hidden", "--found", "--seed"}) {
    command->get_option(simulated)->excludes(can);
  }
  command->add_option("--log", options->log, "candump log to write")->capture_default_str();
  command->add_flag("--force", options->force, "--log of a simulation may be there already")
      ->excludes(can);
  command->add_option(
      "--windows", options->windows,
      "TOML file with a table for each drive: least, most (m), speed (m/s), "
      "retracted_end_free, extended_end_free; for the swing right, left (rad), speed (rad/s), "
      "without which it is left out; of a dozer [blade], [tilt], [tracks], these with the way "
      "behind "
      "(below 0) and before, m. Without it: asked for on a terminal, "
      "the whole strokes, 30 deg to each side, in a simulation");
  std::vector<CLI::Option*> choices;
  add_choice(*command, *options, choices);
  add_bus_options(*command, *options, *can, choices);
  add_examples(*command, {"commission --simulated excavator_22t_found --log out/machine.log",
                          "commission --can can0 --profile mine.toml --gamepad /dev/input/event5"});
  command->callback([options, command, &status] {
    options->found_told = command->count("--found") > 0;
    status = guarded("commission", [&] { run_commission(*options); });
  });
}

}  // namespace graben::cli
