// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A rigid body in the plane of the links.

#include <Eigen/Core>

namespace graben::plant {

/// One link as a rigid body in the sagittal plane, or what it carries.
struct LinkBody {
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;  ///< About the mass centre, out of plane.
  Eigen::Vector2d mass_centre_m = Eigen::Vector2d::Zero();  ///< Link frame, x from pin to pin.
};

/// Two bodies of one frame that move as one; not both without mass.
inline LinkBody together(const LinkBody& a, const LinkBody& b) {
  const double mass_kg = a.mass_kg + b.mass_kg;
  const Eigen::Vector2d apart_m = b.mass_centre_m - a.mass_centre_m;
  const double reduced_kg = a.mass_kg * b.mass_kg / mass_kg;
  return {mass_kg, a.inertia_kgm2 + b.inertia_kgm2 + reduced_kg * apart_m.squaredNorm(),
          a.mass_centre_m + b.mass_kg / mass_kg * apart_m};
}

}  // namespace graben::plant
