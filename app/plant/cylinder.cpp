// SPDX-License-Identifier: Apache-2.0
#include "app/plant/cylinder.hpp"

#include <algorithm>

namespace graben::plant {
namespace {

constexpr double kQuarterPi = 0.7853981633974483;

}  // namespace

PistonAreas piston_areas(int count, double bore_m, double rod_m) {
  const double bore_square = bore_m * bore_m;
  return {count * kQuarterPi * bore_square, count * kQuarterPi * (bore_square - rod_m * rod_m)};
}

Cylinder::Cylinder(const CylinderData& data, double step_s)
    : chambers_({data.area.cap_m2,
                 data.area.rod_m2,
                 data.details.piston_leak_m3pspa,
                 {data.bulk_modulus_pa, data.details.boiling_pa}},
                step_s),
      cap_area_(data.area.cap_m2),
      rod_area_(data.area.rod_m2),
      step_(step_s),
      full_stroke_(data.stroke_m),
      dead_volume_(data.dead_volume_m3),
      back_pressure_(data.details.start_back_pressure_pa),
      friction_(data.friction),
      cushion_length_(data.cushion.length_m),
      cushion_end_(data.cushion.end_m),
      stop_stiffness_(data.details.end_stop_stiffness_npm),
      stop_damping_(data.details.end_stop_damping_nspm) {
  const auto cushion = [&data](double area_m2) {
    const double flow = area_m2 * data.cushion.speed_mps;
    return data.cushion.pressure_pa / (flow * flow);
  };
  cap_cushion_ = cushion(cap_area_);
  rod_cushion_ = cushion(rod_area_);
}

void Cylinder::start(double stroke_m, double force_n) {
  set_motion(stroke_m, 0.0);
  const double balance = force_n - back_pressure_ * (cap_area_ - rod_area_);
  chambers_.start(dead_volume_ + cap_area_ * stroke_m,
                  back_pressure_ + std::max(0.0, balance) / cap_area_,
                  dead_volume_ + rod_area_ * (full_stroke_ - stroke_m),
                  back_pressure_ + std::max(0.0, -balance) / rod_area_);
}

void Cylinder::set_motion(double stroke_m, double velocity_mps) {
  stroke_ = stroke_m;
  velocity_ = velocity_mps;
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
  const ChamberLoads oil = chambers_.load(velocity_);
  PistonLoad load;
  load.force_n = oil.a.force - oil.b.force;
  load.damping_nspm = oil.a.damping + oil.b.damping + friction_.viscous_nspm;
  load.coulomb_n = friction_.coulomb_n;
  add_end_stop(load);
  return load;
}

PistonPower Cylinder::power(double velocity_mps) const {
  PistonLoad stop;
  add_end_stop(stop);
  PistonPower power{chambers_.power(velocity_, velocity_mps)};
  power.viscous_w = friction_.viscous_nspm * velocity_mps * velocity_mps;
  power.end_stop_w = (stop.damping_nspm * velocity_mps - stop.force_n) * velocity_mps;
  return power;
}

void Cylinder::step(double cap_in_m3ps, double rod_in_m3ps, double velocity_mps) {
  chambers_.step(cap_in_m3ps, rod_in_m3ps, velocity_mps);
  const double travel = step_ * velocity_mps;
  chambers_.grow(cap_area_ * travel, -rod_area_ * travel);
}

}  // namespace graben::plant
