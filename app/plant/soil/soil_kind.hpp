// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a soil is to a bucket.

namespace graben::plant {

/// SI units. In the ground unless said otherwise.
struct SoilKind {
  double density_kgpm3 = 0.0;
  double cohesion_pa = 0.0;        ///< c.
  double adhesion_pa = 0.0;        ///< c_a, to steel.
  double friction_rad = 0.0;       ///< phi, internal.
  double wall_friction_rad = 0.0;  ///< delta, on steel.
  double repose_rad = 0.0;         ///< Slope at which what is loose lies.
  double swell = 1.0;              ///< Volume of loose soil over that of the same in the ground.
  double stone_share = 0.0;  ///< Deviation of the cutting force that stones make, of the force.
  double stone_m = 0.0;      ///< Way from one stone to the next.
};

}  // namespace graben::plant
