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
#include "app/commission/commission_progress.hpp"
#include "app/commission/commission_windows.hpp"
#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/operate/bus_survey.hpp"
#include "app/operate/commission_live.hpp"
#include "app/runs/code_text.hpp"

namespace graben::cli {
namespace {

constexpr double kListen_s = 3.0;

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Machine>
void look_at_bus(const BusCommission& options, const Machine& machine) {
  fmt::print("listening on {} for {:.0f} s\n", options.interface, kListen_s);
  std::fflush(stdout);
  TimeUs end_us = 0;
  const operate::BusSurvey survey = operate::survey_bus(
      options.interface, operate::surveyed_bus(machine.profile), kListen_s, end_us);
  for (const std::string& line : survey.lines(machine.profile, kListen_s, end_us)) {
    fmt::print("  {}\n", line);
  }
  if (const std::string obstacle = survey.obstacle(machine.profile, machine.hash, end_us);
      !obstacle.empty()) {
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

/// What is the kind's own of a commissioning on a bus.
struct ExcavatorOnBus {
  using Options = commission::SequenceOptions;
  static machines::ExcavatorMachine load(const std::filesystem::path& file) {
    return machines::load_excavator(file);
  }
  static Options whole(const ExcavatorProfile& profile) {
    return commission::whole_sequence(profile);
  }
  static void read_windows(const std::string& file, Options& options) {
    commission::read_windows(file, options);
  }
  /// From the file, or from the operator.
  static void confirm(const BusCommission& told, Options& options) {
    if (!told.windows.empty()) {
      commission::read_windows(told.windows, options);
    } else if (!commission::ask_windows(&ask_on_terminal, options)) {
      throw std::runtime_error("the windows were not confirmed");
    }
    leave_touches(told.choice, options);
  }
  static std::vector<std::string> windows(const Options& options) {
    std::vector<std::string> lines;
    for (int axis = 0; axis < kAxisCount; ++axis) {
      if (options.drives[static_cast<unsigned>(axis)]) {
        lines.push_back(commission::window_text(options, axis));
      }
    }
    if (options.swing) {
      lines.push_back(commission::sector_text(options.sector));
    }
    return lines;
  }
  static std::size_t steps(const Options& options) {
    return commission::planned_steps(options).size();
  }
};

struct DozerOnBus {
  using Options = commission::DozerOptions;
  static machines::DozerMachine load(const std::filesystem::path& file) {
    return machines::load_dozer(file);
  }
  static Options whole(const DozerProfile& profile) { return commission::whole_dozer(profile); }
  static void read_windows(const std::string& file, Options& options) {
    commission::read_dozer_windows(file, options);
  }
  static void confirm(const BusCommission& told, Options& options) {
    commission::read_dozer_windows(told.windows, options);
  }
  static std::vector<std::string> windows(const Options& options) {
    return commission::dozer_window_texts(options);
  }
  static std::size_t steps(const Options& options) {
    return commission::dozer_step_texts(options).size();
  }
};

template <class Kind, class Machine>
commission::ProgressOf<typename Kind::Options> begun(const BusCommission& options,
                                                     const Machine& machine) {
  const auto whole = Kind::whole(machine.profile);
  const std::filesystem::path file = commission::progress_file(options.log);
  if (options.resume) {
    auto progress = commission::read_progress(file, machine.hash, whole);
    if (!options.windows.empty()) {
      auto now = progress.options;
      Kind::read_windows(options.windows, now);
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
  commission::ProgressOf<typename Kind::Options> progress;
  progress.profile_hash = machine.hash;
  progress.options = whole;
  choose(options.choice, progress.options);
  return progress;
}

template <class Options>
void say_result(const BusCommission& options, const Options& planned,
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

void print_steps(const std::vector<std::string>& texts,
                 const std::vector<commission::StepResult>& steps,
                 const std::function<std::string(std::size_t)>& speed) {
  fmt::print("{:<49} {:<11} {:>6} {:>6} {:>9}\n", "tried", "ended as", "took", "duty", "speed");
  for (std::size_t at = 0; at < steps.size(); ++at) {
    const commission::StepResult& step = steps[at];
    fmt::print("{:<49} {:<11} {:>4.1f} s {:>4.0f} % {:>9}\n", texts[at], end_text(step.end),
               step.took_s, 100.0 * step.duty, speed(at));
  }
}

std::string stop_text(const runs::CommissionResult& result,
                      const std::function<std::string(const commission::WrongWay&)>& wrong) {
  switch (result.end) {
    case runs::CommissionEnd::kDone:
      return "";
    case runs::CommissionEnd::kFault:
      return fmt::format("{} (fault {}). {}", runs::fault_words(result.fault),
                         static_cast<int>(result.fault), runs::fault_help(result.fault));
    case runs::CommissionEnd::kWrongWay:
      return wrong(*result.wrong);
    case runs::CommissionEnd::kTooLong:
      return fmt::format("not done after {} s", runs::kCommissionMost_s);
  }
  return "";
}

namespace {

template <class Kind>
void lead_on_bus(const BusCommission& options) {
  const auto machine = Kind::load(machines::find_profile(options.profile));
  auto progress = begun<Kind>(options, machine);
  require_somebody_confirms(options);
  look_at_bus(options, machine);
  if (!options.resume) {
    Kind::confirm(options, progress.options);
  }
  if (Kind::steps(progress.options) == 0) {
    throw std::runtime_error("nothing is left to be tried: " +
                             left_out_text(options.choice, progress.options));
  }
  for (const std::string& line : Kind::windows(progress.options)) {
    fmt::print("{}\n", line);
  }
  fmt::print("{}", left_out_text(options.choice, progress.options));
  fmt::print("{} steps, {} of them done. Nobody within reach? Then hold the deadman\n",
             Kind::steps(progress.options), progress.results.size());
  std::fflush(stdout);
  const operate::LiveOptions live = {options.interface, options.gamepad, options.keyboard,
                                     static_cast<TimeUs>(options.silent_after_s * 1e6),
                                     options.log};
  say_result(options, progress.options, operate::run_live_commission(live, progress));
}

}  // namespace

void commission_on_bus(const BusCommission& options) {
  const auto kind = machines::profile_kind(machines::find_profile(options.profile));
  if (kind != machines::MachineKind::kDozer) {
    lead_on_bus<ExcavatorOnBus>(options);
    return;
  }
  if (!options.resume && options.windows.empty()) {
    throw std::runtime_error(
        fmt::format("{}: a dozer's windows are confirmed by a file: --windows, with [blade], "
                    "[tilt], [tracks]",
                    options.profile));
  }
  lead_on_bus<DozerOnBus>(options);
}

}  // namespace graben::cli
