// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "app/cli/console.hpp"
#include "app/cli/measure_up.hpp"
#include "app/cli/output_file.hpp"
#include "app/cli/program.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/touch_run.hpp"

namespace graben::cli {
namespace {

std::string touch_stop_text(const runs::TouchRunResult& result) {
  return result.end == runs::TouchEnd::kFault
             ? fmt::format("{} (fault {}). {}", runs::fault_words(result.fault),
                           static_cast<int>(result.fault), runs::fault_help(result.fault))
             : "the edge did not come to the peg in two minutes";
}

/// Which rests of the log are touches: the first is that before it moves.
std::string touches_text(const runs::TouchOptions& run) {
  const auto first = static_cast<std::size_t>(
      std::count_if(run.touches.begin(), run.touches.end(),
                    [](const runs::WantedTouch& touch) { return touch.peg == 0; }));
  const std::size_t all = run.touches.size();
  return all == first
             ? fmt::format("--touches 2-{} ", first + 1)
             : fmt::format("--touches 2-{} --second {}-{} ", first + 1, first + 2, all + 1);
}

}  // namespace

void record_touches(const MeasureUpCommand& options) {
  const machines::SimulatedExcavator machine =
      runs::arranged(machines::load_simulated_excavator(machines::find_profile(options.profile),
                                                        options.simulated),
                     options.scenario);
  if (!machine.profile.imu.known()) {
    throw std::runtime_error(fmt::format(
        "{}: has no [imu]: without IMUs there is nothing to measure up", options.profile));
  }
  runs::TouchOptions run = runs::usual_touches(machine, static_cast<std::size_t>(options.pegs),
                                               static_cast<std::size_t>(options.each));
  run.seed = options.scenario.scenario.seed;
  run.log_file = options.record;
  assert_apart({machines::find_profile(options.profile).string()}, {options.record});
  assert_new(options.record, options.force);
  make_folder_of(options.record);
  runs::TouchRunResult result;
  {
    ProgressBar bar("measure-up");
    result = runs::run_touches(machine, run, bar.progress_until_stopped());
  }
  for (std::size_t n = 0; n < result.off_m.size(); ++n) {
    fmt::print("touch {:>2}  peg {}  the true edge {:.1f} mm off it\n", n + 1,
               run.touches[n].peg + 1, 1e3 * result.off_m[n]);
  }
  for (std::size_t p = 0; p < result.height_m.size(); ++p) {
    fmt::print("peg {} is {:.3f} m over the boom foot's pin, by the level\n", p + 1,
               result.height_m[p]);
  }
  fmt::print("machine time {:.0f} s\nlog {}\n", result.machine_s, options.record);
  if (result.end != runs::TouchEnd::kDone) {
    throw std::runtime_error(
        fmt::format("stopped at touch {}: {}", result.touched + 1, touch_stop_text(result)));
  }
  fmt::print("next: graben measure-up --log {} --profile {} {}--height {:.3f}{} --out NEW.toml\n",
             shell_word(options.record), shell_word(options.profile), touches_text(run),
             result.height_m.front(),
             result.height_m.size() > 1
                 ? fmt::format(" --rise {:.3f}", result.height_m[1] - result.height_m[0])
                 : "");
}

}  // namespace graben::cli
