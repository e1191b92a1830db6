// SPDX-License-Identifier: Apache-2.0
#include "app/plant/soil/height_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

/// Of what is too much, in a sweep.
constexpr double kShare = 0.4;
/// Walls are looked at over so many cells: one that is made of small steps falls too.
constexpr std::array<int, 4> kAway = {1, 2, 4, 8};

}  // namespace

double standing_height_m(const SoilKind& soil, double gravity_mps2) {
  return 2.0 * soil.cohesion_pa / (soil.density_kgpm3 * gravity_mps2) *
         std::tan(0.25 * kPi + 0.5 * soil.friction_rad);
}

HeightField::HeightField(const SoilKind& soil, double half_side_m, double gravity_mps2)
    : soil_(soil),
      side_(2 * static_cast<int>(std::ceil(half_side_m / kCell_m))),
      repose_step_m_(kCell_m * std::tan(soil.repose_rad)),
      stands_m_(standing_height_m(soil, gravity_mps2)),
      wall_slope_(std::tan(soil.friction_rad)),
      cell_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

int HeightField::index(double along_m) const {
  return static_cast<int>(std::floor(along_m / kCell_m)) + side_ / 2;
}

double HeightField::height_m(double x_m, double y_m) const {
  const double u = x_m / kCell_m - 0.5;
  const double v = y_m / kCell_m - 0.5;
  const double from_u = std::floor(u);
  const double from_v = std::floor(v);
  const int i = static_cast<int>(from_u) + side_ / 2;
  const int j = static_cast<int>(from_v) + side_ / 2;
  const double share_u = u - from_u;
  const double share_v = v - from_v;
  const double near_m = (1.0 - share_u) * top_m(i, j) + share_u * top_m(i + 1, j);
  const double far_m = (1.0 - share_u) * top_m(i, j + 1) + share_u * top_m(i + 1, j + 1);
  return (1.0 - share_v) * near_m + share_v * far_m;
}

double HeightField::firm_m(double x_m, double y_m) const {
  const int i = index(x_m);
  const int j = index(y_m);
  return is_inside(i, j) ? static_cast<double>(at(i, j).firm_m) : 0.0;
}

double HeightField::loose_m(double x_m, double y_m) const {
  const int i = index(x_m);
  const int j = index(y_m);
  return is_inside(i, j) ? static_cast<double>(at(i, j).loose_m) : 0.0;
}

TakenSoil HeightField::cut(double x_m, double y_m, double to_m) {
  const int i = index(x_m);
  const int j = index(y_m);
  TakenSoil taken;
  if (!is_inside(i, j)) {
    return taken;
  }
  Cell& cell = at(i, j);
  const double area_m2 = kCell_m * kCell_m;
  const double loose_m = std::clamp(cell.top_m() - to_m, 0.0, static_cast<double>(cell.loose_m));
  const double firm_m = std::max(0.0, static_cast<double>(cell.firm_m) - to_m);
  cell.loose_m -= static_cast<float>(loose_m);
  cell.firm_m -= static_cast<float>(firm_m);
  taken.loose_m3 = area_m2 * loose_m;
  taken.firm_m3 = area_m2 * firm_m;
  return taken;
}

void HeightField::press(double x_m, double y_m, double to_m) {
  const int i = index(x_m);
  const int j = index(y_m);
  if (is_inside(i, j)) {
    Cell& cell = at(i, j);
    const double down_m = std::max(0.0, cell.top_m() - to_m);
    const double loose_m = std::min(down_m, static_cast<double>(cell.loose_m));
    // Loose soil becomes dense again under a load; what is deeper gives way to the sides.
    cell.loose_m -= static_cast<float>(loose_m);
    cell.firm_m -= static_cast<float>(down_m - loose_m);
  }
}

void HeightField::heap(double x_m, double y_m, double loose_m3) {
  const int i = index(x_m);
  const int j = index(y_m);
  if (is_inside(i, j)) {
    at(i, j).loose_m += static_cast<float>(loose_m3 / (kCell_m * kCell_m));
  }
}

void HeightField::slide(Cell& from, Cell& to) const {
  const double excess_m = from.top_m() - to.top_m() - repose_step_m_;
  if (excess_m > 0.0 && from.loose_m > 0.0F) {
    const auto moved_m =
        static_cast<float>(std::min(kShare * excess_m, static_cast<double>(from.loose_m)));
    from.loose_m -= moved_m;
    to.loose_m += moved_m;
  }
}

void HeightField::fall(Cell& from, const Cell& below, double away_m) const {
  const double excess_m =
      static_cast<double>(from.firm_m) - below.top_m() - stands_m_ - away_m * wall_slope_;
  if (excess_m > 0.0) {
    const double fallen_m = kShare * excess_m;
    from.firm_m -= static_cast<float>(fallen_m);
    from.loose_m += static_cast<float>(soil_.swell * fallen_m);
  }
}

void HeightField::settle(double x_m, double y_m, double reach_m) {
  const int least = 0;
  const int most = side_ - 1;
  const int i_from = std::clamp(index(x_m - reach_m), least, most);
  const int i_until = std::clamp(index(x_m + reach_m), least, most);
  const int j_from = std::clamp(index(y_m - reach_m), least, most);
  const int j_until = std::clamp(index(y_m + reach_m), least, most);
  constexpr std::array<std::array<int, 2>, 4> kWays = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int j = j_from; j <= j_until; ++j) {
    for (int i = i_from; i <= i_until; ++i) {
      Cell& cell = at(i, j);
      for (const auto& way : kWays) {
        for (const int away : kAway) {
          if (is_inside(i + away * way[0], j + away * way[1])) {
            fall(cell, at(i + away * way[0], j + away * way[1]), away * kCell_m);
          }
        }
        if (is_inside(i + way[0], j + way[1])) {
          slide(cell, at(i + way[0], j + way[1]));
        }
      }
    }
  }
}

double HeightField::loose_m3() const {
  double sum_m = 0.0;
  for (const Cell& cell : cell_) {
    sum_m += static_cast<double>(cell.loose_m);
  }
  return kCell_m * kCell_m * sum_m;
}

double HeightField::firm_change_m3() const {
  double sum_m = 0.0;
  for (const Cell& cell : cell_) {
    sum_m += static_cast<double>(cell.firm_m);
  }
  return kCell_m * kCell_m * sum_m;
}

}  // namespace graben::plant
