// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Heights on an even grid over a plan, as files have them, and the surface that a controller
/// follows made of them: kinks rounded, never under the design, about the machine only.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/machines/site_frame.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/fences/design_surface.hpp"

namespace graben::machines {

/// x east, y north; row after row, each eastwards, the first one the southernmost. Not a number:
/// there is no design.
struct HeightGrid {
  int columns = 0;
  int rows = 0;
  double step_m = 0.0;
  Eigen::Vector2d first_m = Eigen::Vector2d::Zero();  ///< Place of the first height.
  std::vector<double> height_m;

  [[nodiscard]] double at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
  }
  [[nodiscard]] double& at(int column, int row) {
    return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
  }
};

inline constexpr double kLeastStep_m = 0.01;
inline constexpr double kMostStep_m = 0.5;
inline constexpr std::size_t kMostCells = 4'000'000;
/// Kinks are rounded over so much to either side, unless told: as kAssistKink_m.
inline constexpr double kUsualRounding_m = 0.05;

/// A grid with its kinks rounded over `rounding_m` to either side: a hollow is filled by a quarter
/// of its change of slope times that, a crest raised by as much, which it comes back from within
/// three times that way. Nowhere under the grid. What is nearer than that to where there is no
/// design stays as it is.
[[nodiscard]] HeightGrid rounded(const HeightGrid& grid, double rounding_m);

/// The memory of a surface.
struct HeldSurface {
  std::vector<std::int16_t> height;
  DesignSurface surface;   ///< Of those; so it is neither copied nor moved.
  std::uint32_t hash = 0;  ///< FNV-1a of all that a controller sees.

  HeldSurface() = default;
  HeldSurface(const HeldSurface&) = delete;
  HeldSurface& operator=(const HeldSurface&) = delete;
};

/// How far from its swing axis this machine's edge comes, a corner included.
[[nodiscard]] double reach_m(const ExcavatorProfile& profile);

/// What of the grid lies within `reach_m` of the machine, rounded. Throws std::runtime_error where
/// nothing does, or where it is too high or too deep for what a surface can hold.
[[nodiscard]] std::shared_ptr<const HeldSurface> held_surface(const HeightGrid& grid,
                                                              const SiteFrame& site,
                                                              double rounding_m, double reach_m);

/// An ESRI ASCII grid, in metres. Throws std::runtime_error if it can't be read, ProfileError with
/// the line and what is allowed where it is no such grid or of other sizes.
[[nodiscard]] HeightGrid read_ascii_grid(const std::filesystem::path& file);

}  // namespace graben::machines
