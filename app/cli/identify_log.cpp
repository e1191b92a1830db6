// SPDX-License-Identifier: Apache-2.0
#include "app/cli/identify_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "app/cli/console.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/identify/file/identified_file.hpp"
#include "app/identify/machine/log_checks.hpp"
#include "app/identify/machine/stroke_scale.hpp"
#include "app/identify/machine/swing_figures.hpp"
#include "app/machines/answer_section.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/profile_document.hpp"
#include "app/reports/identify/identify_report.hpp"

namespace graben::cli {

namespace fs = std::filesystem;

namespace {

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(now));
}

}  // namespace

std::string source_text(const std::vector<NamedLog>& logs) {
  std::string text;
  for (const NamedLog& log : logs) {
    text += fmt::format("{}{} sha256 {}", text.empty() ? "" : " and ", log.name,
                        log.sha256.substr(0, kShortHash));
  }
  return fmt::format("{}, {}", text, today());
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void assert_same_base(const fs::path& file, const fs::path& out) {
  const auto alone = [&](const fs::path& as) {
    return machines::ProfileDocument{as, toml::parse(text_of(file), file.string())};
  };
  const auto base = machines::base_of(alone(file));
  const auto there = machines::base_of(alone(out));
  std::error_code error;
  if (base && !fs::equivalent(*base, *there, error)) {
    throw std::runtime_error(
        fmt::format("{}: {} is like {}, and beside {} that would be {}; allowed: a folder in which "
                    "it is the same",
                    out.string(), file.string(), base->string(), out.string(), there->string()));
  }
}

namespace {

machines::ExcavatorMachine load_profile(const std::string& name) {
  return machines::load_excavator(machines::find_profile(name));
}

std::string commissioned_of(const machines::ExcavatorMachine& machine) {
  return machines::commissioned_text(machine.driven, machine.profile.drive_count);
}

/// The profile says that values of it are from this log; see source_of().
bool is_from(const machines::ExcavatorMachine& machine, const identify::MachineLog& log) {
  return std::any_of(machine.provenance.begin(), machine.provenance.end(), [&](const auto& value) {
    return value.from.find(log.sha256.substr(0, kShortHash)) != std::string::npos;
  });
}

/// Logs that fit the machine's profile, or one of `hashes`, or that it was found from; what is
/// worth knowing of each is printed.
std::vector<identify::MachineLog> read_logs(const IdentifyLogCommand& options,
                                            const machines::ExcavatorMachine& machine,
                                            const std::vector<std::uint32_t>& hashes) {
  const ExcavatorProfile& profile = machine.profile;
  std::vector<identify::MachineLog> logs;
  for (const std::string& file : options.logs) {
    logs.push_back(identify::read_machine_log(file, profile.pump_count,
                                              identify::swing_lever_m(profile),
                                              !profile.pump[0].regulator.sets_swash()));
    const identify::MachineLog& log = logs.back();
    for (const std::string& note : log.notes) {
      fmt::print("note: {}\n", note);
    }
    for (std::size_t n = 0; n + 1 < logs.size(); ++n) {
      if (logs[n].sha256 == log.sha256) {
        throw std::runtime_error(fmt::format("{}: is the same log as {}", file, options.logs[n]));
      }
    }
    if (!options.any_machine && !is_from(machine, log)) {
      identify::assert_same_machine(log, hashes);
    }
    identify::assert_plausible(log, profile);
  }
  for (const identify::MachineLog& log : logs) {
    fmt::print("{}: {}\n", log.name, fmt::join(identify::log_notes(log), "; "));
  }
  return logs;
}

std::string source_of(const std::vector<identify::MachineLog>& logs) {
  std::vector<NamedLog> named;
  for (const identify::MachineLog& log : logs) {
    named.push_back({log.name, log.sha256});
  }
  return source_text(named);
}

/// Before any work: nothing that is read, and no other file, is lost.
void assert_outputs(const IdentifyLogCommand& options, const fs::path& profile) {
  const std::vector<std::string> written = {options.out, options.report, options.summary};
  std::vector<std::string> inputs = options.logs;
  inputs.push_back(profile.string());
  if (!options.before.empty()) {
    inputs.push_back(machines::find_profile(options.before).string());
  }
  assert_apart(inputs, written);
  if (fs::exists(options.out) && !options.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.out));
  }
  for (const std::string& file : written) {
    if (!file.empty()) {
      assert_writable(file);
    }
  }
}

/// Sides without a steady speed have no place under a limit: they are named rather than passed.
void assert_within(const identify::PredictionScore& score, double limit_percent) {
  if (limit_percent <= 0.0) {
    return;
  }
  const std::vector<std::string> open = identify::unjudged_sides(score);
  if (!identify::any_judged(score)) {
    throw std::runtime_error("--limit: no drive kept a steady speed that could be judged");
  }
  if (!open.empty()) {
    fmt::print("no steady speed to judge: {}\n", fmt::join(open, "; "));
  }
  const double off_percent = 100.0 * identify::most_off(score);
  if (off_percent > limit_percent) {
    throw std::runtime_error(
        fmt::format("a speed is {:.1f} % off; --limit allows {} %", off_percent, limit_percent));
  }
}

/// A profile that is as good as any is the end of it; so is a simulated machine that its own
/// profile describes, and another one is a word away.
std::string next_text(const IdentifyLogCommand& options) {
  std::string logs;
  for (const std::string& log : options.logs) {
    logs += " " + shell_word(log);
  }
  const std::string profile = shell_word(options.profile);
  const bool is_simulated =
      fs::is_regular_file(machines::simulation_file(machines::find_profile(options.profile)));
  return fmt::format(
      "\nnext: graben identify --check --log{} --profile {} says how well it fits{}", logs, profile,
      is_simulated ? fmt::format("; a simulated machine is as its profile says, another one by "
                                 "graben commission --profile {} --hidden 3",
                                 profile)
                   : "");
}

void assert_better(const identify::JudgedFit& fit, const IdentifyLogCommand& options) {
  if (fit.is_better()) {
    return;
  }
  std::string text = fmt::format(
      "nothing was written: the new profile predicts what was left out ({:.0f} s) worse than {}; "
      "error of the speed, old and new, RMS:",
      fit.judged_s,
      fit.predicts() ? "the old one"
                     : "one of a machine that stands: are the logs of one machine?");
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    if (k < kAxisCount || fit.before.axis[k].speed_mps2 > 0.0) {
      text += fmt::format("{} {} {:.1f} and {:.1f} %", k == 0 ? "" : ",", identify::kAxisTexts[k],
                          100.0 * fit.before.axis[k].share(), 100.0 * fit.left_out.axis[k].share());
    }
  }
  throw std::runtime_error(fit.predicts() ? text + next_text(options) : text);
}

}  // namespace

void identify_logs(const IdentifyLogCommand& options) {
  const fs::path file = machines::find_profile(options.profile);
  const machines::ExcavatorMachine machine = machines::load_excavator(file);
  assert_outputs(options, file);
  assert_same_base(file, options.out);
  const std::vector<identify::MachineLog> logs = read_logs(options, machine, {machine.hash});
  identify::JudgedFit fit;
  {
    ProgressBar bar("identify");
    fit = identify::fit_and_judge(machine.profile, logs, bar.progress());
  }
  fmt::print("{}", reports::prediction_table({{"old", &fit.before}, {"new", &fit.left_out}}));
  for (const std::string& missing : fit.machine.missing) {
    fmt::print("{}\n", missing);
  }
  for (const std::string& sentence : identify::swing_sentences(fit.machine.swing)) {
    fmt::print("{}\n", sentence);
  }
  for (const std::string& note : identify::scale_notes(fit.machine)) {
    fmt::print("{}\n", note);
  }
  if (!options.strokes_measured) {
    identify::assert_scales(fit.machine);
  }
  assert_better(fit, options);
  const std::string from = source_of(logs);
  const std::string text = identify::identified_text(text_of(file), machine, fit, from);
  identify::assert_reads_back(text, options.out, fit.profile);
  const reports::IdentifyReport report = {machine, fit, logs, from};
  if (!options.report.empty()) {
    write_whole(options.report, reports::identify_page(report));
  }
  if (!options.summary.empty()) {
    write_whole(options.summary, reports::identify_json(report));
  }
  write_whole(options.out, text);
  fmt::print("profile  {}\n", options.out);
  fmt::print("{}\n", commissioned_of(load_profile(options.out)));
  fmt::print("next     graben identify --check --log {} --profile {} --before {}\n",
             shell_word(options.logs.back()), shell_word(options.out), shell_word(options.profile));
  if (!options.report.empty()) {
    fmt::print("report   {}\n", options.report);
  }
}

void check_logs(const IdentifyLogCommand& options) {
  assert_outputs(options, machines::find_profile(options.profile));
  const machines::ExcavatorMachine machine = load_profile(options.profile);
  std::vector<std::uint32_t> hashes = {machine.hash};
  std::vector<reports::ScoreColumn> columns;
  identify::PredictionScore before;
  machines::ExcavatorMachine old;
  if (!options.before.empty()) {
    old = load_profile(options.before);
    hashes.push_back(old.hash);
  }
  const std::vector<identify::MachineLog> logs = read_logs(options, machine, hashes);
  const auto stretches = identify::moving_stretches(logs);
  const identify::DriveModel model(machine.profile);
  const auto spools = identify::spool_answers(model, logs);
  if (!options.before.empty()) {
    before = identify::score_of(identify::DriveModel(old.profile), logs, stretches, spools);
    columns.push_back({"before", &before});
  }
  const identify::PredictionScore now = identify::score_of(model, logs, stretches, spools);
  columns.push_back({"now", &now});
  fmt::print("{}", reports::prediction_table(columns));
  fmt::print("{}\n", commissioned_of(machine));
  for (const std::string& sentence : identify::score_sentences(now)) {
    fmt::print("{}\n", sentence);
  }
  if (!options.summary.empty()) {
    write_whole(options.summary, reports::prediction_json(columns));
  }
  assert_within(now, options.limit_percent);
}

}  // namespace graben::cli
