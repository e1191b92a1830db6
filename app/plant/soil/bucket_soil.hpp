// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The bucket in the ground: what it cuts and carries, and what the soil does to it.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "app/plant/link_body.hpp"
#include "app/plant/random.hpp"
#include "app/plant/soil/cutting.hpp"
#include "app/plant/soil/digging_profile.hpp"
#include "app/plant/soil/height_field.hpp"

namespace graben::plant {

/// The bucket's place in the plane of the links, and where that plane is. `radius_m` is level, from
/// the swing axis; `height_m` over the ground frame; attitude as TipPose.
struct BucketPlace {
  double radius_m = 0.0;
  double height_m = 0.0;
  double attitude_rad = 0.0;
  double swing_rad = 0.0;
};

/// On the edge, in the plane's axes, and about it.
struct BucketForce {
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double moment_nm = 0.0;
};

/// The force on the edge is that of an elastic soil that yields: towards any side it holds the edge
/// with the force that it takes to cut there, and no more. So it resists motion, has no power over
/// a bucket at rest, and springs back by a few millimetres. Beside it the floor bears on what it
/// stands on. What the bucket carries is a mass that moves with it. Left out: what it takes to set
/// soil in motion as it comes in, the soil's force across the plane of the links, and suction.
class BucketSoil {
 public:
  BucketSoil(const DiggingProfile& profile, std::uint64_t seed, double step_s);

  /// Force over the next step; to be called once a step. Where the bucket is at the first call the
  /// ground makes room for it.
  BucketForce step(const BucketPlace& place);

  /// Heights over `profile().level_m`.
  [[nodiscard]] const HeightField& ground() const { return ground_; }
  [[nodiscard]] double fill_m3() const { return fill_m3_; }  ///< Loose.
  [[nodiscard]] double fill_kg() const;
  /// What the bucket carries, in the bucket's link frame.
  [[nodiscard]] LinkBody fill() const;
  [[nodiscard]] double cut_m3() const { return cut_m3_; }  ///< Of undisturbed soil, so far.
  [[nodiscard]] const DiggingProfile& profile() const { return profile_; }

 private:
  /// The surface before the edge.
  struct Front {
    double firm_m = 0.0;       ///< Over the edge.
    double loose_m = 0.0;      ///< Loose soil over the edge where no firm soil is.
    double surcharge_m = 0.0;  ///< Loose soil on the firm one.
    double top_m = 0.0;        ///< Of all, over the edge.
  };
  static constexpr int kFloorPoints = 5;

  template <class Each>
  void over_width(const Each& each) const;
  [[nodiscard]] Eigen::Vector2d across(double along_m, double level_m) const;
  void make_room();
  void look();
  void cut();
  void take(const TakenSoil& taken);
  void drop();
  [[nodiscard]] Front front(double way) const;
  void find_yield();
  [[nodiscard]] BucketForce bear();
  [[nodiscard]] double holds_m3() const;

  DiggingProfile profile_;
  SoilKind loose_;
  CuttingTable firm_table_;
  CuttingTable loose_table_;
  int width_points_;
  double bears_pa_;  ///< The ground, under a piece of the floor.
  long look_steps_;
  HeightField ground_;
  Random random_;
  long steps_ = 0;
  BucketPlace place_;
  Eigen::Vector2d plane_ = Eigen::Vector2d::UnitX();    ///< Of the links, seen from above.
  Eigen::Vector2d floor_ = Eigen::Vector2d::UnitX();    ///< From the edge to the heel.
  Eigen::Vector2d edge_m_ = Eigen::Vector2d::Zero();    ///< Radius, height.
  Eigen::Vector2d anchor_m_ = Eigen::Vector2d::Zero();  ///< Where the edge's soil is relaxed.
  Eigen::Vector2d way_ = -Eigen::Vector2d::UnitX();     ///< That the edge presses.
  Eigen::Vector2d yield_n_ = Eigen::Vector2d::Zero();   ///< Against the motion, down across it.
  std::array<double, kFloorPoints> ground_m_{};         ///< Under the floor's points.
  double rubs_n_ = 0.0;                                 ///< Friction that the floor can have.
  double supported_m_ = 0.0;  ///< Soil before the opening, which keeps the fill in.
  double stone_ = 0.0;
  double gone_m_ = 0.0;  ///< Way of the edge since the last stone.
  double fill_m3_ = 0.0;
  double cut_m3_ = 0.0;
};

}  // namespace graben::plant
