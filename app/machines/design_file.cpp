// SPDX-License-Identifier: Apache-2.0
#include "app/machines/design_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "app/machines/number_lines.hpp"

namespace graben::machines {
namespace {

constexpr std::size_t kMostCorners = 500'000;
constexpr double kMostX_m = 1000.0;
constexpr double kMostHeight_m = 100.0;

/// The integral of straight pieces between corners, level beyond them.
class Integral {
 public:
  explicit Integral(const std::vector<GradePoint>& corners) : corners_(corners), sum_{0.0} {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      sum_.push_back(sum_.back() + 0.5 * (corners[i].z_m + corners[i - 1].z_m) *
                                       (corners[i].x_m - corners[i - 1].x_m));
    }
  }

  [[nodiscard]] double height_m(double x_m) const {
    const std::size_t n = before(x_m);
    const GradePoint& from = corners_[n];
    const GradePoint& to = corners_[n + 1];
    const double share = std::clamp((x_m - from.x_m) / (to.x_m - from.x_m), 0.0, 1.0);
    return from.z_m + share * (to.z_m - from.z_m);
  }
  /// From the first corner to x, which lies between the first and the last.
  [[nodiscard]] double to(double x_m) const {
    const std::size_t n = before(x_m);
    const GradePoint& from = corners_[n];
    return sum_[n] + 0.5 * (from.z_m + height_m(x_m)) * (x_m - from.x_m);
  }

 private:
  /// The corner before x of those that have one behind them.
  [[nodiscard]] std::size_t before(double x_m) const {
    const auto after = std::upper_bound(corners_.begin() + 1, corners_.end() - 1, x_m,
                                        [](double x, const GradePoint& at) { return x < at.x_m; });
    return static_cast<std::size_t>(after - corners_.begin()) - 1;
  }

  const std::vector<GradePoint>& corners_;
  std::vector<double> sum_;
};

/// FNV-1a of what is there and of the bits of each height.
std::uint32_t hash_with(std::uint32_t hash, const GradeHeights& heights) {
  const auto add = [&hash](double value) {
    std::uint64_t bits = 0;
    value += 0.0;  // -0.0 is 0.0.
    std::memcpy(&bits, &value, sizeof bits);
    for (unsigned i = 0; i < 8; ++i) {
      hash = (hash ^ static_cast<std::uint8_t>(bits >> (8 * i))) * 16777619U;
    }
  };
  add(heights.from_m);
  for (int i = 0; i < heights.count; ++i) {
    add(heights.height_m[i]);
  }
  for (int i = 0; heights.cross != nullptr && i < heights.count; ++i) {
    add(heights.cross[i]);
  }
  for (int i = 0; heights.curvature != nullptr && i < heights.count; ++i) {
    add(heights.curvature[i]);
  }
  return hash;
}

/// What is wrong with a line's numbers; empty: nothing.
/// What is wrong with one that is in every line or in none; empty: nothing.
std::string take_more(double value, const char* name, double most, bool is_first,
                      std::vector<double>& values) {
  const bool is_there = !std::isnan(value);
  if (!is_first && is_there == values.empty()) {
    return fmt::format("allowed: {} in every line or in none", name);
  }
  if (is_there && std::abs(value) > most) {
    return fmt::format("{} of {}; allowed: {} .. {}", name, value, -most, most);
  }
  if (is_there) {
    values.push_back(value);
  }
  return "";
}

std::string take_corner(const LineOfNumbers& numbers, DesignLine& line) {
  const GradePoint at{numbers[0], numbers[1]};
  if (std::abs(at.x_m) > kMostX_m) {
    return fmt::format("x = {} m; allowed: {} .. {} m", at.x_m, -kMostX_m, kMostX_m);
  }
  if (std::abs(at.z_m) > kMostHeight_m) {
    return fmt::format("a height of {} m; allowed: {} .. {} m", at.z_m, -kMostHeight_m,
                       kMostHeight_m);
  }
  if (!line.corners.empty() && !(at.x_m > line.corners.back().x_m)) {
    return fmt::format("x = {} m; allowed: more than the line before, {} m", at.x_m,
                       line.corners.back().x_m);
  }
  const bool is_first = line.corners.empty();
  std::string wrong = take_more(numbers[2], "a slope across", kMostCross, is_first, line.cross);
  if (wrong.empty()) {
    wrong = take_more(numbers[3], "a curvature", kMostCurvature_pm, is_first, line.curvature);
  }
  if (wrong.empty()) {
    line.corners.push_back(at);
  }
  return wrong;
}

/// Of a first line of names: empty where they stand in the order of the numbers.
std::string header_wrong(const std::vector<std::string_view>& words) {
  static const std::vector<std::vector<std::string>> known = {
      {"x", "station", "sta", "chainage", "distance", "along"},
      {"z", "h", "height", "elevation", "elev", "level"},
      {"slope", "cross", "crossfall", "cross_slope"},
      {"curvature"}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string word(words[i].substr(0, words[i].find_first_of(" ([_")));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const bool is_there =
        i < known.size() && std::find(known[i].begin(), known[i].end(), word) != known[i].end();
    if (!is_there) {
      return fmt::format(
          "column {}: '{}'; allowed: numbers, or as names x, height, slope, "
          "curvature in this order",
          i + 1, words[i]);
    }
  }
  return "";
}

/// The corners every GradeHeights::kStep_m, rounded.
std::shared_ptr<const std::vector<double>> on_grid(const std::vector<GradePoint>& corners,
                                                   double rounding_m) {
  const Integral integral(corners);
  const double begin_m = corners.front().x_m;
  const double end_m = corners.back().x_m;
  auto height_m = std::make_shared<std::vector<double>>();
  // As the corners' numbers are rounded in binary, so is the length.
  const auto count = static_cast<int>((end_m - begin_m) / GradeHeights::kStep_m + 1e-6) + 1;
  for (int i = 0; i < std::min(count, GradeHeights::kMost); ++i) {
    const double x_m = std::min(begin_m + i * GradeHeights::kStep_m, end_m);
    const double half_m = std::min({rounding_m, x_m - begin_m, end_m - x_m});
    constexpr double kNoCurve_m = 1e-6;
    height_m->push_back(half_m > kNoCurve_m
                            ? (integral.to(x_m + half_m) - integral.to(x_m - half_m)) /
                                  (2.0 * half_m)
                            : integral.height_m(x_m));
  }
  return height_m;
}

}  // namespace

DesignLine read_design(const std::filesystem::path& file) {
  DesignLine line;
  Columns columns{
      2,
      "x along the track and height over the plane, m, and it may be the slope across, and the "
      "track's curvature",
      kMostCorners, 2};
  columns.header = [](const std::vector<std::string_view>& words, CellOfNumber&) {
    return header_wrong(words);
  };
  read_number_lines(file, columns, [&](std::size_t, const LineOfNumbers& numbers) {
    return take_corner(numbers, line);
  });
  // Curvature alone: level across.
  if (!line.curvature.empty() && line.cross.empty()) {
    line.cross.assign(line.corners.size(), 0.0);
  }
  const std::vector<GradePoint>& corners = line.corners;
  const double length_m = corners.size() > 1 ? corners.back().x_m - corners.front().x_m : 0.0;
  const double most_m = (GradeHeights::kMost - 1) * GradeHeights::kStep_m;
  if (length_m < GradeHeights::kStep_m || length_m > most_m) {
    throw ProfileError(file.string(),
                       {fmt::format("{} lines over {} m; allowed: 2 lines and more over {} .. {} m",
                                    corners.size(), length_m, GradeHeights::kStep_m, most_m)});
  }
  return line;
}

void write_design(const std::filesystem::path& file, const DesignLine& line) {
  std::ofstream stream(file);
  stream << "# A design along the track: x and height over the plane, m"
         << (line.cross.empty()
                 ? ".\n"
                 : (line.curvature.empty() ? "; slope across, left up.\n"
                                           : "; slope across, left up; curvature, left, 1/m.\n"));
  for (std::size_t i = 0; i < line.corners.size(); ++i) {
    stream << fmt::format("{:.6f} {:.6f}", line.corners[i].x_m, line.corners[i].z_m);
    for (const std::vector<double>* more : {&line.cross, &line.curvature}) {
      stream << (more->empty() ? "" : fmt::format(" {:.6f}", (*more)[i]));
    }
    stream << "\n";
  }
  stream.flush();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
  }
}

DesignHeights heights_of(const DesignLine& line, double rounding_m) {
  const auto of = [&](const std::vector<double>& values) {
    std::vector<GradePoint> at = line.corners;
    for (std::size_t i = 0; i < values.size(); ++i) {
      at[i].z_m = values[i];
    }
    return values.empty() ? nullptr : on_grid(at, rounding_m);
  };
  return {line.corners.front().x_m, on_grid(line.corners, rounding_m), of(line.cross),
          of(line.curvature)};
}

std::string wall_note(const DesignLine& line, double rounding_m) {
  // As dozer_checks.cpp refuses it where it is no wall but a slope.
  constexpr double kMostSlope = 0.6;
  constexpr double kLeast_m = 0.01;
  double wall_m = 0.0;
  double at_m = 0.0;
  double begin_m = 0.0;
  double height_m = 0.0;
  for (std::size_t i = 1; i < line.corners.size(); ++i) {
    const GradePoint& from = line.corners[i - 1];
    const GradePoint& to = line.corners[i];
    const double rise_m = to.z_m - from.z_m;
    if (std::abs(rise_m) <= kMostSlope * (to.x_m - from.x_m)) {
      height_m = 0.0;
      continue;
    }
    // A wall may be of several pieces, each as steep.
    begin_m = height_m * rise_m > 0.0 ? begin_m : from.x_m;
    height_m = height_m * rise_m > 0.0 ? height_m + rise_m : rise_m;
    if (std::abs(height_m) > std::abs(wall_m)) {
      wall_m = height_m;
      at_m = 0.5 * (begin_m + to.x_m);
    }
  }
  if (std::abs(wall_m) < kLeast_m) {
    return "";
  }
  return fmt::format(
      "the design has a wall of {:.3f} m at x = {:.2f} m: it is judged and graded as "
      "rounded by grade.rounding, {} m to either side",
      wall_m, at_m, rounding_m);
}

void set_design(DozerMachine& machine, const DesignHeights& heights) {
  machine.design = heights;
  GradeDesign& grade = machine.profile.grade;
  grade.count = 0;
  grade.point = {};
  grade.heights = {heights.height_m->data(), heights.cross ? heights.cross->data() : nullptr,
                   static_cast<int>(heights.height_m->size()), heights.from_m,
                   heights.curvature ? heights.curvature->data() : nullptr};
  machine.hash = hash_with(machine.hash, grade.heights);
}

}  // namespace graben::machines
