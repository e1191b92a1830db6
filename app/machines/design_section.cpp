// SPDX-License-Identifier: Apache-2.0
#include "app/machines/design_section.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <limits>

#include "app/machines/fence_tables.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

constexpr Range kPlace{-30.0, 30.0, "m"};
constexpr Range kSitePlace{-2e7, 2e7, "m"};
constexpr Range kSlope{-2.0, 2.0, ""};
constexpr Range kDepth{0.0, 10.0, "m"};
/// What the teeth may dip below their line while a drive breaks loose or lags, and some more.
constexpr double kLeastClearance_m = 0.03;
/// Between the heights of a ditch.
constexpr double kDitchStep_m = 0.025;

Range place_range(const DesignPlaces& places) { return places.has_site ? kSitePlace : kPlace; }

Eigen::Vector3d three(TomlReader& reader, const std::string& key, const Range& range,
                      const char* help) {
  const std::vector<double> values = reader.numbers(key, range, 3, help);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d normal_of(double slope, double cross_slope, double heading_rad) {
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  const Eigen::Vector2d left(-along.y(), along.x());
  const Eigen::Vector2d rise = slope * along + cross_slope * left;
  return Eigen::Vector3d(-rise.x(), -rise.y(), 1.0).normalized();
}

Eigen::Vector3d read_normal(TomlReader& reader) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const bool by_slope = reader.has("design.slope") || reader.has("design.cross_slope") ||
                        reader.has("design.heading");
  if (!by_slope || reader.lists() || reader.has("design.normal")) {
    up = read_direction(reader, "design.normal", 3,
                        "upward normal of the plane: x, y, z; or slope, cross_slope and heading");
  }
  if (by_slope && !reader.lists() && reader.has("design.normal")) {
    reader.fail("design.normal",
                "stands with slope, cross_slope or heading; allowed: one or these");
  }
  if (by_slope || reader.lists()) {
    const double slope =
        reader.number_or(0.0, "design.slope", kSlope, "rise of the plane along its heading, per m");
    const double cross = reader.number_or(0.0, "design.cross_slope", kSlope,
                                          "rise of the plane to the left of its heading, per m");
    const double heading_rad =
        reader.number_or(0.0, "design.heading", {-6.3, 6.3, "rad"},
                         "direction along which slope counts, against x or east, to the left");
    up = normal_of(slope, cross, heading_rad);
  }
  if (up.z() < kDesignUpLeast) {
    reader.fail("design.normal",
                fmt::format("must point up; its upward part is {:.3f} of its length; allowed: {} "
                            ".. 1",
                            up.z(), kDesignUpLeast));
  }
  return up;
}

DesignPlane read_plane(TomlReader& reader, const DesignPlaces& places, bool digs) {
  DesignPlane design;
  const Eigen::Vector3d through_m =
      three(reader, "design.through", place_range(places),
            "a point of the design plane, or so far over it as depth says: x, y, z; of the "
            "machine, within 30 m, unless there is a [site]");
  const double depth_m =
      reader.number_or(0.0, "design.depth", kDepth, "of the design under that point");
  design.through_m = places.site.to_machine(through_m - depth_m * Eigen::Vector3d::UnitZ());
  design.up = places.site.turned_to_machine(read_normal(reader));
  const Range clearance{kLeastClearance_m, 1.0, "m"};
  constexpr const char* kHelp = "least distance of a dig's ends from a design plane";
  design.clearance_m =
      digs ? reader.number("design.clearance", clearance, kHelp)
           : reader.number_or(kLeastClearance_m, "design.clearance", clearance, kHelp);
  return design;
}

Ditch read_ditch(TomlReader& reader, const DesignPlaces& places) {
  Ditch ditch;
  const Range place = place_range(places);
  ditch.from_m = three(reader, "design.ditch.from", place,
                       "where a ditch begins, or so far over it as depth says: x, y, z");
  ditch.from_m.z() -=
      reader.number_or(0.0, "design.ditch.depth", kDepth, "of a ditch's bottom under that point");
  ditch.to_m = reader.point("design.ditch.to", place, "where a ditch ends, seen from above: x, y");
  ditch.slope = reader.number_or(0.0, "design.ditch.slope", {-1.0, 1.0, ""},
                                 "rise of a ditch's bottom from there to here, per m");
  ditch.bottom_m =
      reader.number_or(0.0, "design.ditch.bottom", {0.0, 10.0, "m"}, "width of its bottom; 0: a V");
  const std::vector<double> sides = reader.numbers(
      "design.ditch.sides", {0.1, 2.0, ""}, 2,
      "rise of its left and right side for each metre outwards, seen from its begin");
  ditch.left = sides[0];
  ditch.right = sides[1];
  ditch.top_m = reader.number("design.ditch.top", {0.1, 8.0, "m"},
                              "the sides end so high over the bottom; beyond there is no design");
  const double length_m = (ditch.to_m - ditch.from_m.head<2>()).norm();
  if (reader.is_sound() && length_m < 1.0) {
    reader.fail("design.ditch.to",
                fmt::format("{:.3f} m from where it begins; allowed: 1 m and more", length_m));
  }
  return ditch;
}

std::filesystem::path beside(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path file(name);
  return file.is_absolute() ? file : folder / file;
}

}  // namespace

double Ditch::height_m(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d way_m = to_m - from_m.head<2>();
  const double length_m = way_m.norm();
  const Eigen::Vector2d along = way_m / length_m;
  const Eigen::Vector2d off_m = place_m - from_m.head<2>();
  const double on_m = along.dot(off_m);
  const double left_m = along.x() * off_m.y() - along.y() * off_m.x();
  const double over_m =
      std::max(0.0, std::abs(left_m) - 0.5 * bottom_m) * (left_m > 0.0 ? left : right);
  return on_m >= 0.0 && on_m <= length_m && over_m <= top_m
             ? from_m.z() + slope * on_m + over_m
             : std::numeric_limits<double>::quiet_NaN();
}

HeightGrid ditch_grid(const Ditch& ditch, const SiteFrame& site, double reach_m) {
  HeightGrid grid;
  const int half = static_cast<int>(std::ceil((reach_m + 1.0) / kDitchStep_m));
  grid.columns = grid.rows = 2 * half + 1;
  grid.step_m = kDitchStep_m;
  grid.first_m.setConstant(-half * kDitchStep_m);
  grid.height_m.resize(static_cast<std::size_t>(grid.columns) *
                       static_cast<std::size_t>(grid.rows));
  const double down_m = site.to_site(Eigen::Vector3d::Zero()).z();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d place_m = grid.first_m + grid.step_m * Eigen::Vector2d(column, row);
      const Eigen::Vector3d of_site = site.to_site({place_m.x(), place_m.y(), 0.0});
      grid.at(column, row) = ditch.height_m(of_site.head<2>()) - down_m;
    }
  }
  return grid;
}

TaskDesign read_task_design(TomlReader& reader, const ExcavatorProfile& profile,
                            const DesignPlaces& places, bool digs) {
  TaskDesign design;
  const bool of_file = reader.has("design.file");
  const bool of_ditch = reader.has("design.ditch");
  if (of_file && of_ditch && !reader.lists()) {
    reader.fail("design", "has a file and a ditch; allowed: one of them");
  }
  if (of_file && !places.has_site && !reader.lists()) {
    reader.fail("design.file",
                "lies in the site's frame, of which nothing is known; allowed: with a section "
                "[site], which `graben site` makes of touched points");
  }
  design.is_plane = !of_file && !of_ditch;
  if (design.is_plane || reader.lists()) {
    design.plane = read_plane(reader, places, digs);
  }
  if (design.is_plane) {
    return design;
  }
  const double rounding_m =
      reader.number_or(kUsualRounding_m, "design.rounding", {0.0, 0.3, "m"},
                       "a ditch's or a file's kinks are rounded over so much to either side");
  std::string file;
  Ditch ditch;
  if (of_file) {
    file = reader.text("design.file",
                       "instead of a plane: an ESRI ASCII grid beside the task's file, as `graben "
                       "surface` makes it");
  }
  if (of_ditch) {
    ditch = read_ditch(reader, places);
  }
  if (!reader.is_sound()) {
    return design;
  }
  try {
    // Wherever the machine stands, the benchmark is within its reach.
    const double far_m = (places.by_touch ? 2.0 : 1.0) * reach_m(profile);
    design.surface =
        of_file ? held_surface(read_ascii_grid(beside(places.folder, file)), places.site,
                               rounding_m, far_m)
                : held_surface(ditch_grid(ditch, places.site, far_m), {}, rounding_m, far_m);
  } catch (const ProfileError& error) {
    for (const std::string& line : error.errors()) {
      reader.fail("design.file", fmt::format("{}: {}", file, line));
    }
  } catch (const std::exception& error) {
    reader.fail(of_file ? "design.file" : "design.ditch", error.what());
  }
  return design;
}

}  // namespace graben::machines
