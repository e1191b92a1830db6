// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/measure_up.hpp"
#include "app/cli/options.hpp"

namespace graben::cli {
namespace {

void add_touch_log_options(CLI::App& command, MeasureUpCommand& options, CLI::Option& log) {
  command
      .add_option("--out", options.out,
                  "New profile: the old one's text with the turns that were found. Without it "
                  "nothing is written")
      ->needs(&log);
  command
      .add_option("--touches", options.touches,
                  "Rests of the log that are touches of the peg, by their numbers, as 2-7,9; all "
                  "unless told")
      ->needs(&log);
  command
      .add_option("--height", options.height_m,
                  "Height of the peg over the boom foot's pin by a level, m, -20 .. 20; below it "
                  "is negative")
      ->check(number_between(-20.0, 20.0))
      ->needs(&log);
  CLI::Option* second =
      command.add_option("--second", options.second, "Rests on a second peg, as --touches");
  second->needs(&log);
  command
      .add_option("--rise", options.rise_m,
                  "Height of the second peg over the first by a level, m, -20 .. 20")
      ->check(number_between(-20.0, 20.0))
      ->needs(second);
  command
      .add_option("--keep", options.keep, "The IMU that is known to sit right, instead of a height")
      ->check(one_of({kImuNames.begin(), kImuNames.end()}))
      ->needs(&log);
  command
      .add_option("--touch-error", options.touch_m,
                  "So well the edge was put on the peg, m, standard deviation, 0.001 .. 0.05")
      ->check(number_between(0.001, 0.05))
      ->capture_default_str()
      ->needs(&log);
  command
      .add_flag("--any-machine", options.any_machine,
                "The log may be of a machine with another profile")
      ->needs(&log);
}

void add_record_options(CLI::App& command, MeasureUpCommand& options, CLI::Option& record) {
  machines::Scenario& tried = options.scenario.scenario;
  add_simulated_options(command, options.simulated);
  for (const char* const simulated : {"--simulated", "--hidden"}) {
    command.get_option(simulated)->needs(&record);
  }
  command
      .add_option("--errors", options.scenario.errors,
                  "What the controller does not know, drawn from the seed, as of dig")
      ->check(error_name())
      ->capture_default_str()
      ->needs(&record);
  add_mounting_option(command, tried.imu_mounting_rad);
  command.get_option("--imu-mounting")->needs(&record);
  command.add_option("--seed", tried.seed, "Of what is drawn, a whole number from 0")
      ->check(whole_number())
      ->capture_default_str()
      ->needs(&record);
  command.add_option("--pegs", options.pegs, "How many pegs are touched, 1 .. 2")
      ->check(whole_number_between(1, 2))
      ->capture_default_str()
      ->needs(&record);
  command.add_option("--postures", options.each, "On each of them, 1 .. 40")
      ->check(whole_number_between(1, 40))
      ->capture_default_str()
      ->needs(&record);
}

}  // namespace

void add_measure_up(CLI::App& app, int& status) {
  auto options = std::make_shared<MeasureUpCommand>();
  CLI::App* command = add_command(app, "measure-up");
  CLI::Option* const log = command->add_option(
      "--log", options->log, "Log of the bus with the IMUs' frames (candump -L, plain or gzip)");
  CLI::Option* const record =
      command->add_option("--record", options->record, "Log to write: a simulated machine touches");
  record->excludes(log);
  command->add_option("--profile", options->profile, "Of the machine: file or shipped name")
      ->required();
  command->add_flag("--force", options->force, "--out or --record may be there already");
  add_touch_log_options(*command, *options, *log);
  add_record_options(*command, *options, *record);
  add_examples(*command, {"measure-up --log touch.log --profile mine.toml --keep boom",
                          "measure-up --record touch.log --profile mine.toml --pegs 1"});
  command->callback([options, &status] {
    if (options->log.empty() && options->record.empty()) {
      throw CLI::RequiredError("--log or --record");
    }
    status = guarded("measure-up", [&] {
      options->log.empty() ? record_touches(*options) : measure_up(*options);
    });
  });
}

}  // namespace graben::cli
