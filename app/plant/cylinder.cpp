#include "app/plant/cylinder.hpp"

#include <algorithm>

namespace graben::plant {
namespace {

constexpr double kQuarterPi = 0.7853981633974483;

double step_seconds(const PlantProfile& profile) {
  return 1e-6 * static_cast<double>(profile.step_us);
}

}  // namespace

Cylinder::Cylinder(const PlantProfile& profile, int axis)
    : cap_(2, profile.bulk_modulus_pa, step_seconds(profile)),
      rod_(2, profile.bulk_modulus_pa, step_seconds(profile)),
      leak_(profile.piston_leak_m3pspa),
      back_pressure_(profile.start_back_pressure_pa),
      stop_stiffness_(profile.end_stop_stiffness_npm),
      stop_damping_(profile.end_stop_damping_nspm) {
  const auto index = static_cast<std::size_t>(axis);
  const CylinderGeometry& data = profile.machine.geometry.cylinder[index];
  const double bore_square = data.bore_m * data.bore_m;
  cap_area_ = data.count * kQuarterPi * bore_square;
  rod_area_ = data.count * kQuarterPi * (bore_square - data.rod_m * data.rod_m);
  full_stroke_ = data.stroke_m;
  dead_volume_ = profile.dead_volume_m3[index];
  friction_ = profile.friction[index];
}

void Cylinder::start(double stroke_m, double force_n) {
  set_motion(stroke_m, 0.0);
  const double balance = force_n - back_pressure_ * (cap_area_ - rod_area_);
  cap_.start(back_pressure_ + std::max(0.0, balance) / cap_area_);
  rod_.start(back_pressure_ + std::max(0.0, -balance) / rod_area_);
}

void Cylinder::set_motion(double stroke_m, double velocity_mps) {
  stroke_ = stroke_m;
  velocity_ = velocity_mps;
  const double inside = std::clamp(stroke_m, 0.0, full_stroke_);
  cap_.set_volume(dead_volume_ + cap_area_ * inside);
  rod_.set_volume(dead_volume_ + rod_area_ * (full_stroke_ - inside));
}

void Cylinder::add_end_stop(PistonLoad& load) const {
  const double overrun = stroke_ > full_stroke_ ? stroke_ - full_stroke_ : std::min(0.0, stroke_);
  if (overrun == 0.0) {
    return;
  }
  load.force_n -= stop_stiffness_ * overrun;
  if (overrun * velocity_ > 0.0) {
    load.damping_nspm += stop_damping_;
  }
}

PistonLoad Cylinder::load() const {
  const WavePort cap = cap_.port(kPiston);
  const WavePort rod = rod_.port(kPiston);
  const double leak = leak_m3ps();
  PistonLoad load;
  load.force_n = cap_area_ * (cap.wave_pa - cap.impedance_paspm3 * leak) -
                 rod_area_ * (rod.wave_pa + rod.impedance_paspm3 * leak);
  load.damping_nspm = cap_area_ * cap_area_ * cap.impedance_paspm3 +
                      rod_area_ * rod_area_ * rod.impedance_paspm3 + friction_.viscous_nspm;
  load.coulomb_n = friction_.coulomb_n;
  add_end_stop(load);
  return load;
}

void Cylinder::step(double cap_in_m3ps, double rod_in_m3ps, double velocity_mps) {
  const double leak = leak_m3ps();
  cap_.set_flow(kValve, cap_in_m3ps);
  cap_.set_flow(kPiston, -cap_area_ * velocity_mps - leak);
  cap_.scatter();
  rod_.set_flow(kValve, rod_in_m3ps);
  rod_.set_flow(kPiston, rod_area_ * velocity_mps + leak);
  rod_.scatter();
}

}  // namespace graben::plant
