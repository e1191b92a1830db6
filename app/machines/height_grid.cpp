// SPDX-License-Identifier: Apache-2.0
#include "app/machines/height_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace graben::machines {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// Mean or largest of each window of 2 n + 1, along rows and then along columns; not a number where
/// one of them is.
template <class Join>
HeightGrid windowed(const HeightGrid& grid, int n, double first, const Join& join, double per) {
  HeightGrid along = grid;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      double all = column < n || column + n >= grid.columns ? kNoHeight : first;
      for (int i = -n; i <= n && !std::isnan(all); ++i) {
        all = join(all, grid.at(column + i, row));
      }
      along.at(column, row) = per * all;
    }
  }
  HeightGrid both = along;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      double all = row < n || row + n >= grid.rows ? kNoHeight : first;
      for (int i = -n; i <= n && !std::isnan(all); ++i) {
        all = join(all, along.at(column, row + i));
      }
      both.at(column, row) = per * all;
    }
  }
  return both;
}

HeightGrid mean(const HeightGrid& grid, int n) {
  return windowed(
      grid, n, 0.0, [](double sum, double next) { return sum + next; }, 1.0 / (2 * n + 1));
}

HeightGrid largest(const HeightGrid& grid, int n) {
  return windowed(
      grid, n, -std::numeric_limits<double>::infinity(),
      [](double most, double next) { return std::isnan(next) ? next : std::max(most, next); }, 1.0);
}

/// The part about a place, at least so far to all sides.
HeightGrid cropped(const HeightGrid& grid, const Eigen::Vector2d& about_m, double half_m) {
  const auto first = [&](double place_m, double begin_m, int count) {
    return static_cast<int>(
        std::clamp(std::floor((place_m - half_m - begin_m) / grid.step_m), 0.0, count - 1.0));
  };
  const auto last = [&](double place_m, double begin_m, int count) {
    return static_cast<int>(
        std::clamp(std::ceil((place_m + half_m - begin_m) / grid.step_m), 0.0, count - 1.0));
  };
  const int from_column = first(about_m.x(), grid.first_m.x(), grid.columns);
  const int from_row = first(about_m.y(), grid.first_m.y(), grid.rows);
  HeightGrid part;
  part.columns = last(about_m.x(), grid.first_m.x(), grid.columns) - from_column + 1;
  part.rows = last(about_m.y(), grid.first_m.y(), grid.rows) - from_row + 1;
  part.step_m = grid.step_m;
  part.first_m = grid.first_m + grid.step_m * Eigen::Vector2d(from_column, from_row);
  part.height_m.resize(static_cast<std::size_t>(part.columns) *
                       static_cast<std::size_t>(part.rows));
  for (int row = 0; row < part.rows; ++row) {
    for (int column = 0; column < part.columns; ++column) {
      part.at(column, row) = grid.at(from_column + column, from_row + row);
    }
  }
  return part;
}

std::uint32_t hash_of(const HeldSurface& held) {
  std::uint32_t hash = 2166136261U;
  const auto add = [&hash](std::uint64_t bits, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) {
      hash = (hash ^ static_cast<std::uint8_t>(bits >> (8 * i))) * 16777619U;
    }
  };
  for (const std::int16_t height : held.height) {
    add(static_cast<std::uint16_t>(height), 2);
  }
  const DesignSurface& of = held.surface;
  for (const double value :
       {of.step_m, of.base_m, of.machine_m.x(), of.machine_m.y(), of.cosine, of.sine}) {
    add(static_cast<std::uint64_t>(std::llround(1e6 * value)), 8);
  }
  add(static_cast<std::uint64_t>(of.columns), 4);
  return hash;
}

}  // namespace

HeightGrid rounded(const HeightGrid& grid, double rounding_m) {
  const int n = static_cast<int>(std::lround(rounding_m / grid.step_m));
  if (n < 1) {
    return grid;
  }
  const HeightGrid smooth = mean(grid, n);
  HeightGrid under = smooth;
  for (std::size_t i = 0; i < grid.height_m.size(); ++i) {
    const double off_m = grid.height_m[i] - smooth.height_m[i];
    under.height_m[i] = std::isnan(off_m) ? off_m : std::max(0.0, off_m);
  }
  const HeightGrid raised = mean(largest(under, n), n);
  HeightGrid result = grid;
  for (std::size_t i = 0; i < grid.height_m.size(); ++i) {
    const double height_m = smooth.height_m[i] + raised.height_m[i];
    result.height_m[i] = std::isnan(height_m) ? grid.height_m[i] : height_m;
  }
  return result;
}

double reach_m(const ExcavatorProfile& profile) {
  const ExcavatorGeometry& of = profile.geometry;
  const double out_m = of.boom_foot_m.x() + of.boom_length_m + of.arm_length_m + of.bucket_length_m;
  return std::hypot(out_m, 0.5 * of.body.bucket_width_m);
}

std::shared_ptr<const HeldSurface> held_surface(const HeightGrid& grid, const SiteFrame& site,
                                                double rounding_m, double reach_m) {
  const Eigen::Vector3d machine_m = site.to_site(Eigen::Vector3d::Zero());
  constexpr double kBeside_m = 0.5;
  const HeightGrid part = rounded(
      cropped(grid, machine_m.head<2>(), reach_m + 3.0 * rounding_m + kBeside_m), rounding_m);
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -low_m;
  const auto is_near = [&](int column, int row) {
    const Eigen::Vector2d place_m = part.first_m + part.step_m * Eigen::Vector2d(column, row);
    return (place_m - machine_m.head<2>()).norm() <= reach_m + kBeside_m &&
           !std::isnan(part.at(column, row));
  };
  for (int row = 0; row < part.rows; ++row) {
    for (int column = 0; column < part.columns; ++column) {
      if (is_near(column, row)) {
        low_m = std::min(low_m, part.at(column, row));
        high_m = std::max(high_m, part.at(column, row));
      }
    }
  }
  if (!(low_m <= high_m)) {
    throw std::runtime_error(fmt::format(
        "no height lies within the {:.1f} m that the machine reaches; it stands at {:.2f} m east "
        "and {:.2f} m north, the design reaches from {:.2f}, {:.2f} to {:.2f}, {:.2f}",
        reach_m, machine_m.x(), machine_m.y(), grid.first_m.x(), grid.first_m.y(),
        grid.first_m.x() + grid.step_m * (grid.columns - 1),
        grid.first_m.y() + grid.step_m * (grid.rows - 1)));
  }
  constexpr double kMostCount = 32'000.0;
  const double most_m = kMostCount * DesignSurface::kUnit_m;
  if (high_m - low_m > 2.0 * most_m || part.columns > DesignSurface::kMostSide ||
      part.rows > DesignSurface::kMostSide) {
    throw std::runtime_error(fmt::format(
        "{} by {} heights from {:.2f} to {:.2f} m within the machine's reach; allowed: {} by {} "
        "over {} m",
        part.columns, part.rows, low_m, high_m, DesignSurface::kMostSide, DesignSurface::kMostSide,
        2.0 * most_m));
  }
  auto held = std::make_shared<HeldSurface>();
  const double middle_m = 0.5 * (low_m + high_m);
  held->height.reserve(part.height_m.size());
  for (int row = 0; row < part.rows; ++row) {
    for (int column = 0; column < part.columns; ++column) {
      // Upwards: never under the design. A float's dust is no count more.
      constexpr double kDust = 1e-6;
      held->height.push_back(
          is_near(column, row)
              ? static_cast<std::int16_t>(
                    std::ceil((part.at(column, row) - middle_m) / DesignSurface::kUnit_m - kDust))
              : DesignSurface::kNone);
    }
  }
  DesignSurface& surface = held->surface;
  surface.height = held->height.data();
  surface.columns = part.columns;
  surface.rows = part.rows;
  surface.step_m = part.step_m;
  surface.base_m = middle_m - machine_m.z();
  surface.machine_m = machine_m.head<2>() - part.first_m;
  surface.cosine = std::cos(site.heading_rad);
  surface.sine = std::sin(site.heading_rad);
  held->hash = hash_of(*held);
  return held;
}

}  // namespace graben::machines
