// SPDX-License-Identifier: Apache-2.0
// commission_lies: a stroke sensor that lies while hidden machines are commissioned and identified,
// a line each: how it ended, how far the true tool was off, and what the log says of each cylinder.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdlib>
#include <exception>

#include "app/identify/machine/judged_fit.hpp"
#include "app/identify/machine/log_checks.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "app/identify/machine/stroke_scale.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/identify_run.hpp"
#include "app/runs/plant_faults.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "tests/unit/operate/commission_bench.hpp"

namespace {

using namespace graben;

struct Wanted {
  std::string profile = "excavator_22t";
  std::vector<std::string> faults;
  std::uint64_t seeds = 20;
  std::uint64_t first = 1;
  bool ends = false;  ///< The ends of the strokes are free.
};

commission::SequenceOptions sequence_of(const machines::SimulatedExcavator& machine, bool ends) {
  commission::SequenceOptions options = commission::whole_sequence(machine.profile);
  for (unsigned k = 0; k < kAxisCount && !ends; ++k) {
    options.window[k].least_m = 0.05 * options.stroke_m[k];
    options.window[k].most_m = 0.95 * options.stroke_m[k];
    options.touch_extended[k] = false;
    options.touch_retracted[k] = false;
  }
  return options;
}

identify::LoggedFrame logged(const CanFrame& frame) {
  identify::LoggedFrame line;
  line.time_s = 1e-6 * static_cast<double>(frame.stamp_us);
  line.id = frame.id;
  line.extended = frame.extended;
  line.length = frame.length;
  line.data = frame.data;
  return line;
}

/// Of the teeth by the true strokes from those by the shown ones, both since the beginning.
struct ToolOff {
  explicit ToolOff(const test::CommissionBench& of)
      : bench(of), bias_m(shown_m() - of.strokes_m()) {}
  [[nodiscard]] Eigen::Vector3d shown_m() const {
    Eigen::Vector3d shown;
    for (unsigned k = 0; k < kAxisCount; ++k) {
      shown[k] = bench.heard.strokes_m(bench.now_us)[k].value_or(bench.strokes_m()[k]);
    }
    return shown;
  }
  [[nodiscard]] double now_m() const {
    const ExcavatorKinematics kinematics(bench.machine.profile.geometry);
    Eigen::Vector3d shown = shown_m() - bias_m;
    for (unsigned k = 0; k < kAxisCount; ++k) {
      shown[k] = std::clamp(shown[k], 0.0, bench.machine.profile.geometry.cylinder[k].stroke_m);
    }
    const TipPose a = kinematics.state(shown).tip;
    const TipPose b = kinematics.state(bench.strokes_m()).tip;
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  }
  const test::CommissionBench& bench;
  Eigen::Vector3d bias_m;
};

void print_factors(const identify::MachineEstimate& found) {
  for (const identify::DriveEstimate& drive : found.drive) {
    fmt::print(" |");
    for (const bool extends : {true, false}) {
      const identify::SideEstimate& side = drive.side(extends);
      fmt::print(" {:.2f}+-{:.2f} {:.2f}+-{:.2f}", side.coefficient_factor.value,
                 side.coefficient_factor.deviation, side.out_area_factor.value,
                 side.out_area_factor.deviation);
    }
  }
  for (const identify::StrokeScale& scale : identify::stroke_scales(found)) {
    fmt::print(" {:.2f}{}", scale.ratio, scale.known ? "" : "?");
  }
  fmt::print(" | pumps {:.2f} {:.2f}", found.pump_flow_factor[0].value,
             found.pump_flow_factor[1].value);
}

void try_one(const Wanted& asked, std::uint64_t seed) {
  const machines::SimulatedExcavator nominal =
      machines::load_simulated_excavator(machines::find_profile(asked.profile));
  const machines::SimulatedExcavator hidden = runs::hidden_with_noise(nominal, seed);
  test::CommissionBench bench(hidden, sequence_of(hidden, asked.ends));
  identify::LogCollector frames("bus");
  bench.bus.set_tap([&](const CanFrame& frame) { frames.take(logged(frame)); });
  for (const std::string& text : asked.faults) {
    const runs::ToldFault fault = runs::told_fault(text + "@0");
    runs::excavator_plant_faults().at(fault.name)(bench.plant.faults(), fault.value);
  }
  bench.run(2.0);
  const ToolOff off(bench);
  bench.hands.deadman = true;
  double most_m = 0.0;
  double begun_s = 1e-6 * static_cast<double>(bench.now_us);
  bench.run_until(
      [&] {
        most_m = std::max(most_m, off.now_m());
        return bench.station->end() != operate::CommissionEnd::kNone;
      },
      600.0);
  const bool done = bench.station->end() == operate::CommissionEnd::kDone;
  fmt::print("{:3} {:5.1f} s off {:.2f} m {}", seed,
             1e-6 * static_cast<double>(bench.now_us) - begun_s, most_m,
             done ? "done" : bench.station->end_words());
  if (done) {
    bench.run(0.5);
    try {
      const auto fit = identify::fit_and_judge(
          hidden.profile,
          {frames.log(hidden.profile.pump_count, identify::swing_lever_m(hidden.profile))},
          [](double, const std::string&) {});
      fmt::print(" {}", fit.is_better() ? "better" : "not better");
      print_factors(fit.machine);
    } catch (const std::exception& error) {
      fmt::print(" {}", error.what());
    }
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("A stroke sensor that lies in commissioning, with many hidden machines.");
  Wanted asked;
  app.add_option("--profile", asked.profile, "machine");
  app.add_option("--fault", asked.faults, "NAME or NAME=VALUE, as `graben plant --fault` has them");
  app.add_option("--seeds", asked.seeds, "how many");
  app.add_option("--first-seed", asked.first, "the first");
  app.add_flag("--ends", asked.ends, "the ends of the strokes are free");
  CLI11_PARSE(app, count, words);
  try {
    for (std::uint64_t n = 0; n < asked.seeds; ++n) {
      try_one(asked, asked.first + n);
    }
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "commission_lies: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
