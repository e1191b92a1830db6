// SPDX-License-Identifier: Apache-2.0
#include "tests/margins/grid.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "tests/margins/shipped_law.hpp"

namespace graben::margins {
namespace {

constexpr int kPathPoses = 12;
/// A cylinder's end is left to its cushion.
constexpr double kCornerShare = 0.02;
constexpr double kPaPerGpa = 1e9;

Eigen::Vector3d on_path(const ExcavatorProfile& profile, double share) {
  const PathPoint point = RoundedRectangle(profile.dig_path).at_share(share);
  return machines::strokes_at(profile,
                              {point.position_m.x(), point.position_m.y(), point.attitude_rad});
}

Eigen::Vector3d at_corner(const ExcavatorProfile& profile, unsigned corner) {
  Eigen::Vector3d strokes_m;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const double share = (corner >> axis & 1U) != 0 ? 1.0 - kCornerShare : kCornerShare;
    strokes_m[axis] = share * profile.geometry.cylinder[axis].stroke_m;
  }
  return strokes_m;
}

void take(const LoopMargins& margins, const Place& place, double mass_ratio, Worst& worst) {
  const bool is_first = worst.cells == 0;
  const bool is_worse =
      margins.stable() ? worst.unstable == 0 && (is_first || margins.alpha() < worst.margin.alpha)
                       : worst.unstable == 0 || margins.spectral_radius > worst.spectral_radius;
  if (is_worse) {
    worst.place = place.name;
    worst.mass_ratio = mass_ratio;
    worst.is_arm = margins.channel[1].alpha < margins.channel[0].alpha;
    worst.margin = margins.channel[worst.is_arm ? 1 : 0];
  }
  worst.spectral_radius = std::max(worst.spectral_radius, margins.spectral_radius);
  for (const ChannelMargin& channel : margins.channel) {
    worst.gain_up = is_first ? channel.gain_up : std::min(worst.gain_up, channel.gain_up);
    worst.phase_rad = is_first ? channel.phase_rad : std::min(worst.phase_rad, channel.phase_rad);
  }
  ++worst.cells;
  worst.unstable += margins.stable() ? 0 : 1;
}

}  // namespace

bool is_worse(const Worst& a, const Worst& b) {
  return a.unstable > 0 ? a.spectral_radius > b.spectral_radius : a.margin.alpha < b.margin.alpha;
}

Grid::Grid(const Changed& changed) {
  const std::string names[] = {"22t", "12t"};
  for (const std::string& name : names) {
    machines_.push_back(
        machines::load_simulated_excavator(machines::find_profile("excavator_" + name)));
    OilProfile& oil = machines_.back().profile.oil;
    oil.bulk_modulus_pa =
        changed.assumed_gpa > 0.0 ? kPaPerGpa * changed.assumed_gpa : oil.bulk_modulus_pa;
    oil.spool_time_constant_s = changed.lead_s >= 0.0 ? changed.lead_s : oil.spool_time_constant_s;
  }
  for (std::size_t n = 0; n < machines_.size(); ++n) {
    add(machines_[n], names[n], changed);
  }
}

void Grid::add(const machines::SimulatedExcavator& machine, const std::string& name,
               const Changed& changed) {
  const OilGains gains{changed.design};
  const auto placed = [&](const std::string& where, const Eigen::Vector3d& strokes_m) {
    Place place = {name + " " + where, &machine, strokes_m,
                   as_matrices(LawInTime(machine.profile, gains, strokes_m))};
    place.law.c *= changed.gain;
    place.law.d *= changed.gain;
    return place;
  };
  for (int n = 0; n < kPathPoses; ++n) {
    path_.push_back(placed("path " + std::to_string(n) + "/" + std::to_string(kPathPoses),
                           on_path(machine.profile, static_cast<double>(n) / kPathPoses)));
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::string where = "corner ";
    for (unsigned axis = 0; axis < kAxisCount; ++axis) {
      where += (corner >> axis & 1U) != 0 ? '1' : '0';
    }
    corners_.push_back(placed(where, at_corner(machine.profile, corner)));
  }
}

Worst Grid::worst(const Block& block, double oil_gpa, double lag_s) const {
  Worst worst;
  Truth truth;
  truth.bulk_modulus_pa = kPaPerGpa * oil_gpa;
  truth.spool_time_constant_s = lag_s;
  truth.late_cycles = block.late_cycles;
  truth.speed_mps = block.speed_mps;
  for (const Place& place : block.places == Places::kPath ? path_ : corners_) {
    for (const double mass_ratio : kMassRatio) {
      truth.mass_ratio = mass_ratio;
      take(loop_margins(place.law, linkage_on_oil(place.machine->plant, place.strokes_m, truth)),
           place, mass_ratio, worst);
    }
  }
  return worst;
}

}  // namespace graben::margins
