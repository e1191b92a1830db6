// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "app/reports/figure/paper_figures.hpp"

namespace graben::reports {
namespace {

using runs::GradeSample;

constexpr const char* kBlue = "#1f4fd6";
constexpr const char* kRed = "#d62222";
constexpr const char* kBlack = "#000000";
constexpr const char* kDistance = "x of the blade's edge (m)";
constexpr double kLitresPerMinute = 60000.0;  // Of a m^3/s.

using Of = std::function<double(const GradeSample&)>;

std::vector<GradeSample> over_grade(const runs::GradeResult& result) {
  std::vector<GradeSample> samples;
  std::copy_if(result.samples.begin(), result.samples.end(), std::back_inserter(samples),
               [](const GradeSample& sample) { return sample.over_grade && sample.pass == 1; });
  if (samples.empty()) {
    throw std::runtime_error("--figure: the grade was not reached, so there is nothing to draw");
  }
  return samples;
}

FigureCurve over_distance(const std::vector<GradeSample>& samples, const std::string& label,
                          const char* colour, bool dotted, const Of& of) {
  FigureCurve curve{label, colour, {}, {}, dotted};
  for (const GradeSample& sample : samples) {
    curve.x.push_back(sample.edge_m.x());
    curve.y.push_back(of(sample));
  }
  return curve;
}

FigurePanel elevation(const std::vector<GradeSample>& samples) {
  return {kDistance,
          "elevation (m)",
          {over_distance(samples, "edge", kBlue, false,
                         [](const GradeSample& s) { return s.edge_m.y(); }),
           over_distance(samples, "design", kBlack, true,
                         [](const GradeSample& s) { return s.design_m; })},
          {},
          false};
}

FigurePanel error(const std::vector<GradeSample>& samples) {
  return {kDistance,
          "elevation error (m)",
          {over_distance(samples, "", kBlue, false,
                         [](const GradeSample& s) { return s.error_true_m; })},
          {},
          false};
}

FigurePanel flow(const std::vector<GradeSample>& samples) {
  return {
      kDistance,
      "flow (L/min)",
      {over_distance(samples, "required", kBlue, false,
                     [](const GradeSample& s) { return kLitresPerMinute * s.flow_required_m3ps; }),
       over_distance(
           samples, "available", kBlack, false,
           [](const GradeSample& s) { return kLitresPerMinute * s.flow_available_m3ps; })},
      {},
      false};
}

FigurePanel speed(const std::vector<GradeSample>& samples, bool with_limit) {
  FigurePanel panel{kDistance, "travel velocity (m/s)", {}, {}, false};
  if (with_limit) {
    panel.curves.push_back(over_distance(samples, "greatest", kRed, false,
                                         [](const GradeSample& s) { return s.speed_limit_mps; }));
  }
  panel.curves.push_back(over_distance(samples, "command", kBlue, with_limit,
                                       [](const GradeSample& s) { return s.speed_wanted_mps; }));
  return panel;
}

std::string metres(double value_m) { return fmt::format("{:.4f} m", value_m); }

double most(const std::vector<GradeSample>& samples, const Of& of) {
  double found = of(samples.front());
  for (const GradeSample& sample : samples) {
    found = std::max(found, of(sample));
  }
  return found;
}

}  // namespace

bool is_of_constant_speed(const std::string& name) { return name == "mononen9"; }

const std::vector<std::string>& mononen_figure_names() {
  static const std::vector<std::string> names = {"mononen7", "mononen8", "mononen9"};
  return names;
}

void assert_mononen_figures(const std::vector<std::string>& names, bool is_constant_speed) {
  for (const std::string& name : names) {
    const bool is_of_constant = is_of_constant_speed(name);
    if (is_of_constant != is_constant_speed) {
      throw std::runtime_error(fmt::format(
          "--figure {}: is of a {} speed; {} --speed-mode constant", name,
          is_of_constant ? "constant" : "bounded", is_of_constant ? "add" : "leave out"));
    }
  }
}

PaperFigure mononen_figure(const std::string& name, bool is_constant_speed,
                           const machines::SimulatedDozer& machine, const runs::GradeResult& result,
                           const runs::GradeSummary& summary) {
  assert_mononen_figures({name}, is_constant_speed);
  const bool is_of_constant = is_of_constant_speed(name);
  const std::vector<GradeSample> samples = over_grade(result);
  const std::string within = metres(summary.max_error_true_m);
  PaperFigure figure;
  figure.name = name;
  std::string caption;
  if (name == "mononen8") {
    caption = "Greatest travel velocity, by (14) without the wanted one, and the command.";
    figure.panels = {speed(samples, true)};
    figure.numbers = {{"greatest velocity that engine and transmission allow", "1.8 m/s",
                       fmt::format("{:.2f} m/s", most(samples, [](const GradeSample& s) {
                                     return s.speed_limit_mps;
                                   }))}};
  } else {
    caption =
        is_of_constant
            ? "The trench with a constant velocity that keeps the flow within its bounds."
            : "Blade elevation and its error, commanded velocity, required and available flow.";
    figure.panels = {elevation(samples), error(samples), speed(samples, false), flow(samples)};
    figure.numbers = {
        {"edge off the grade, most", is_of_constant ? "as in Fig. 7" : "0.02 m", within},
        {"time", is_of_constant ? "27 s (at 1 m/s)" : "22 s (at 1.6 m/s)",
         fmt::format("{:.1f} s (at {:.2f} m/s at most)", summary.time_s,
                     most(samples, [](const GradeSample& s) { return s.speed_wanted_mps; }))},
        {"required flow over the available, most", "mostly below 1",
         fmt::format("{:.2f}", summary.flow_share_max)}};
  }
  figure.caption = fmt::format("Mononen and Mattila, Fig. {}. {} Here: simulated {}.",
                               name.substr(7), caption, machine.name);
  return figure;
}

}  // namespace graben::reports
