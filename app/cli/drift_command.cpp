// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/identify/drift/work_order.hpp"
#include "app/identify/machine/log_checks.hpp"
#include "app/machines/excavator_file.hpp"

namespace graben::cli {
namespace {

struct DriftCommand {
  std::vector<std::string> logs;
  std::string profile;
  std::string summary;
  bool any_machine = false;
};

/// Stamps before this are no clock's.
constexpr double kClock_s = 1e9;

struct Read {
  std::vector<identify::DayFigures> days;
  std::vector<std::string> notes;
};

/// A log that says nothing of the machine is named and left out.
void take_log(const DriftCommand& options, const std::string& file,
              const machines::ExcavatorMachine& machine, std::vector<std::string>& seen,
              Read& read) {
  const identify::MachineLog log = identify::read_machine_log(
      file, machine.profile.pump_count, identify::swing_lever_m(machine.profile));
  read.notes.insert(read.notes.end(), log.notes.begin(), log.notes.end());
  if (std::find(seen.begin(), seen.end(), log.sha256) != seen.end()) {
    throw std::runtime_error(fmt::format("{}: is the same log as another", file));
  }
  seen.push_back(log.sha256);
  if (!options.any_machine) {
    identify::assert_same_machine(log, {machine.hash});
  }
  if (log.segments.front().begin_s < kClock_s) {
    throw std::runtime_error(
        fmt::format("{}: its stamps are no clock's, so nobody knows of which day it is", file));
  }
  try {
    identify::assert_plausible(log, machine.profile);
    read.days.push_back(identify::day_figures(machine.profile, log));
  } catch (const std::runtime_error& error) {
    read.notes.push_back(fmt::format("left out: {}", error.what()));
  }
}

/// What of such a pump wears is not told apart from what its regulator does.
void assert_swash_is_told(const machines::ExcavatorMachine& machine) {
  if (machine.profile.pump[0].regulator.sets_swash()) {
    throw std::runtime_error(fmt::format(
        "the pumps of {} set their swash themselves, and their wear is not told yet; allowed: a "
        "profile whose controller sets it, pumps of kind positive",
        machine.name));
  }
}

void drift(const DriftCommand& options) {
  std::vector<std::string> inputs = options.logs;
  inputs.push_back(machines::find_profile(options.profile).string());
  assert_apart(inputs, {options.summary});
  if (!options.summary.empty()) {
    assert_writable(options.summary);
  }
  const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile(options.profile));
  assert_swash_is_told(machine);
  Read read;
  {
    ProgressBar bar("drift");
    std::vector<std::string> seen;
    for (std::size_t n = 0; n < options.logs.size(); ++n) {
      bar.show(static_cast<double>(n) / static_cast<double>(options.logs.size()), options.logs[n]);
      take_log(options, options.logs[n], machine, seen, read);
    }
  }
  std::vector<identify::DayFigures>& days = read.days;
  std::sort(days.begin(), days.end(),
            [](const auto& one, const auto& other) { return one.time_s < other.time_s; });
  if (days.size() < identify::kFewestLogs ||
      days.back().time_s - days.front().time_s < identify::kShortestTrend_s) {
    throw std::runtime_error(fmt::format(
        "{} logs of use{}: a trend needs {}, over a day or more", days.size(),
        read.notes.empty() ? "" : fmt::format(" ({})", read.notes.back()), identify::kFewestLogs));
  }
  const std::vector<identify::FigureDrift> drifts = identify::drifts_of(days);
  if (!options.summary.empty()) {
    write_whole(options.summary, identify::drift_json(days, drifts));
  }
  fmt::print("{} logs, {} to {}\n", days.size(), identify::day_text(days.front().time_s),
             identify::day_text(days.back().time_s));
  for (const std::string& note : read.notes) {
    fmt::print("note: {}\n", note);
  }
  fmt::print("{}", identify::drift_table(drifts));
  const std::vector<std::string> orders = identify::work_orders(drifts);
  for (const std::string& order : orders) {
    fmt::print("work order: {}\n", order);
  }
  const auto known = static_cast<std::size_t>(std::count_if(
      drifts.begin(), drifts.end(), [](const auto& drift) { return drift.trend.known; }));
  if (orders.empty()) {
    fmt::print("no work order: none of {} figures has changed beyond its noise\n", known);
  }
  if (known < drifts.size()) {
    fmt::print("note: {} of {} figures are in too few logs for a trend\n", drifts.size() - known,
               drifts.size());
  }
}

}  // namespace

void add_drift(CLI::App& app, int& status) {
  auto options = std::make_shared<DriftCommand>();
  CLI::App* command = add_command(app, "drift");
  command
      ->add_option("LOG", options->logs,
                   "Logs of one machine on our bus (candump -L, plain or gzip), of five days or "
                   "more, in any order; their stamps say the day")
      ->required();
  command->add_option("--profile", options->profile, "Of the machine: file or shipped name")
      ->required();
  command->add_flag("--any-machine", options->any_machine,
                    "The logs may be of a machine with another profile");
  command->add_option("--summary", options->summary,
                      "Every figure of every log, and the work orders, as JSON");
  add_examples(*command, {"drift september/*.log --profile mine.toml"});
  command->callback([options, &status] { status = guarded("drift", [&] { drift(*options); }); });
}

}  // namespace graben::cli
