// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/swing_figures.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::identify {
namespace {

/// Half a window over which a parabola tells speed and acceleration, in grid points.
constexpr std::size_t kHalf = 12;
constexpr std::size_t kEvery = 4;
constexpr double kTurns_radps = 0.04;
/// Least of the acceleration's spread that tells an inertia.
constexpr double kSpread_radps2 = 0.05;
constexpr std::size_t kLeastPoints = 60;
/// A coasting that is worth telling begins at least so fast.
constexpr double kCoasts_radps = 0.10;
constexpr double kStands_radps = 0.01;
constexpr std::size_t kCoastMost = 400;
/// Points next to each other say the same.
constexpr double kAlike = 6.0;

/// Parabola through a window of the angle.
struct Motion {
  double rate_radps = 0.0;
  double change_radps2 = 0.0;
};

Motion motion_at(const std::vector<double>& travel_m, std::size_t at, double lever_m) {
  double first = 0.0;
  double second = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  for (std::size_t k = 1; k <= kHalf; ++k) {
    const double n2 = static_cast<double>(k * k);
    first += static_cast<double>(k) * (travel_m[at + k] - travel_m[at - k]);
    second += n2 * (travel_m[at + k] + travel_m[at - k] - 2.0 * travel_m[at]);
    squares += 2.0 * n2;
    fourths += 2.0 * n2 * n2;
  }
  return {first / squares / kGrid_s / lever_m,
          2.0 * second / fourths / (kGrid_s * kGrid_s) / lever_m};
}

double mean(const std::vector<double>& values, std::size_t at) {
  double sum = 0.0;
  for (std::size_t k = at - kHalf; k <= at + kHalf; ++k) {
    sum += values[k];
  }
  return sum / (2.0 * kHalf + 1.0);
}

bool links_rest(const LogSegment& segment, std::size_t at) {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::vector<double>& stroke_m = segment.axis[axis].stroke_m;
    if (segment.axis[axis].duty[at] != 0.0 ||
        std::abs(stroke_m[at + kHalf] - stroke_m[at - kHalf]) > 0.002) {
      return false;
    }
  }
  return true;
}

Eigen::Vector3d strokes_at(const ExcavatorProfile& profile, const LogSegment& segment,
                           std::size_t at) {
  Eigen::Vector3d strokes_m;
  for (unsigned k = 0; k < kAxisCount; ++k) {
    strokes_m[k] = std::clamp(segment.axis[k].stroke_m[at] - profile.sensor_zero.stroke_m[k], 0.0,
                              profile.geometry.cylinder[k].stroke_m);
  }
  return strokes_m;
}

/// Normal equations of the balance: inertia, friction, and what is left.
struct Balance {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();
  double torque2 = 0.0;
  double changes = 0.0;
  double changes2 = 0.0;
  double links_kgm2 = 0.0;
  std::size_t points = 0;

  void add(const Motion& motion, double torque_nm, double links) {
    const Eigen::Vector3d row(motion.change_radps2, motion.rate_radps > 0.0 ? 1.0 : -1.0, 1.0);
    squares += row * row.transpose();
    moments += torque_nm * row;
    torque2 += torque_nm * torque_nm;
    changes += motion.change_radps2;
    changes2 += motion.change_radps2 * motion.change_radps2;
    links_kgm2 += links;
    ++points;
  }
};

void tell_balance(const ExcavatorProfile& profile, const Balance& of, SwingFigures& swing) {
  if (of.points < kLeastPoints) {
    return;
  }
  const auto count = static_cast<double>(of.points);
  const double spread =
      std::sqrt(std::max(0.0, of.changes2 / count - (of.changes / count) * (of.changes / count)));
  if (spread < kSpread_radps2) {
    return;
  }
  const Eigen::Matrix3d inverse = of.squares.inverse();
  const Eigen::Vector3d found = inverse * of.moments;
  const double left2 =
      std::max(0.0, of.torque2 - found.dot(of.moments)) / std::max(1.0, count - 3.0);
  const double half_out = links_about_swing_kgm2(profile, [&] {
    Eigen::Vector3d middle_m;
    for (unsigned k = 0; k < kAxisCount; ++k) {
      middle_m[k] = 0.5 * profile.geometry.cylinder[k].stroke_m;
    }
    return middle_m;
  }());
  swing.friction_nm = {found[1], std::sqrt(kAlike * left2 * inverse(1, 1)), true};
  const double inertia = found[0] + half_out - of.links_kgm2 / count;
  swing.inertia_kgm2 = {inertia, std::sqrt(kAlike * left2 * inverse(0, 0)),
                        profile.oil.known() && found[0] > 0.0 && inertia > 0.0};
}

/// From a neutral command on, if the platform turned then.
void look_at_coasting(const LogSegment& segment, std::size_t at, double lever_m,
                      SwingFigures& swing) {
  const CylinderSeries& series = segment.axis[kSwing];
  const double from = motion_at(series.stroke_m, at, lever_m).rate_radps;
  if (std::abs(from) < kCoasts_radps) {
    return;
  }
  SwingCoast coast;
  coast.from_radps = std::abs(from);
  std::size_t end = at;
  const auto turns = [&](std::size_t k) {
    return motion_at(series.stroke_m, k, lever_m).rate_radps * from >
           std::abs(from) * kStands_radps;
  };
  while (end + kHalf + 1 < segment.size() && end < at + kCoastMost && series.duty[end] == 0.0 &&
         turns(end)) {
    const double brakes_pa = from > 0.0 ? series.rod_pa[end] : series.cap_pa[end];
    coast.most_pa = std::max(coast.most_pa, brakes_pa);
    ++end;
  }
  const bool stood = end + kHalf + 1 < segment.size() && end < at + kCoastMost;
  if (!stood || series.duty[end] != 0.0) {
    return;  // The log ends, or it was told to move again, before it stood.
  }
  coast.angle_rad = std::abs(series.stroke_m[end] - series.stroke_m[at]) / lever_m;
  coast.time_s = kGrid_s * static_cast<double>(end - at);
  coast.known = true;
  SwingCoast& most = from > 0.0 ? swing.left : swing.right;
  most = coast.from_radps > most.from_radps ? coast : most;
}

}  // namespace

double links_about_swing_kgm2(const ExcavatorProfile& profile, const Eigen::Vector3d& strokes_m) {
  const ExcavatorGeometry& geometry = profile.geometry;
  const Eigen::Vector3d joints_rad = ExcavatorKinematics(geometry).state(strokes_m).joints_rad;
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  double turn_rad = 0.0;
  double pin_m = geometry.boom_foot_m.x();
  double sum_kgm2 = 0.0;
  for (unsigned k = 0; k < kAxisCount; ++k) {
    turn_rad += joints_rad[k];
    const LinkMass& link = profile.oil.link[k];
    const double centre_m =
        pin_m + std::cos(turn_rad) * link.centre_m.x() - std::sin(turn_rad) * link.centre_m.y();
    // A slender link shows the vertical axis what of its length lies across it.
    const double across = std::cos(turn_rad);
    sum_kgm2 += link.mass_kg * centre_m * centre_m + link.inertia_kgm2 * across * across;
    pin_m += length_m[k] * across;
  }
  return sum_kgm2;
}

SwingFigures find_swing(const ExcavatorProfile& profile, const std::vector<MachineLog>& logs) {
  SwingFigures swing;
  if (!profile.has_swing()) {
    return swing;
  }
  const double lever_m = profile.swing.lever_m;
  Balance balance;
  for (const MachineLog& log : logs) {
    for (const LogSegment& segment : log.segments) {
      if (segment.drives <= kSwing) {
        continue;
      }
      const CylinderSeries& series = segment.axis[kSwing];
      for (std::size_t at = kHalf + 1; at + kHalf < segment.size(); ++at) {
        if (series.duty[at] == 0.0 && series.duty[at - 1] != 0.0) {
          look_at_coasting(segment, at, lever_m, swing);
        }
        const Motion motion = at % kEvery == 0 ? motion_at(series.stroke_m, at, lever_m) : Motion{};
        if (std::abs(motion.rate_radps) > kTurns_radps && links_rest(segment, at)) {
          const double torque_nm = profile.swing.displacement_m3prad *
                                   (mean(series.cap_pa, at) - mean(series.rod_pa, at));
          balance.add(motion, torque_nm,
                      links_about_swing_kgm2(profile, strokes_at(profile, segment, at)));
        }
      }
    }
  }
  tell_balance(profile, balance, swing);
  return swing;
}

std::vector<std::string> swing_sentences(const SwingFigures& swing) {
  std::vector<std::string> all;
  for (const bool left : {true, false}) {
    const SwingCoast& coast = left ? swing.left : swing.right;
    if (coast.known) {
      all.push_back(fmt::format(
          "{}: goes on by {:.1f} deg in {:.2f} s from {:.2f} rad/s once its command is neutral, "
          "braked by up to {:.1f} MPa",
          machines::side_name(kSwing, left), kDegreesPerRad * coast.angle_rad, coast.time_s,
          coast.from_radps, 1e-6 * coast.most_pa));
    }
  }
  if (swing.inertia_kgm2.known) {
    all.push_back(
        fmt::format("swing: {:.0f} +- {:.0f} kg m2 with its links half out, friction "
                    "{:.0f} +- {:.0f} N m",
                    swing.inertia_kgm2.value, swing.inertia_kgm2.deviation, swing.friction_nm.value,
                    swing.friction_nm.deviation));
  }
  return all;
}

}  // namespace graben::identify
