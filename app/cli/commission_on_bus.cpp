// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commission_on_bus.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/cli/options.hpp"
#include "app/cli/program.hpp"
#include "app/commission/commission_windows.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/operate/bus_survey.hpp"
#include "app/operate/commission_live.hpp"

namespace graben::cli {
namespace {

constexpr double kListen_s = 3.0;

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void look_at_bus(const BusCommission& options, const machines::ExcavatorMachine& machine) {
  fmt::print("listening on {} for {:.0f} s\n", options.interface, kListen_s);
  std::fflush(stdout);
  TimeUs end_us = 0;
  const operate::BusSurvey survey = operate::survey_bus(options.interface, kListen_s, end_us);
  for (const std::string& line : survey.lines(machine.profile, kListen_s, end_us)) {
    fmt::print("  {}\n", line);
  }
  if (const std::string obstacle = survey.obstacle(machine.hash, end_us); !obstacle.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", options.interface, obstacle));
  }
}

std::optional<std::string> ask_on_terminal(const std::string& question) {
  fmt::print("{}", question);
  std::fflush(stdout);
  std::string answer;
  return std::getline(std::cin, answer) ? std::optional<std::string>(answer) : std::nullopt;
}

void require_somebody_confirms(const BusCommission& options) {
  if (!options.resume && options.windows.empty() && ::isatty(STDIN_FILENO) == 0) {
    throw std::runtime_error(
        "nobody can confirm windows: standard input is no terminal, and there is no --windows");
  }
}

/// From the file, or from the operator.
void confirm_windows(const BusCommission& options, commission::SequenceOptions& sequence) {
  if (!options.windows.empty()) {
    commission::read_windows(options.windows, sequence);
  } else if (!commission::ask_windows(&ask_on_terminal, sequence)) {
    throw std::runtime_error("the windows were not confirmed");
  }
  leave_touches(options.choice, sequence);
}

commission::Progress begun(const BusCommission& options,
                           const machines::ExcavatorMachine& machine) {
  const commission::SequenceOptions whole = commission::whole_sequence(machine.profile);
  const std::filesystem::path file = commission::progress_file(options.log);
  if (options.resume) {
    commission::Progress progress = commission::read_progress(file, machine.hash, whole);
    if (!options.windows.empty()) {
      commission::SequenceOptions now = progress.options;
      commission::read_windows(options.windows, now);
      commission::require_same_windows(progress.options, now);
    }
    return progress;
  }
  if (std::filesystem::exists(options.log) || std::filesystem::exists(file)) {
    throw std::runtime_error(options.log +
                             ": there is a log already: --resume goes on with it; another --log, "
                             "or none of that name, begins newly");
  }
  std::filesystem::create_directories(std::filesystem::absolute(options.log).parent_path());
  commission::Progress progress;
  progress.profile_hash = machine.hash;
  progress.options = whole;
  choose(options.choice, progress.options);
  return progress;
}

void say_result(const BusCommission& options, const commission::SequenceOptions& planned,
                const operate::LiveResult& result) {
  const std::string resume =
      fmt::format("graben commission --can {} --profile {} --log {} --resume", options.interface,
                  shell_word(options.profile), shell_word(options.log));
  fmt::print("machine time {:.0f} s\nlog {}\n{} of {} steps done\n", result.machine_s, options.log,
             result.done, result.steps);
  if (result.end != operate::CommissionEnd::kDone) {
    throw std::runtime_error(fmt::format(
        "{}. Go on with: {}", result.words.empty() ? "told to end" : result.words, resume));
  }
  fmt::print("{}{}", left_out_text(options.choice, planned), next_text(options));
}

}  // namespace

std::string left_out_text(const SequenceChoice& choice,
                          const commission::SequenceOptions& options) {
  std::vector<std::string> out;
  if (options.has_swing && !options.swing) {
    const bool by_choice = !choice.only.empty() && !has(choice.only, "swing");
    out.emplace_back(by_choice ? "all of the swing"
                               : "all of the swing, of which nobody has confirmed a sector");
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const std::string name = commission::axis_name(axis);
    if (!choice.only.empty() && !has(choice.only, name)) {
      out.push_back("all of the " + name);
    }
  }
  for (const std::string& end : choice.no_touch) {
    out.push_back("the touch of " + end);
  }
  for (const auto& [left, words] : {std::pair{choice.no_steps, "steps at five speeds"},
                                    std::pair{choice.no_bursts, "pulses for the lowest mode"},
                                    std::pair{choice.no_pairs, "two drives at once"}}) {
    if (left) {
      out.emplace_back(words);
    }
  }
  const std::string none = options.has_swing ? "" : "no swing: the profile has none\n";
  return none + (out.empty()
                     ? ""
                     : fmt::format("left out, and so not identified: {}\n", fmt::join(out, ", ")));
}

std::string next_text(const BusCommission& options) {
  return fmt::format("next: graben identify --log {} --profile {} --out better.toml\n",
                     shell_word(options.log), shell_word(options.profile));
}

void leave_touches(const SequenceChoice& choice, commission::SequenceOptions& options) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const std::string name = commission::axis_name(axis);
    options.touch_retracted[k] =
        options.touch_retracted[k] && !has(choice.no_touch, name + "-retracted");
    options.touch_extended[k] =
        options.touch_extended[k] && !has(choice.no_touch, name + "-extended");
  }
}

void choose(const SequenceChoice& choice, commission::SequenceOptions& options) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    options.drives[static_cast<unsigned>(axis)] =
        choice.only.empty() || has(choice.only, commission::axis_name(axis));
  }
  const bool told = has(choice.only, "swing");
  if (told && !options.has_swing) {
    throw std::runtime_error("--only swing: the profile has no swing");
  }
  options.swing = options.has_swing && (choice.only.empty() || told);
  options.steps = !choice.no_steps;
  options.bursts = !choice.no_bursts;
  options.pairs = !choice.no_pairs;
  leave_touches(choice, options);
}

void commission_on_bus(const BusCommission& options) {
  const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile(options.profile));
  commission::Progress progress = begun(options, machine);
  require_somebody_confirms(options);
  look_at_bus(options, machine);
  if (!options.resume) {
    confirm_windows(options, progress.options);
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (progress.options.drives[static_cast<unsigned>(axis)]) {
      fmt::print("{}\n", commission::window_text(progress.options, axis));
    }
  }
  if (progress.options.swing) {
    fmt::print("{}\n", commission::sector_text(progress.options.sector));
  }
  fmt::print("{}", left_out_text(options.choice, progress.options));
  fmt::print("{} steps, {} of them done. Nobody within reach? Then hold the deadman\n",
             commission::planned_steps(progress.options).size(), progress.results.size());
  std::fflush(stdout);
  operate::LiveCommission live;
  live.interface = options.interface;
  live.gamepad = options.gamepad;
  live.keyboard = options.keyboard;
  live.silent_after_us = static_cast<TimeUs>(options.silent_after_s * 1e6);
  live.log = options.log;
  live.progress = progress;
  say_result(options, progress.options, operate::run_live_commission(live));
}

}  // namespace graben::cli
