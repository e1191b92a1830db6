// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's design in a file of its own: heights along the track, as many as it takes.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/machines/dozer_file.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// A line a corner: x along the track and height over the plane, m; x rises. Throws as
/// read_number_lines, also where x or a height is out of range.
[[nodiscard]] std::vector<GradePoint> read_design(const std::filesystem::path& file);
/// Such a file. Throws std::runtime_error where it can't be written.
void write_design(const std::filesystem::path& file, const std::vector<GradePoint>& corners);

/// The design on the grid that the controller has it on, with the corners rounded: each height is
/// the mean of what lies `rounding_m` to either side, less near the ends, which stay where they
/// are. Of a corner that is a parabola from so far before to so far behind it.
[[nodiscard]] DesignHeights heights_of(const std::vector<GradePoint>& corners, double rounding_m);

/// Puts the heights in the place of the design's points, in the profile as in its hash.
void set_design(DozerMachine& machine, const DesignHeights& heights);

}  // namespace graben::machines
