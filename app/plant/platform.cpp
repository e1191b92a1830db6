#include "app/plant/platform.hpp"

#include <algorithm>

namespace graben::plant {

Platform::Platform(const PlatformData& data, double angle_rad, double links_kgm2)
    : data_(data),
      angle_(angle_rad),
      inertia_(data.inertia_kgm2 + links_kgm2),
      between_inertia_(inertia_) {}

double Platform::accelerate(const MotorLoad& load, double links_kgm2, double step_s) {
  // (I+ + h/2 D) w+ = (I- - h/2 D) w- + h (T + f)
  const double next_inertia = data_.inertia_kgm2 + links_kgm2;
  const double end_inertia = 0.5 * (inertia_ + next_inertia);
  const double half_damping = 0.5 * step_s * (load.damping_nmsprad + data_.viscous_nmsprad);
  const double momentum = (between_inertia_ - half_damping) * rate_ + step_s * load.torque_nm;
  const double most = step_s * data_.coulomb_nm;
  const double friction = std::clamp(-momentum, -most, most);
  const double before = rate_;
  rate_ = (momentum + friction) / (end_inertia + half_damping);
  friction_ = friction / step_s;
  change_ = rate_ - before;
  inertia_ = next_inertia;
  between_inertia_ = end_inertia;
  return 0.5 * (before + rate_);
}

}  // namespace graben::plant
