// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a task makes of the ground: section [design], as a foreman says it or a file has it.

#include <filesystem>
#include <memory>

#include "app/machines/height_grid.hpp"
#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

/// Where a task's design is read for.
struct DesignPlaces {
  SiteFrame site;                ///< Places of the design are the site's.
  bool has_site = false;         ///< Else they are the machine's.
  bool by_touch = false;         ///< Where the machine stands is not known yet.
  std::filesystem::path folder;  ///< A file is looked for beside it.
};

/// A plane, or the memory of a surface.
struct TaskDesign {
  bool is_plane = true;
  DesignPlane plane;
  std::shared_ptr<const HeldSurface> surface;  ///< Null where something was wrong.
};

/// A plane through a point by its normal, or by its slope, cross slope and heading, a depth under
/// it; or a ditch; or a file of heights. `digs`: steps have to keep a clearance from a plane.
/// Errors are the reader's.
[[nodiscard]] TaskDesign read_task_design(TomlReader& reader, const ExcavatorProfile& profile,
                                          const DesignPlaces& places, bool digs);

/// A ditch of straight sides along a line.
struct Ditch {
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< Middle of the bottom where it begins.
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();    ///< Where it ends, seen from above.
  double slope = 0.0;                                ///< Of the bottom, from there to here.
  double bottom_m = 0.0;                             ///< Width of the bottom; 0: a V.
  double left = 1.0;                                 ///< Rise of the left side for a metre out,
  double right = 1.0;                                ///< and of the right one.
  double top_m = 1.0;                                ///< The sides end so high over the bottom.

  /// Height of the design at a place of the same frame; not a number where it has none.
  [[nodiscard]] double height_m(const Eigen::Vector2d& place_m) const;
};

/// Heights of a ditch about the machine, in the machine's own frame.
[[nodiscard]] HeightGrid ditch_grid(const Ditch& ditch, const SiteFrame& site, double reach_m);

}  // namespace graben::machines
