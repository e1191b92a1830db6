// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commission_dozer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "app/cli/console.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/machines/simulated/hidden_dozer.hpp"
#include "app/runs/dozer_commission_run.hpp"

namespace graben::cli {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

commission::DozerOptions planned(const DozerCommission& of,
                                 const machines::SimulatedDozer& machine) {
  commission::DozerOptions options = commission::whole_dozer(machine.profile);
  choose(of.options.choice, options);
  if (!of.options.windows.empty()) {
    commission::read_dozer_windows(of.options.windows, options);
  }
  if (commission::dozer_step_texts(options).empty()) {
    throw std::runtime_error("nothing is left to be tried: " +
                             left_out_text(of.options.choice, options));
  }
  return options;
}

}  // namespace

void choose(const SequenceChoice& choice, commission::DozerOptions& options) {
  if (!choice.no_touch.empty()) {
    throw std::runtime_error("--no-touch: no end of a dozer's stroke is touched");
  }
  for (const std::string& name : choice.only) {
    const bool is_there =
        name == "blade" || name == "tracks" || (name == "tilt" && options.has_tilt);
    if (!is_there) {
      throw std::runtime_error(
          fmt::format("--only {}: the profile has no such drive; it has {}", name,
                      options.has_tilt ? "blade, tilt, tracks" : "blade, tracks"));
    }
  }
  const auto chosen = [&](const char* name) {
    return choice.only.empty() || has(choice.only, name);
  };
  options.blade.drives = {chosen("blade"), options.has_tilt && chosen("tilt"), false};
  options.tracks = chosen("tracks");
  options.blade.steps = !choice.no_steps;
  options.blade.bursts = !choice.no_bursts;
}

/// What is not tried, and what no step can show.
std::string left_out_text(const SequenceChoice& /*choice*/,
                          const commission::DozerOptions& options) {
  std::vector<std::string> out;
  const bool tried[] = {options.blade.drives[0], options.blade.drives[1] || !options.has_tilt,
                        options.tracks};
  for (std::size_t drive = 0; drive < std::size(tried); ++drive) {
    if (!tried[drive]) {
      out.push_back(fmt::format("all of the {}", commission::kDozerDrives[drive]));
    }
  }
  if (!options.blade.steps) {
    out.emplace_back("steps at five speeds");
  }
  if (!options.blade.bursts) {
    out.emplace_back("pulses for the lowest mode");
  }
  return out.empty() ? ""
                     : fmt::format("left out, and so not identified: {}\n", fmt::join(out, ", "));
}

void commission_dozer(const DozerCommission& of) {
  const BusCommission& options = of.options;
  const std::filesystem::path file = machines::find_profile(options.profile);
  machines::SimulatedDozer machine = machines::load_simulated_dozer(file);
  if (of.hidden) {
    machine = machines::hidden_dozer(machine, *of.hidden);
  }
  if (of.seed) {
    machine.plant.seed = *of.seed;
    machine.plant.sensor_errors = true;
    machine.plant.sensors.height_bias_m = 0.0;  // Of a day, which would be no machine's.
  }
  const commission::DozerOptions run = planned(of, machine);
  assert_apart({file.string(), options.windows}, {options.log});
  if (std::filesystem::exists(options.log) && !of.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.log));
  }
  make_folder_of(options.log);
  for (const std::string& line : commission::dozer_window_texts(run)) {
    fmt::print("{}\n", line);
  }
  runs::CommissionResult result;
  {
    ProgressBar bar("commission");
    result = runs::run_dozer_commission(machine, run, options.log, nullptr,
                                        bar.progress_until_stopped());
  }
  const std::vector<std::string> texts = commission::dozer_step_texts(run);
  print_steps(texts, result.steps, [&result](std::size_t at) {
    return fmt::format("{:.0f} mm/s", 1e3 * result.steps[at].speed_mps);
  });
  fmt::print(
      "(took: with the way to its start; duty, of the tracks displacement of the pumps, and speed: "
      "the largest that was tried, that came of it)\n");
  fmt::print("machine time {:.0f} s\nlog {}\n", result.machine_s, options.log);
  if (result.end != runs::CommissionEnd::kDone) {
    throw std::runtime_error(fmt::format("stopped at \"{}\": {}", texts[result.step],
                                         stop_text(result, &commission::dozer_wrong_text)));
  }
  fmt::print("{}{}", left_out_text(options.choice, run), next_text(options));
}

}  // namespace graben::cli
