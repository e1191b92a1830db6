// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's design in a file of its own: heights along the track, as many as it takes.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/machines/dozer_file.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// A design along the track.
struct DesignLine {
  DesignLine() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): corners alone are a design that is level across.
  DesignLine(std::vector<GradePoint> at, std::vector<double> slope_across = {})
      : corners(std::move(at)), cross(std::move(slope_across)) {}

  std::vector<GradePoint> corners;
  std::vector<double> cross;      ///< Slope across at each corner, left up positive; none: level.
  std::vector<double> curvature;  ///< Of the track in plan, 1/m, left positive; none: straight.
};

/// A line a corner: x along the track and height over the plane, m, and the slope across and with
/// it the track's curvature in plan, each in every line or in none; x rises. Throws as
/// read_number_lines, also where one is out of range.
[[nodiscard]] DesignLine read_design(const std::filesystem::path& file);
/// Such a file. Throws std::runtime_error where it can't be written.
void write_design(const std::filesystem::path& file, const DesignLine& line);

/// The design on the grid that the controller has it on, with the corners rounded: each height is
/// the mean of what lies `rounding_m` to either side, less near the ends, which stay where they
/// are. Of a corner that is a parabola from so far before to so far behind it. Slopes across and
/// curvatures are rounded alike.
[[nodiscard]] DesignHeights heights_of(const DesignLine& line, double rounding_m);

/// Where the corners have a wall, steeper than any ground that carries a dozer, which rounding
/// makes a slope of: the highest one's place and height, and that what is graded is rounded; empty:
/// none.
[[nodiscard]] std::string wall_note(const DesignLine& line, double rounding_m);

/// More of a slope across is refused.
inline constexpr double kMostCross = 0.3;
/// The same of a curvature, 1/m.
inline constexpr double kMostCurvature_pm = 0.5;

/// Puts the heights in the place of the design's points, in the profile as in its hash.
void set_design(DozerMachine& machine, const DesignHeights& heights);

}  // namespace graben::machines
