// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ground that resists the dozer's blade: what it cuts, carries before it and loses at its ends.

#include <Eigen/Core>

#include "app/plant/dozer_ground.hpp"
#include "app/plant/random.hpp"
#include "app/plant/soil/cutting.hpp"

namespace graben::plant {

/// Soil before the blade. What is cut swells and joins the prism, whose free face lies at the angle
/// of repose; what is more than the blade holds up, and a share of the rest with every metre, runs
/// off at both ends and is lost. Where the edge is above the ground the prism fills below it, so
/// that what the blade leaves is level with its edge as far as the prism goes.
///
/// The force is the fundamental equation of earthmoving for the depth of cut, with the prism as the
/// surcharge on the failing wedge; the rest of the prism rides along on the ground and rubs on it.
/// An edge that goes down into the ground is borne by it (Terzaghi) as far as it goes down steeper
/// than its own wear; a worn edge always rubs.
///
/// An edge with a slope across is cut into strips, each with its own depth. What they cut mixes
/// before the blade: the prism lies evenly over the width.
class BladeSoil {
 public:
  BladeSoil(const SoilKind& soil, const DozerPlantProfile& profile);

  /// The edge has gone from one place to the other; cuts, fills and carries.
  void move(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, Terrain& terrain) {
    cut_strip(from_m, to_m, 1.0, terrain);
    go_on(to_m.x() - from_m.x());
  }
  /// Force on the edge here and moving so, in the world, N. `beside` is where of its width, from 1
  /// at the left end to -1 at the right one: a stone lies more on one side.
  [[nodiscard]] Eigen::Vector2d force_n(const Eigen::Vector2d& edge_m,
                                        const Eigen::Vector2d& velocity_mps, double pitch_rad,
                                        const Terrain& terrain, double beside = 0.0) const;

  /// The same of an edge that is not level: that share of its width has gone so over its own line
  /// of the ground, and after all of them the blade has gone on so far.
  void cut_strip(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double share,
                 Terrain& terrain);
  void go_on(double way_m);

  /// Loose, over the whole width.
  [[nodiscard]] double carried_m3() const { return carried_; }
  [[nodiscard]] double lost_m3() const { return lost_; }

 private:
  [[nodiscard]] double holds_m3() const;
  void lose(double way_m);

  SoilKind soil_;
  BladeShape blade_;
  CuttingTable factors_;
  double gravity_;
  Random random_;
  double carried_ = 0.0;
  double lost_ = 0.0;
  double gone_ = 0.0;   ///< Since the last stone.
  double stone_ = 0.0;  ///< In deviations.
  Random side_random_;
  double stone_left_ = 0.0;  ///< More than that at the left end, less at the right one.
};

}  // namespace graben::plant
