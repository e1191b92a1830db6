// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/ground_map.hpp"

#include <algorithm>

#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

void GroundMap::start(double edge_x_m, double stand_x_m, double stand_z_m, double slope) {
  front_ = cell_of(edge_x_m);
  known_ = front_;
  oldest_ = front_ - kCells + 1;
  for (int i = 0; i < kCells; ++i) {
    const int index = front_ - i;
    set(index, stand_z_m + slope * ((index + 0.5) * kGroundCell_m - stand_x_m));
  }
  edge_x_m_ = edge_x_m;
  edge_z_m_ = stand_z_m + slope * (edge_x_m - stand_x_m);
  started_ = true;
}

void GroundMap::pass(double edge_x_m, double edge_z_m, const GradeProfile& design, double stand_x_m,
                     double stand_z_m, double slope, bool held_clear) {
  const int reached = cell_of(edge_x_m);
  if (!started_ || reached - front_ >= kCells || front_ - reached >= kCells) {
    start(edge_x_m, stand_x_m, stand_z_m, slope);
  }
  const bool in_air = held_clear || edge_z_m > design.at(edge_x_m).height_m + kEdgeInAir_m;
  const double line_z_m = stand_z_m + slope * (edge_x_m - stand_x_m);
  const double ground_z_m = in_air ? std::min(edge_z_m, line_z_m) : edge_z_m;
  if (edge_x_m > edge_x_m_) {
    const double rise = (ground_z_m - edge_z_m_) / (edge_x_m - edge_x_m_);
    for (int index = cell_of(edge_x_m_) + 1; index <= reached; ++index) {
      const double way_m = edge_z_m_ + rise * ((index + 0.5) * kGroundCell_m - edge_x_m_);
      if (index > (in_air ? known_ : front_)) {
        set(index, way_m);
      } else if (!in_air) {
        set(index, std::min(cell(index), way_m));
      }
    }
    front_ = std::max(front_, reached);
    known_ = std::max(known_, front_);
    oldest_ = std::max(oldest_, front_ - kCells + 1);
  }
  edge_x_m_ = edge_x_m;
  edge_z_m_ = ground_z_m;
}

void GroundMap::turn_back(double edge_x_m) {
  front_ = std::clamp(cell_of(edge_x_m), oldest_, front_);
}

double GroundMap::height_m(double x_m, const GradeProfile& design) const {
  const int before = cell_of(x_m);
  if (before + 1 > front_) {
    return design.at(x_m).height_m;
  }
  if (before < oldest_) {
    return cell(oldest_);
  }
  const double share = x_m / kGroundCell_m - 0.5 - before;
  return cell(before) + share * (cell(before + 1) - cell(before));
}

}  // namespace graben
