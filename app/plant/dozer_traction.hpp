#pragma once
/// What one track and the ground do to each other.

#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

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
