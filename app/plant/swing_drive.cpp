// SPDX-License-Identifier: Apache-2.0
#include "app/plant/swing_drive.hpp"

#include <algorithm>

namespace graben::plant {

SwingMotor::SwingMotor(const SwingMotorData& data, double step_s)
    : chambers_({data.displacement_m3prad, data.displacement_m3prad, data.leak_m3pspa, data.oil},
                step_s),
      oil_(data.oil) {
  chambers_.start(data.chamber_volume_m3, data.start_pa, data.chamber_volume_m3, data.start_pa);
}

MotorLoad SwingMotor::load() const {
  const ChamberLoads oil = chambers_.load(rate_);
  const double left_share = flow_energy_share(oil_, left().pressure_pa());
  const double right_share = flow_energy_share(oil_, right().pressure_pa());
  return {left_share * oil.a.force - right_share * oil.b.force,
          left_share * oil.a.damping + right_share * oil.b.damping};
}

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
