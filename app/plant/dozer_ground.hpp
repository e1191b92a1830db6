// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's ground: the terrain that its blade cuts, and the traction of its tracks.

#include <Eigen/Core>
#include <vector>

#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

/// World frame, z up. Heights stand at nodes and run straight between them; beyond either end the
/// last one goes on. Flat at z = 0 until it is cut.
class Terrain {
 public:
  Terrain(double from_m, double to_m, double cell_m);

  [[nodiscard]] double height_m(double x_m) const { return at(place(x_m)); }
  /// Mean over `half_width_m` to either side.
  [[nodiscard]] double mean_height_m(double x_m, double half_width_m) const;
  /// Its derivative.
  [[nodiscard]] double mean_slope(double x_m, double half_width_m) const {
    return (height_m(x_m + half_width_m) - height_m(x_m - half_width_m)) / (2.0 * half_width_m);
  }

  /// The cutting edge has gone straight from one place to the other. Each node that it passed on
  /// the way forward is lowered to it; where it was pressed in rather than driven (steeper than 45
  /// degrees), so is the node next to it.
  void cut(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);

  /// Raises each node between the two places, the first not among them, to this height at least.
  void fill(double from_m, double to_m, double height_m);

  [[nodiscard]] double cell_m() const { return cell_; }
  [[nodiscard]] double begin_m() const { return from_; }
  [[nodiscard]] double end_m() const;

 private:
  /// In cells from the first node on.
  [[nodiscard]] double place(double x_m) const { return (x_m - from_) / cell_; }
  [[nodiscard]] double at(double place) const;
  [[nodiscard]] double node(long index) const;
  void lower(long index, double height_m);

  double from_;
  double cell_;
  std::vector<double> height_;
};

/// Janosi and Hanamoto's shear (Wong) with a memory. The state is the shear displacement j at the
/// contact's rear end, which grows with the slipping speed and is left behind as the track moves
/// on:
///   dj/dt = (v_t - v) - max(|v_t|, |v|) j / L.
/// The force is the mean of mu N (1 - exp(-j / K)) over the contact, along which the displacement
/// grows evenly:
///   F = mu N (1 - (1 - exp(-u)) / u), u = |j| / K.
/// At a steady speed j = s L, which is Janosi and Hanamoto's force at the slip s; at rest j stays
/// and holds, with no creep. Shear is damped; the whole is no more than friction gives.
class Traction {
 public:
  explicit Traction(const DozerPlantProfile& profile);

  /// Speeds along the body, forward positive; the load is that of this track. Returns the force
  /// that drives the body forward, N.
  double step(double track_speed_mps, double ground_speed_mps, double load_n, double step_s);

  [[nodiscard]] double force_n() const { return force_; }
  [[nodiscard]] double shear_m() const { return shear_; }
  /// (v_t - v) / max(|v_t|, |v|), in steady motion.
  [[nodiscard]] double slip() const { return shear_ / contact_; }

 private:
  double friction_;
  double modulus_;
  double contact_;
  double damping_;
  double shear_ = 0.0;
  double force_ = 0.0;
};

}  // namespace graben::plant
