// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/identify_dozer.hpp"
#include "app/cli/identify_log.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/identify/motion_result.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::cli {
namespace {

struct IdentifyCommand {
  std::vector<std::string> csv;
  std::vector<std::string> judge;
  IdentifyLogCommand log;
};

void identify_motion(const IdentifyCommand& options) {
  std::vector<std::string> inputs = options.csv;
  inputs.insert(inputs.end(), options.judge.begin(), options.judge.end());
  assert_apart(inputs, {options.log.summary});
  std::vector<std::string> notes;
  std::vector<identify::MotionRun> train =
      identify::cut_and_thinned(identify::read_motion_files(options.csv, &notes), &notes);
  std::vector<identify::MotionRun> judge = identify::read_motion_files(options.judge, &notes);
  const identify::MotionSplit split =
      identify::split_motion(std::move(train), identify::cut_and_thinned(std::move(judge)));
  assert_writable(options.log.summary);
  identify::MotionResult result;
  {
    ProgressBar bar("identify");
    identify::FitOptions fit;
    fit.progress = bar.progress();
    result = identify::identify_motion(split, fit);
  }
  result.notes = notes;
  write_whole(options.log.summary, identify::motion_json(result));
  fmt::print("{}", identify::motion_text(result));
  if (result.useless()) {
    throw std::runtime_error(
        fmt::format("no axis follows its command (R2 below {:.1f}): the figures say nothing; are "
                    "these the commands of this machine?",
                    identify::kUselessR2));
  }
}

void need(bool given, const char* name) {
  if (!given) {
    throw CLI::RequiredError(name);
  }
}

/// Which of the three it is, with what each needs.
void check_usage(const IdentifyCommand& options) {
  if (!options.csv.empty()) {
    need(!options.log.summary.empty(), "--summary");
    return;
  }
  need(!options.log.logs.empty(),
       "--csv, or --log of a machine's log, as `graben commission` writes it,");
  need(!options.log.profile.empty(), "--profile");
  need(options.log.check || !options.log.out.empty(), "--out, or --check,");
}

void run(const IdentifyCommand& options) {
  if (!options.csv.empty()) {
    identify_motion(options);
  } else if (machines::profile_kind(machines::find_profile(options.log.profile)) ==
             machines::MachineKind::kDozer) {
    identify_dozer_logs(options.log);
  } else if (options.log.check) {
    check_logs(options.log);
  } else {
    identify_logs(options.log);
  }
}

void add_csv_options(CLI::App& command, IdentifyCommand& options) {
  CLI::Option* csv = command.add_option(
      "--csv", options.csv,
      "Recorded motion, CSV, plain or gzip: columns run, time_s and for boom, arm, bucket and "
      "swing command_permille_AXIS, angle_rad_AXIS and, where a sensor measured it, "
      "velocity_radps_AXIS; needs --summary");
  command
      .add_option("--judge", options.judge,
                  "The same, of runs to judge by; unless told, every fifth run of --csv is left "
                  "out")
      ->needs(csv);
}

void add_log_options(CLI::App& command, IdentifyLogCommand& options) {
  CLI::Option* log = command.add_option(
      "--log", options.logs,
      "Logs of our bus (candump -L, plain or gzip) with motion in them; of several the last one "
      "judges");
  log->excludes(command.get_option("--csv"));
  command.add_option("--profile", options.profile, "Of the machine: file or shipped name")
      ->needs(log);
  CLI::Option* out = command.add_option(
      "--out", options.out, "New profile: the old one's text with what was found in it");
  out->needs(log);
  CLI::Option* report =
      command.add_option("--report", options.report, "What was found, as one HTML page");
  report->needs(out);
  command.add_flag("--force", options.force, "--out may be there already")->needs(out);
  command
      .add_flag("--any-machine", options.any_machine,
                "The logs may be of a machine with another profile")
      ->needs(log);
  command
      .add_flag(
          "--strokes-measured", options.strokes_measured,
          "What the stroke sensors show was measured with a tape: where the oil says otherwise, "
          "the valve's areas are not the profile's")
      ->needs(out);
  CLI::Option* check = command.add_flag(
      "--check", options.check,
      "Only compare: how far is what the profile predicts from what the logs show?");
  check->needs(log)->excludes(out);
  command.add_option("--before", options.before, "An older profile to stand beside --profile")
      ->needs(check);
  command
      .add_option("--limit", options.limit_percent,
                  "Exit status 1 where a speed is farther off than this, %, 0.1 .. 1000")
      ->check(number_between(0.1, 1000.0))
      ->needs(check);
}

}  // namespace

void add_identify(CLI::App& app, int& status) {
  auto options = std::make_shared<IdentifyCommand>();
  CLI::App* command = add_command(app, "identify");
  add_csv_options(*command, *options);
  add_log_options(*command, options->log);
  command->add_option("--summary", options->log.summary, "Figures as JSON");
  add_examples(*command, {"identify --log out/machine.log --profile mine.toml --out better.toml",
                          "identify --log out/machine.log --profile better.toml --check"});
  command->callback([options, &status] {
    check_usage(*options);
    status = guarded("identify", [&] { run(*options); });
  });
}

}  // namespace graben::cli
