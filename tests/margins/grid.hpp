// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the margins are looked for: both shipped excavators, poses of their digging path and the
/// corners of their strokes, and all that oil, masses, spools and delay may be. A cell of a table
/// has the worst of its poses and masses.

#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "firmware/excavator/estimation/oil/oil_gains.hpp"
#include "tests/margins/loop_margins.hpp"

namespace graben::margins {

inline constexpr double kOil_gpa[] = {0.6, 0.8, 1.0, 1.4, 2.0, 10.0};
inline constexpr double kLag_s[] = {0.015, 0.020, 0.030, 0.040};
inline constexpr double kMassRatio[] = {0.85, 1.0, 1.15};
inline constexpr int kOils = 6;
inline constexpr int kLags = 4;

enum class Places { kPath, kCorners };

/// What is the same in a whole table.
struct Block {
  Places places = Places::kPath;
  double speed_mps = 0.0;
  int late_cycles = 0;
};

/// What the law is changed by, to see what that does.
struct Changed {
  double assumed_gpa = 0.0;  ///< Instead of the profiles' own, if above 0.
  double gain = 1.0;         ///< Of what is asked for.
  double lead_s = -1.0;      ///< Instead of oil.spool_time_constant, if not below 0.
  OilDesign design;
};

/// A law of the machine as it ships, at a pose.
struct Place {
  std::string name;  ///< As in '22 t, path 3/12'; of a corner 1 is out, in the order of the drives.
  const machines::SimulatedExcavator* machine = nullptr;
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
  Discrete law;
};

struct Worst {
  int cells = 0;
  int unstable = 0;
  double spectral_radius = 0.0;
  /// Of the least alpha, or, if any is not stable, of the largest spectral radius.
  std::string place;
  double mass_ratio = 0.0;
  bool is_arm = false;
  ChannelMargin margin;
  /// Classic, the least of all.
  double gain_up = 0.0;
  double phase_rad = 0.0;
};

/// Not stable goes before any margin.
[[nodiscard]] bool is_worse(const Worst& a, const Worst& b);

class Grid {
 public:
  explicit Grid(const Changed& changed);

  [[nodiscard]] Worst worst(const Block& block, double oil_gpa, double lag_s) const;

 private:
  void add(const machines::SimulatedExcavator& machine, const std::string& name,
           const Changed& changed);

  std::vector<machines::SimulatedExcavator> machines_;
  std::vector<Place> path_;
  std::vector<Place> corners_;
};

}  // namespace graben::margins
