// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Built ground for others: LandXML, points, ESRI's ASCII grid, and words.

#include <optional>
#include <string>
#include <vector>

#include "app/built/built_ground.hpp"

namespace graben::built {

/// What every file says beside the ground.
struct BuiltHead {
  std::string machine;  ///< "excavator_12t (profile 0123abcd)"
  std::string project;
  std::string version;  ///< Of this tool.
  double from_s = 0.0;  ///< Of the logs' first and last frame, as they have them.
  double until_s = 0.0;
  bool of_record = false;  ///< A controller's: it does not tell the next two.
  double way_m = 0.0;      ///< That the edge went,
  double worked_m = 0.0;   ///< and at work.
  double tolerance_m = 0.0;
  BuiltHeight height = BuiltHeight::kLowest;
};

/// "2026-11-30T10:00:00Z"; with as many decimals of the second.
[[nodiscard]] std::string utc_text(double time_s, int decimals = 0);

/// LandXML 1.2 with one TIN surface, m. North is y, east is x. The date is that of the last frame.
[[nodiscard]] std::string landxml_text(const BuiltGround& ground, const BuiltHead& head);
/// A line a point: x, y, z, time (UTC), passes, lowest, newest, and, against a design, height over
/// it. What it is stands in a line before, after a '#'.
[[nodiscard]] std::string points_text(const BuiltGround& ground, const BuiltHead& head);
/// Of the ground's height, the most northern row first; cells that nobody has made have kNoData.
/// Throws std::runtime_error where that would be more than kMostAscii cells.
[[nodiscard]] std::string ascii_text(const BuiltGround& ground);
inline constexpr int kNoData = -9999;
inline constexpr std::size_t kMostAscii = 20'000'000;
/// Date, machine and unit of such a grid, which has no place for them: what GDAL and ESRI read
/// from FILE.asc.aux.xml beside it.
[[nodiscard]] std::string ascii_head_text(const BuiltHead& head);

/// Figures, a row each.
[[nodiscard]] std::string table_text(const BuiltGround& ground, const BuiltHead& head,
                                     const std::optional<DesignFigures>& design);

}  // namespace graben::built
