#pragma once
/// What boom, arm and bucket are to the swing: their inertia about its axis, and what turning does
/// to them.

#include <array>

#include "app/plant/excavator_plant_profile.hpp"
#include "app/plant/linkage_geometry.hpp"

namespace graben::plant {

/// I(q) = sum m r^2 + J cos^2(phi): r is the mass centre's distance from the swing axis, a_1
/// forward of which the boom foot is; J the link's own inertia as of a thin rod along its pins, at
/// phi against the horizontal. Of its width, and of its height where it is bent, nothing is known;
/// the share of J is a tenth of the whole at the most.
class SwingInertia {
 public:
  explicit SwingInertia(const ExcavatorPlantProfile& profile);

  /// To these joints, relative as the joint angles.
  void update(const JointRotations& joint);

  [[nodiscard]] double inertia_kgm2() const { return inertia_; }
  /// dI / d(absolute link angle), kg m^2/rad. Half of it, times the swing rate's square, is the
  /// centrifugal moment on the link.
  [[nodiscard]] const JointArray& gradient_kgm2prad() const { return gradient_; }

 private:
  std::array<LinkBody, kAxisCount> body_;
  JointArray link_length_;
  double boom_foot_m_;
  double inertia_ = 0.0;
  JointArray gradient_{};
};

}  // namespace graben::plant
