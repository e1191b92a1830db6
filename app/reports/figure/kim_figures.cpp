// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "app/reports/figure/figure_table.hpp"
#include "app/reports/figure/paper_figures.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {
namespace {

using runs::DigSample;

// As the captions name them.
constexpr std::array<const char*, kAxisCount> kDriveColours = {"#1f4fd6", "#1c8c3c", "#d62222"};
constexpr std::array<const char*, kAxisCount> kDriveNames = {"boom", "arm", "bucket"};
constexpr const char* kBlue = "#1f4fd6";
constexpr const char* kGreen = "#1c8c3c";
constexpr const char* kRed = "#d62222";
constexpr const char* kBlack = "#000000";
constexpr const char* kTime = "time (s)";
constexpr double kMarkEvery_s = 5.0;

struct Run {
  const machines::SimulatedExcavator& machine;
  const runs::DigResult& result;
  const runs::DigSummary& summary;
};

/// From when the path was reached, as the paper's runs begin on it.
std::vector<DigSample> on_path(const Run& run) {
  std::vector<DigSample> samples;
  std::copy_if(run.result.samples.begin(), run.result.samples.end(), std::back_inserter(samples),
               [](const DigSample& sample) { return sample.on_path; });
  if (samples.empty()) {
    throw std::runtime_error("--figure: the path was not reached, so there is nothing to draw");
  }
  const double begin_s = samples.front().time_s;
  for (DigSample& sample : samples) {
    sample.time_s -= begin_s;
  }
  return samples;
}

FigureCurve over_time(const std::vector<DigSample>& samples, const std::string& label,
                      const std::string& colour, bool dotted,
                      const std::function<double(const DigSample&)>& of) {
  FigureCurve curve{label, colour, {}, {}, dotted};
  for (const DigSample& sample : samples) {
    curve.x.push_back(sample.time_s);
    curve.y.push_back(of(sample));
  }
  return curve;
}

std::string millimetres(double value_m) { return fmt::format("{:.1f} mm", 1e3 * value_m); }

/// 9 and 14: the way in the vertical plane.
FigurePanel way(const Run& run, const std::vector<DigSample>& samples) {
  FigurePanel panel{"x (m)", "y (m)", {}, {}, true};
  FigureCurve wanted{"wanted", kBlue, {}, {}, true};
  const RoundedRectangle path(run.machine.profile.dig_path);
  constexpr int kPoints = 400;
  for (int i = 0; i <= kPoints; ++i) {
    const Eigen::Vector2d at_m = path.at_share(static_cast<double>(i) / kPoints).position_m;
    wanted.x.push_back(at_m.x());
    wanted.y.push_back(at_m.y());
  }
  FigureCurve tip{"bucket tip", kRed, {}, {}, false};
  double next_s = 0.0;
  for (const DigSample& sample : samples) {
    tip.x.push_back(sample.tip_true_m.x());
    tip.y.push_back(sample.tip_true_m.y());
    if (sample.time_s >= next_s - 1e-9) {
      panel.marks.push_back({tip.x.back(), tip.y.back(),
                             fmt::format("{:.0f}", sample.attitude_true_rad * kDegreesPerRad)});
      next_s += kMarkEvery_s;
    }
  }
  if (run.machine.plant.soil) {
    const auto [low, high] = std::minmax_element(wanted.x.begin(), wanted.x.end());
    const double ground_m = run.machine.plant.soil->ground_y_m;
    panel.curves.push_back({"ground", kBlack, {*low, *high}, {ground_m, ground_m}, true});
  }
  panel.curves.push_back(wanted);
  panel.curves.push_back(tip);
  return panel;
}

PaperFigure kim9(const Run& run, const std::vector<DigSample>& samples) {
  const DigPath& path = run.machine.profile.dig_path;
  return {"",
          "Bucket tip and its angle to the ground every 5 s (degrees) while it moves in soil.",
          {way(run, samples)},
          {{"largest path error", "46 mm", millimetres(run.summary.max_error_true_m)},
           {"ground, y", "-1 m", fmt::format("{:.3g} m", run.machine.plant.soil->ground_y_m)},
           {"wanted angle at x = 3.5 m", "45 deg",
            fmt::format("{:.0f} deg at {:.1f} m", path.attitude_at_x_min_rad * kDegreesPerRad,
                        path.x_min_m)},
           {"wanted angle at x = 6.5 m", "120 deg",
            fmt::format("{:.0f} deg at {:.1f} m", path.attitude_at_x_max_rad * kDegreesPerRad,
                        path.x_max_m)}}};
}

PaperFigure kim10(const Run& run, const std::vector<DigSample>& samples) {
  double sum_n = 0.0;
  double most_n = 0.0;
  std::size_t count = 0;
  for (const DigSample& sample : samples) {
    if (sample.tip_true_m.y() <
        run.machine.plant.soil->ground_y_m - run.machine.plant.soil->ramp_m) {
      sum_n += sample.tip_force_n.x();
      ++count;
    }
    most_n = std::max(most_n, sample.tip_force_n.x());
  }
  const plant::SoilProfile& soil = *run.machine.plant.soil;
  FigurePanel panel{kTime, "force (kN)", {}, {}, false};
  panel.curves = {over_time(samples, "x", kBlue, false,
                            [](const DigSample& s) { return 1e-3 * s.tip_force_n.x(); }),
                  over_time(samples, "y", kRed, false,
                            [](const DigSample& s) { return 1e-3 * s.tip_force_n.y(); })};
  return {"",
          "Resistive force that the soil puts on the bucket tip.",
          {panel},
          {{"bias of the sinusoid, x and y", "50 and 30 kN",
            fmt::format("{:.0f} and {:.0f} kN", 1e-3 * soil.bias_n.x(), 1e-3 * soil.bias_n.y())},
           {"mean of the force along x in whole depth", "-",
            count > 0 ? fmt::format("{:.1f} kN", 1e-3 * sum_n / static_cast<double>(count))
                      : std::string("not that deep")},
           {"most along x", "-", fmt::format("{:.1f} kN", 1e-3 * most_n)}}};
}

FigurePanel lambda_panel(const std::vector<DigSample>& samples) {
  return {kTime,
          "lambda",
          {over_time(samples, "", kBlue, false, [](const DigSample& s) { return s.lambda; })},
          {},
          false};
}

PaperFigure kim11(const Run& run, const std::vector<DigSample>& samples) {
  return {"",
          "Speed scaling factor lambda while the bucket moves in soil.",
          {lambda_panel(samples)},
          {{"least lambda", "-", fmt::format("{:.3f}", run.summary.lambda_min)}}};
}

PaperFigure kim12(const Run& run, const std::vector<DigSample>& samples) {
  FigurePanel panel{kTime, "spool command, of its travel", {}, {}, false};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    panel.curves.push_back(over_time(samples, kDriveNames[i], kDriveColours[i], false,
                                     [i](const DigSample& s) { return s.spool_command[i]; }));
  }
  return {"",
          "Spool commands of boom (blue), arm (green) and bucket (red) in soil.",
          {panel},
          {{"rate of the commands", "100 Hz",
            fmt::format("{:.0f} Hz", static_cast<double>(samples.size() - 1) /
                                         std::max(1e-9, samples.back().time_s))},
           {"dead band of the spools, either side", "0.2 of the travel",
            fmt::format("{:.2f} (boom, extending)",
                        run.machine.plant.spool[0].extend.deadband_ratio)}}};
}

PaperFigure kim13(const Run& /*run*/, const std::vector<DigSample>& samples) {
  PaperFigure figure;
  figure.caption = "Scaled target velocities (green, dotted) and true ones (blue) of the strokes.";
  for (unsigned i = 0; i < kAxisCount; ++i) {
    figure.panels.push_back(
        {kTime,
         fmt::format("{} (m/s)", kDriveNames[i]),
         {over_time(samples, "true", kBlue, false,
                    [i](const DigSample& s) { return s.velocity_real_mps[i]; }),
          over_time(samples, "target", kGreen, true,
                    [i](const DigSample& s) { return s.velocity_wanted_mps[i]; })},
         {},
         false});
  }
  return figure;
}

PaperFigure kim14(const Run& run, const std::vector<DigSample>& samples) {
  return {"",
          "Bucket tip and its angle every 5 s (degrees); an obstacle holds it for a while and "
          "lets go.",
          {way(run, samples)},
          {{"path error afterwards, most", "-", millimetres(run.summary.recovery->error_max_m)}}};
}

PaperFigure kim15(const Run& run, const std::vector<DigSample>& samples) {
  FigurePanel speed{kTime, "tip velocity (m/s)", {}, {}, false};
  speed.curves = {over_time(samples, "x", kBlue, false,
                            [](const DigSample& s) { return s.velocity_true_mps.x(); }),
                  over_time(samples, "y", kRed, false,
                            [](const DigSample& s) { return s.velocity_true_mps.y(); })};
  return {"",
          "The tip's velocity vanishes at the obstacle, lambda with it, and comes back after it.",
          {speed, lambda_panel(samples)},
          {{"lambda while it holds", "goes to 0",
            fmt::format("{:.3f} at least", run.summary.recovery->lambda_held)}}};
}

using Draw = PaperFigure (*)(const Run&, const std::vector<DigSample>&);
constexpr std::array<std::pair<const char*, Draw>, 7> kFigures = {{{"kim9", kim9},
                                                                   {"kim10", kim10},
                                                                   {"kim11", kim11},
                                                                   {"kim12", kim12},
                                                                   {"kim13", kim13},
                                                                   {"kim14", kim14},
                                                                   {"kim15", kim15}}};

}  // namespace

const std::vector<std::string>& kim_figure_names() {
  static const std::vector<std::string> names = names_of(kFigures);
  return names;
}

void assert_kim_figures(const std::vector<std::string>& names,
                        const machines::SimulatedExcavator& machine, bool meets_obstacle) {
  for (const std::string& name : names) {
    const bool is_of_obstacle = name == "kim14" || name == "kim15";
    if (is_of_obstacle && !meets_obstacle) {
      throw std::runtime_error(fmt::format(
          "--figure {}: is of a run that meets and passes a rock; add --obstacle", name));
    }
    if (!is_of_obstacle && !machine.plant.soil) {
      throw std::runtime_error(fmt::format("--figure {}: is of a run in soil; add --soil", name));
    }
  }
}

PaperFigure kim_figure(const std::string& name, const machines::SimulatedExcavator& machine,
                       const runs::DigResult& result, const runs::DigSummary& summary) {
  assert_kim_figures({name}, machine, summary.recovery.has_value());
  const Run run{machine, result, summary};
  PaperFigure figure = draw_of(kFigures, name)(run, on_path(run));
  figure.name = name;
  figure.caption = fmt::format("Kim et al., Fig. {}. {} Here: simulated {}.", name.substr(3),
                               figure.caption, machine.name);
  return figure;
}

}  // namespace graben::reports
