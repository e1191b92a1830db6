// SPDX-License-Identifier: Apache-2.0
#include "app/plant/soil/bucket_soil.hpp"

#include <algorithm>
#include <cmath>

#include "app/plant/linkage_geometry.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

/// The soil before it gives way, N/m: a few millimetres at the forces of digging.
constexpr double kSpring_npm = 8e6;
/// Of the ground under the floor, Pa/m: modulus of subgrade reaction of firm ground.
constexpr double kSubgrade_papm = 5e7;
/// Ground and fill are looked at so often: the edge goes less than a tenth of a cell meanwhile.
constexpr double kLook_s = 1e-3;
/// Slopes settle so often.
constexpr long kLooksToSettle = 40;
constexpr double kSettle_m = 1.5;
/// Before the edge, where the soil that fails with the next piece of way lies.
constexpr std::array<double, 3> kAhead_m = {0.06, 0.12, 0.20};
constexpr std::array<double, 3> kSpilled_m = {0.08, 0.15, 0.22};
/// Below this the direction of the edge's force says nothing.
constexpr double kNoWay_m = 1e-7;
/// A bucket holds what it has up to this tilt of its opening, and nothing at the second one.
constexpr double kHolds_rad = 0.45;
constexpr double kEmpty_rad = 1.75;
/// What it can't hold goes in this time.
constexpr double kPours_s = 0.4;
/// So much soil before the opening keeps the fill in.
constexpr double kKeeps_m = 0.10;
/// Radius of gyration of the fill, of the line pin to edge: that of a block of 0.9 by 0.6 of it.
constexpr double kGyration = 0.31;
/// Over the width no cell is stepped over, whichever way the bucket stands to the cells.
constexpr double kAcross_m = 0.5 * HeightField::kCell_m;

SoilKind loosened(SoilKind soil) {
  soil.cohesion_pa = 0.0;
  soil.adhesion_pa = 0.0;
  soil.density_kgpm3 /= soil.swell;
  return soil;
}

double wrapped(double angle_rad) {
  return angle_rad - kTwoPi * std::floor((angle_rad + kPi) / kTwoPi);
}

Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

}  // namespace

BucketSoil::BucketSoil(const DiggingProfile& profile, std::uint64_t seed, double step_s)
    : profile_(profile),
      loose_(loosened(profile.soil)),
      firm_table_(profile.soil),
      loose_table_(loose_),
      width_points_(static_cast<int>(std::ceil(profile.bucket.width_m / kAcross_m))),
      bears_pa_(bearing_pa(profile.soil, profile.bucket.floor_m / kFloorPoints, 0.0,
                           profile.gravity_mps2)),
      look_steps_(std::max(1L, std::lround(kLook_s / step_s))),
      ground_(profile.soil, profile.half_side_m, profile.gravity_mps2),
      random_(seed, Draw::kSoil) {}

double BucketSoil::fill_kg() const {
  return fill_m3_ * profile_.soil.density_kgpm3 / profile_.soil.swell;
}

LinkBody BucketSoil::fill() const {
  const double length_m = profile_.pin_m;
  const double gyration_m = kGyration * length_m;
  return {fill_kg(), fill_kg() * gyration_m * gyration_m,
          length_m * Eigen::Vector2d(profile_.bucket.middle_along, profile_.bucket.middle_below)};
}

/// Over the ground frame, of a point at this radius and so much to the left of the links' plane.
Eigen::Vector2d BucketSoil::across(double along_m, double level_m) const {
  return along_m * plane_ + level_m * turned(plane_);
}

/// Offsets over the bucket's width.
template <class Each>
void BucketSoil::over_width(const Each& each) const {
  for (int n = 0; n < width_points_; ++n) {
    each(profile_.bucket.width_m * ((n + 0.5) / width_points_ - 0.5));
  }
}

void BucketSoil::make_room() {
  const Eigen::Vector2d& way = floor_;
  constexpr int kPoints = 40;
  const double reach_m = profile_.pin_m;
  for (int n = 0; n <= kPoints; ++n) {
    const double along_m = reach_m * n / kPoints;
    const double floor_share = std::min(1.0, along_m / profile_.bucket.floor_m);
    const double radius_m = edge_m_.x() + along_m * way.x();
    const double height_m = edge_m_.y() + floor_share * profile_.bucket.floor_m * way.y();
    over_width([&](double level_m) {
      const Eigen::Vector2d at_m = across(radius_m, level_m);
      static_cast<void>(ground_.cut(at_m.x(), at_m.y(), height_m));
    });
  }
}

void BucketSoil::take(const TakenSoil& taken) {
  cut_m3_ += taken.firm_m3;
  fill_m3_ += profile_.soil.swell * taken.firm_m3 + taken.loose_m3;
}

double BucketSoil::holds_m3() const {
  const double tilt_rad = std::abs(wrapped(place_.attitude_rad));
  const double share = std::clamp((kEmpty_rad - tilt_rad) / (kEmpty_rad - kHolds_rad), 0.0, 1.0);
  const double kept = std::clamp(supported_m_ / kKeeps_m, 0.0, 1.0);
  return profile_.bucket.capacity_m3 * std::max(share, kept);
}

/// What the bucket can't hold falls where its edge is; what is too much to go in lies before it.
void BucketSoil::drop() {
  const double too_much_m3 = fill_m3_ - profile_.bucket.capacity_m3;
  const double pours_m3 = std::max(0.0, fill_m3_ - holds_m3()) * kLook_s / kPours_s;
  const double out_m3 = std::min(fill_m3_, std::max(pours_m3, too_much_m3));
  if (out_m3 <= 0.0) {
    return;
  }
  fill_m3_ -= out_m3;
  const double before = -std::copysign(1.0, floor_.x());
  for (const double before_m : kSpilled_m) {
    over_width([&](double level_m) {
      const Eigen::Vector2d at_m = across(edge_m_.x() + before * before_m, level_m);
      ground_.heap(at_m.x(), at_m.y(),
                   out_m3 / (width_points_ * static_cast<double>(kSpilled_m.size())));
    });
  }
}

void BucketSoil::cut() {
  const double height_m = edge_m_.y();
  over_width([&](double level_m) {
    const Eigen::Vector2d at_m = across(edge_m_.x(), level_m);
    take(ground_.cut(at_m.x(), at_m.y(), height_m));
  });
}

/// `way`: +1 outwards, -1 towards the machine.
BucketSoil::Front BucketSoil::front(double way) const {
  Front front;
  const double share = 1.0 / (width_points_ * static_cast<double>(kAhead_m.size()));
  for (const double ahead_m : kAhead_m) {
    over_width([&](double level_m) {
      const Eigen::Vector2d at_m = across(edge_m_.x() + way * ahead_m, level_m);
      const double firm_m = ground_.firm_m(at_m.x(), at_m.y()) - edge_m_.y();
      const double loose_m = ground_.loose_m(at_m.x(), at_m.y());
      const double top_m = std::max(0.0, firm_m + loose_m);
      front.firm_m += share * std::max(0.0, firm_m);
      (firm_m > 0.0 ? front.surcharge_m : front.loose_m) += share * std::min(loose_m, top_m);
      front.top_m += share * top_m;
    });
  }
  return front;
}

/// Force that it takes to go on this way.
void BucketSoil::find_yield() {
  const Eigen::Vector2d& way = way_;
  const BucketShape& bucket = profile_.bucket;
  const double gravity = profile_.gravity_mps2;
  const Front before = front(way.x() > 0.0 ? 1.0 : -1.0);
  supported_m_ = before.top_m;
  const Eigen::Vector2d& floor = floor_;
  // The edge goes in along the floor: its thickness bears on what is below it.
  const double along = std::max(0.0, -way.dot(floor));
  const double depth_m = std::max(before.top_m, 0.0);
  const double goes_in_n = depth_m > 0.0
                               ? along * bucket.edge_m * bucket.width_m *
                                     bearing_pa(profile_.soil, bucket.edge_m, depth_m, gravity)
                               : 0.0;
  CuttingForce cutting;
  const double rake_rad =
      wrapped(std::atan2(floor.y(), floor.x()) - std::atan2(-way.y(), -way.x()));
  const double level = std::abs(way.x());
  if (rake_rad > 0.0 && depth_m > 0.0) {
    const double surcharge_pa = loose_.density_kgpm3 * gravity * before.surcharge_m;
    const CuttingForce firm =
        cutting_force(profile_.soil, firm_table_.at(rake_rad), rake_rad, level * before.firm_m,
                      bucket.width_m, surcharge_pa, gravity);
    const CuttingForce loose = cutting_force(loose_, loose_table_.at(rake_rad), rake_rad,
                                             level * before.loose_m, bucket.width_m, 0.0, gravity);
    const double stones = std::max(0.2, 1.0 + profile_.soil.stone_share * stone_);
    cutting = {stones * (firm.against_n + loose.against_n), stones * firm.down_n + loose.down_n};
  }
  yield_n_ = {goes_in_n + cutting.against_n + rubs_n_ * std::abs(way.dot(floor)), cutting.down_n};
}

void BucketSoil::look() {
  const Eigen::Vector2d& floor = floor_;
  cut();
  drop();
  for (int n = 0; n < kFloorPoints; ++n) {
    const double along_m = profile_.bucket.floor_m * (n + 0.5) / kFloorPoints;
    const Eigen::Vector2d middle = across(edge_m_.x() + along_m * floor.x(), 0.0);
    ground_m_[static_cast<std::size_t>(n)] = ground_.height_m(middle.x(), middle.y());
  }
  const Eigen::Vector2d away_m = edge_m_ - anchor_m_;
  if (away_m.norm() > kNoWay_m) {
    way_ = away_m.normalized();
  }
  find_yield();
  if (steps_ / look_steps_ % kLooksToSettle == 0) {
    const Eigen::Vector2d at_m = across(edge_m_.x(), 0.0);
    ground_.settle(at_m.x(), at_m.y(), kSettle_m);
  }
}

/// The floor on the ground: elastic up to what the ground bears, then the ground gives way.
BucketForce BucketSoil::bear() {
  BucketForce sum;
  const Eigen::Vector2d& floor = floor_;
  const Eigen::Vector2d normal(floor.y(), -floor.x());  // Out of the floor, into the ground.
  rubs_n_ = 0.0;
  if (normal.y() >= 0.0) {
    return sum;  // It looks up.
  }
  const double area_m2 = profile_.bucket.width_m * profile_.bucket.floor_m / kFloorPoints;
  for (int n = 0; n < kFloorPoints; ++n) {
    const double along_m = profile_.bucket.floor_m * (n + 0.5) / kFloorPoints;
    const Eigen::Vector2d arm_m = along_m * floor;
    double& ground_m = ground_m_[static_cast<std::size_t>(n)];
    const double sunk_m = ground_m - (edge_m_.y() + arm_m.y());
    if (sunk_m <= 0.0) {
      continue;
    }
    double pressure_pa = kSubgrade_papm * sunk_m;
    if (pressure_pa > bears_pa_) {
      ground_m -= sunk_m - bears_pa_ / kSubgrade_papm;
      pressure_pa = bears_pa_;
      over_width([&](double level_m) {
        const Eigen::Vector2d at_m = across(edge_m_.x() + arm_m.x(), level_m);
        ground_.press(at_m.x(), at_m.y(), ground_m);
      });
    }
    const Eigen::Vector2d force_n = -pressure_pa * area_m2 * normal;
    sum.force_n += force_n;
    sum.moment_nm += cross(arm_m, force_n);
    rubs_n_ += pressure_pa * area_m2 * std::tan(profile_.soil.wall_friction_rad);
  }
  return sum;
}

BucketForce BucketSoil::step(const BucketPlace& place) {
  place_ = place;
  plane_ = direction(place.swing_rad);
  floor_ = direction(place.attitude_rad - profile_.bucket.floor_rad);
  const Eigen::Vector2d edge_m(place.radius_m, place.height_m - profile_.level_m);
  if (steps_ == 0) {
    edge_m_ = edge_m;
    anchor_m_ = edge_m;
    make_room();
  }
  gone_m_ += (edge_m - edge_m_).norm();
  edge_m_ = edge_m;
  if (profile_.soil.stone_m > 0.0 && gone_m_ > profile_.soil.stone_m) {
    gone_m_ = 0.0;
    stone_ = random_.normal();
  }
  if (steps_ % look_steps_ == 0) {
    look();
  }
  ++steps_;

  BucketForce sum = bear();
  Eigen::Vector2d away_m = edge_m_ - anchor_m_;
  const double most_m = yield_n_.x() / kSpring_npm;
  const double length_m = away_m.norm();
  if (length_m > most_m) {
    away_m *= most_m / length_m;
    anchor_m_ = edge_m_ - away_m;
  }
  if (most_m > 0.0) {
    const double share = std::min(1.0, length_m / most_m);
    const Eigen::Vector2d way = length_m > kNoWay_m ? Eigen::Vector2d(away_m.normalized())
                                                    : Eigen::Vector2d(Eigen::Vector2d::Zero());
    sum.force_n += -kSpring_npm * away_m + share * yield_n_.y() * turned(way);
  }
  return sum;
}

}  // namespace graben::plant
