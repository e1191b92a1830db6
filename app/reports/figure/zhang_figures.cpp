// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "app/machines/axis_names.hpp"
#include "app/reports/figure/figure_table.hpp"
#include "app/reports/figure/paper_figures.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {
namespace {

using runs::PlanSample;
using Samples = std::vector<PlanSample>;
using Of = std::function<double(const PlanSample&)>;

constexpr double kMm = 1e3;
constexpr const char* kBlue = "#1f4fd6";
constexpr const char* kGreen = "#1c8c3c";
constexpr const char* kRed = "#d62222";
constexpr const char* kBlack = "#000000";
constexpr const char* kTime = "time (s)";
/// The order of DriveVector.
constexpr std::array<const char*, kDriveCount> kColours = {kBlue, kGreen, kRed, kBlack};

/// J and K of the paper's flattening: x, y, z in m, attitude in degrees.
constexpr std::array<double, 4> kJ = {0.0, 6.866, 0.0, 130.0};
constexpr std::array<double, 4> kK = {2.244, 3.886, 0.0, 70.0};

bool is_at(const PlanSample& sample, const std::array<double, 4>& pose) {
  constexpr double kWithin_m = 1e-3;
  constexpr double kWithin_deg = 0.1;
  const auto is_near = [&](unsigned i) {
    return std::abs(sample.teeth_m[i] - pose[i]) < kWithin_m;
  };
  return is_near(0) && is_near(1) && is_near(2) &&
         std::abs(sample.attitude_rad * kDegreesPerRad - pose[3]) < kWithin_deg;
}

std::string pose_text(const PlanSample& sample) {
  return fmt::format("({:.0f}, {:.0f}, {:.0f}, {:.0f})", kMm * sample.teeth_m[0],
                     kMm * sample.teeth_m[1], kMm * sample.teeth_m[2] + 0.0,
                     sample.attitude_rad * kDegreesPerRad);
}

FigureCurve over_time(const Samples& samples, const std::string& label, const char* colour,
                      const Of& of) {
  FigureCurve curve{label, colour, {}, {}, false};
  for (const PlanSample& sample : samples) {
    curve.x.push_back(sample.time_s);
    curve.y.push_back(of(sample));
  }
  return curve;
}

FigurePanel panel(const std::string& y_title, std::vector<FigureCurve> curves) {
  return {kTime, y_title, std::move(curves), {}, false};
}

double most(const Samples& samples, const Of& of) {
  double found = of(samples.front());
  for (const PlanSample& sample : samples) {
    found = std::max(found, of(sample));
  }
  return found;
}

double speed(const PlanSample& sample) { return kMm * sample.speed_mps; }

PaperFigure zhang5(const Samples& samples) {
  const PlanSample& end = samples.back();
  return {"",
          "Displacement and velocity of the bucket's teeth.",
          {panel("displacement (mm)",
                 {over_time(samples, "", kBlue, [](const auto& s) { return kMm * s.way_m; })}),
           panel("velocity (mm/s)", {over_time(samples, "", kBlue, speed)})},
          {{"displacement", "3746.4 mm", fmt::format("{:.1f} mm", kMm * end.way_m)},
           {"planning time", "18.4 s", fmt::format("{:.1f} s", end.time_s)},
           {"mean speed, by these two", "203.6 mm/s",
            fmt::format("{:.1f} mm/s", kMm * end.way_m / end.time_s)},
           // Less than the mean: a misprint, and shown as one.
           {"maximum speed", "15 mm/s (sic)", fmt::format("{:.0f} mm/s", most(samples, speed))}}};
}

FigurePanel along(const Samples& samples, unsigned axis, const std::string& title) {
  return panel(title, {over_time(samples, "", kBlue,
                                 [axis](const auto& s) { return kMm * s.teeth_m[axis]; })});
}

std::vector<PaperNumber> ends(const Samples& samples) {
  return {{"from J: x, y, z in mm, attitude in degrees", "(0, 6866, 0, 130)",
           pose_text(samples.front())},
          {"to K", "(2244, 3886, 0, 70)", pose_text(samples.back())}};
}

PaperFigure zhang6(const Samples& samples) {
  return {"",
          "Position of the bucket's teeth along each axis, and their attitude.",
          {along(samples, 0, "x (mm)"), along(samples, 1, "y (mm)"), along(samples, 2, "z (mm)"),
           panel("attitude (deg)",
                 {over_time(samples, "", kBlue,
                            [](const auto& s) { return s.attitude_rad * kDegreesPerRad; })})},
          ends(samples)};
}

/// Off the straight line from the first place to the last.
double off_line_m(const Samples& samples) {
  const Eigen::Vector3d from_m(samples.front().teeth_m.data());
  const Eigen::Vector3d ahead =
      (Eigen::Vector3d(samples.back().teeth_m.data()) - from_m).normalized();
  return most(samples, [&](const PlanSample& sample) {
    return (Eigen::Vector3d(sample.teeth_m.data()) - from_m).cross(ahead).norm();
  });
}

PaperFigure zhang7(const Samples& samples) {
  FigurePanel above{"x (mm)", "y (mm)", {}, {}, true};
  FigureCurve way{"bucket's teeth, from above; a dot each second", kBlue, {}, {}, false};
  double next_s = 0.0;
  for (const PlanSample& sample : samples) {
    way.x.push_back(kMm * sample.teeth_m[0]);
    way.y.push_back(kMm * sample.teeth_m[1]);
    if (sample.time_s >= next_s - 1e-9) {
      above.marks.push_back({way.x.back(), way.y.back(), ""});
      next_s += 1.0;
    }
  }
  above.marks.push_back({way.x.front(), way.y.front(), "J"});
  above.marks.push_back({way.x.back(), way.y.back(), "K"});
  above.curves = {way};
  std::vector<PaperNumber> numbers = ends(samples);
  numbers.push_back(
      {"off the straight line, most", "-", fmt::format("{:.3f} mm", kMm * off_line_m(samples))});
  return {
      "",
      "Trajectory of the bucket's teeth; control points lie closer where it speeds up and slows "
      "down.",
      {above},
      numbers};
}

/// 8 to 10: one panel for the strokes, one for the swing.
PaperFigure of_drives(const Samples& samples, const std::string& caption, const std::string& unit,
                      const std::array<double, kDriveCount> PlanSample::*values) {
  std::vector<FigureCurve> strokes;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    strokes.push_back(over_time(samples, machines::kDriveNames[i], kColours[i],
                                [=](const auto& s) { return kMm * (s.*values)[i]; }));
  }
  return {"",
          caption,
          {panel(fmt::format("strokes (mm{})", unit), strokes),
           panel(fmt::format("swing (deg{})", unit),
                 {over_time(samples, machines::kDriveNames[kSwing], kColours[kSwing],
                            [=](const auto& s) { return (s.*values)[kSwing] * kDegreesPerRad; })})},
          {}};
}

PaperFigure zhang8(const Samples& samples) {
  return of_drives(samples, "Displacement of each actuator.", "", &PlanSample::displacement);
}
PaperFigure zhang9(const Samples& samples) {
  return of_drives(samples, "Velocity of each actuator.", "/s", &PlanSample::velocity);
}
PaperFigure zhang10(const Samples& samples) {
  return of_drives(samples, "Acceleration of each actuator.", "/s2", &PlanSample::acceleration);
}

using Draw = PaperFigure (*)(const Samples&);
constexpr std::array<std::pair<const char*, Draw>, 6> kFigures = {{{"zhang5", zhang5},
                                                                   {"zhang6", zhang6},
                                                                   {"zhang7", zhang7},
                                                                   {"zhang8", zhang8},
                                                                   {"zhang9", zhang9},
                                                                   {"zhang10", zhang10}}};

}  // namespace

const std::vector<std::string>& zhang_figure_names() {
  static const std::vector<std::string> names = names_of(kFigures);
  return names;
}

PaperFigure zhang_figure(const std::string& name, const std::string& machine,
                         const Samples& samples) {
  if (!is_at(samples.front(), kJ) || !is_at(samples.back(), kK)) {
    throw std::runtime_error(
        fmt::format("--figure {}: is of the paper's line, from (0, 6.866, 0) m at 130 degrees to "
                    "(2.244, 3.886, 0) m at 70; excavator_12t has it without --from and --to",
                    name));
  }
  PaperFigure figure = draw_of(kFigures, name)(samples);
  figure.name = name;
  figure.caption = fmt::format("Zhang et al., Fig. {}. {} Here: planned for {}.", name.substr(5),
                               figure.caption, machine);
  return figure;
}

}  // namespace graben::reports
