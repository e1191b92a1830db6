// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/design/surface.hpp"
#include "app/machines/number_lines.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::design {
namespace {

using GridPoint = boost::polygon::point_data<int>;

/// Finer than any survey, coarse enough for whole numbers over 400 km.
constexpr double kGrid_m = 1e-4;
constexpr double kMostExtent_m = 2e5;

/// What a point's column is: its place among x, y and z, or none of them.
constexpr std::size_t kNoPlace = 3;

/// In capitals, without blanks and without what is in brackets.
std::string plain_word(std::string_view word) {
  std::string plain;
  for (const char letter : word.substr(0, word.find_first_of("([<"))) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      plain += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    }
  }
  return plain;
}

std::size_t place_of_name(std::string_view name) {
  static const std::map<std::string, std::size_t> known = {
      {"X", 0},      {"E", 0},     {"EAST", 0},  {"EASTING", 0},  {"EASTINGS", 0},
      {"Y", 1},      {"N", 1},     {"NORTH", 1}, {"NORTHING", 1}, {"NORTHINGS", 1},
      {"Z", 2},      {"H", 2},     {"EL", 2},    {"ELEV", 2},     {"ELEVATION", 2},
      {"HEIGHT", 2}, {"LEVEL", 2}, {"RL", 2},    {"ALTITUDE", 2}};
  const auto found = known.find(plain_word(name));
  return found == known.end() ? kNoPlace : found->second;
}

/// The unit that a name of a column has in brackets; empty: none.
std::string unit_of_name(std::string_view name) {
  const std::size_t open = name.find_first_of("([<");
  return open == std::string_view::npos
             ? ""
             : plain_word(name.substr(open + 1, name.find_first_of(")]>", open) - open - 1));
}

/// Where x, y and z are, of columns that are each at one place; what it returns is wrong.
std::string take_places(const std::vector<std::size_t>& places, machines::CellOfNumber& cell) {
  cell.assign(3, places.size());
  for (std::size_t column = 0; column < places.size(); ++column) {
    if (places[column] == kNoPlace) {
      continue;
    }
    if (cell[places[column]] != places.size()) {
      return fmt::format("two columns for {}; allowed: one", "xyz"[places[column]]);
    }
    cell[places[column]] = column;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (cell[i] == places.size()) {
      return fmt::format("no column for {}; allowed: x or easting, y or northing, z or elevation",
                         "xyz"[i]);
    }
  }
  return "";
}

std::string take_header(const std::vector<std::string_view>& words, double metres,
                        machines::CellOfNumber& cell) {
  std::vector<std::size_t> places;
  for (const std::string_view word : words) {
    places.push_back(place_of_name(word));
    const std::string unit = unit_of_name(word);
    const bool is_feet = unit.find('F') != std::string::npos;
    if (places.back() != kNoPlace && !unit.empty() && is_feet != (metres != 1.0)) {
      return fmt::format("'{}' against a unit of {} m; allowed: --units as the file has them", word,
                         metres);
    }
  }
  return take_places(places, cell);
}

machines::CellOfNumber cells_by_letters(const std::string& columns) {
  std::vector<std::size_t> places;
  for (const char letter : columns) {
    const std::string name(1, letter);
    const bool is_other = plain_word(name) == "P" || plain_word(name) == "D";
    if (!is_other && place_of_name(name) == kNoPlace) {
      throw std::runtime_error(fmt::format(
          "--columns {}: '{}'; allowed: P, N, E, X, Y, Z, D, as in PNEZD", columns, letter));
    }
    places.push_back(place_of_name(name));
  }
  machines::CellOfNumber cell;
  const std::string wrong = take_places(places, cell);
  if (!wrong.empty()) {
    throw std::runtime_error(fmt::format("--columns {}: {}", columns, wrong));
  }
  return cell;
}

std::vector<Eigen::Vector3d> points_of(const std::filesystem::path& file,
                                       const PointFormat& format) {
  std::vector<Eigen::Vector3d> points;
  machines::Columns columns{
      3, "x, y and z, m; more columns or another order by --columns, as PNEZD", kMostPoints};
  columns.header = [&](const std::vector<std::string_view>& words, machines::CellOfNumber& cell) {
    // Told, the order is that, whatever the file calls it.
    return format.columns.empty() ? take_header(words, format.metres, cell) : std::string();
  };
  if (!format.columns.empty()) {
    columns.cell = cells_by_letters(format.columns);
  }
  machines::read_number_lines(file, columns,
                              [&](std::size_t, const machines::LineOfNumbers& numbers) {
                                Eigen::Vector3d at_m;
                                for (unsigned i = 0; i < 3; ++i) {
                                  at_m[i] = numbers[i] * format.metres;
                                  const double most_m = i == 2 ? kMostHeight_m : kMostPlan_m;
                                  if (std::abs(at_m[i]) > most_m) {
                                    return fmt::format("{} = {} m; allowed: {} .. {} m", "xyz"[i],
                                                       at_m[i], -most_m, most_m);
                                  }
                                }
                                points.push_back(at_m);
                                return std::string();
                              });
  return points;
}

/// On the grid about their middle, each place once.
std::vector<GridPoint> on_grid(const std::filesystem::path& file, Surface& surface) {
  Eigen::Vector3d least = surface.point_m.front();
  Eigen::Vector3d most = least;
  for (const Eigen::Vector3d& at : surface.point_m) {
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  }
  if ((most - least).head<2>().maxCoeff() > kMostExtent_m) {
    throw machines::ProfileError(file.string(),
                                 {fmt::format("reaches over {:.0f} m; allowed: at most {:.0f} m",
                                              (most - least).head<2>().maxCoeff(), kMostExtent_m)});
  }
  const Eigen::Vector3d middle = 0.5 * (least + most);
  std::map<std::pair<int, int>, double> height_m;
  for (const Eigen::Vector3d& at : surface.point_m) {
    const auto line = [&](unsigned i) {
      return static_cast<int>(std::lround((at[i] - middle[i]) / kGrid_m));
    };
    const auto [there, is_new] = height_m.try_emplace({line(0), line(1)}, at.z());
    if (!is_new && std::abs(there->second - at.z()) > kGrid_m) {
      throw machines::ProfileError(
          file.string(), {fmt::format("two points at x = {}, y = {} m, {} and {} m high; allowed: "
                                      "one height a place",
                                      at.x(), at.y(), there->second, at.z())});
    }
  }
  std::vector<GridPoint> grid;
  surface.point_m.clear();
  for (const auto& [at, z_m] : height_m) {
    grid.emplace_back(at.first, at.second);
    surface.point_m.emplace_back(middle.x() + at.first * kGrid_m, middle.y() + at.second * kGrid_m,
                                 z_m);
  }
  return grid;
}

/// Each corner of Voronoi's diagram is the centre of a circle through three points or more with
/// none inside: a fan of Delaunay's triangles.
void triangulate(const std::vector<GridPoint>& grid, Surface& surface) {
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(grid.begin(), grid.end(), &diagram);
  std::vector<std::uint32_t> about;
  for (const auto& corner : diagram.vertices()) {
    about.clear();
    const auto* edge = corner.incident_edge();
    do {
      about.push_back(static_cast<std::uint32_t>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != corner.incident_edge());
    for (std::size_t i = 2; i < about.size(); ++i) {
      surface.face.push_back({about[0], about[i - 1], about[i]});
    }
  }
}

}  // namespace

double metres_of_unit(const std::string& unit) {
  constexpr double kFoot_m = 0.3048;
  constexpr double kSurveyFoot_m = 1200.0 / 3937.0;
  if (unit.empty() || unit == "m") {
    return 1.0;
  }
  if (unit != "ft" && unit != "us-ft") {
    throw std::runtime_error(fmt::format("--units {}; allowed: m, ft, us-ft", unit));
  }
  return unit == "ft" ? kFoot_m : kSurveyFoot_m;
}

Surface read_points(const std::filesystem::path& file, const PointFormat& format) {
  Surface surface{points_of(file, format), {}};
  if (!surface.point_m.empty()) {
    triangulate(on_grid(file, surface), surface);
  }
  if (surface.face.empty()) {
    throw machines::ProfileError(
        file.string(), {fmt::format("{} points make no triangle; allowed: 3 and more, not in line",
                                    surface.point_m.size())});
  }
  return surface;
}

}  // namespace graben::design
