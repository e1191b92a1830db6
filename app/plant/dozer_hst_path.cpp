// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_hst_path.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

/// The port with a laminar leak to the charge gallery, from where pressures count here.
WavePort leaking(const WavePort& port, double leak_m3pspa) {
  const double share = 1.0 / (1.0 + port.impedance_paspm3 * leak_m3pspa);
  return {share * port.wave_pa, share * port.impedance_paspm3};
}

Oil oil_of(const DozerPlantProfile& profile) {
  return {profile.bulk_modulus_pa, profile.boiling_pa - profile.charge_pa};
}

}  // namespace

DisplacementServo::DisplacementServo(double least, double start, double response_s, double rate_ps,
                                     double dead_time_s, double step_s)
    : least_(least),
      start_(start),
      late_(dead_time_s, step_s),
      share_(-std::expm1(-step_s / response_s)),
      most_(rate_ps * step_s),
      wanted_(start),
      ratio_(start) {}

void DisplacementServo::set_wanted(double ratio) {
  wanted_ = std::isfinite(ratio) ? ratio : start_;
}

void DisplacementServo::step() {
  const double wanted = start_ + late_.step(wanted_ - start_);
  const double asked = (fault_.reversed ? -wanted : wanted) + fault_.offset_ratio;
  const double target = std::clamp(fault_.held_ratio.value_or(asked), least_, 1.0);
  ratio_ += std::clamp(share_ * (target - ratio_), -most_, most_);
}

HstPath::HstPath(const DozerPlantProfile& profile, std::size_t track)
    : pump_(-1.0, 0.0, profile.pump_response_s,
            profile.displacement_rate_margin * profile.machine.hst.pump_rate_ps,
            profile.displacement_dead_time_s, profile.step_s()),
      motor_(profile.machine.hst.motor_ratio_min, 1.0, profile.motor_response_s,
             profile.displacement_rate_margin * profile.machine.hst.motor_rate_ps,
             profile.displacement_dead_time_s, profile.step_s()),
      line_{WaveVolume(2, oil_of(profile), profile.step_s()),
            WaveVolume(2, oil_of(profile), profile.step_s())},
      protection_(profile.protection(profile.hst_relief_pa)),
      step_(profile.step_s()),
      charge_(profile.charge_pa),
      flushing_m3pspa_(profile.hst_flushing_m3pspa),
      shuttle_pa_(profile.hst_shuttle_pa),
      inertia_(profile.path_inertia_kgm2),
      radius_(profile.machine.hst.sprocket_radius_m),
      friction_share_(1.0 - profile.mechanical_efficiency),
      brake_(profile.brake_nm) {
  const HstProfile& hst = profile.machine.hst;
  protection_.boiling_pa = oil_of(profile).boiling_pa;
  const double constant = profile.hst_constant_loss_share;
  const double pump_loss = 1.0 - hst.pump_efficiency;
  // Of what the motor turns with: it has to take 1 / eta times that.
  const double motor_loss = 1.0 / hst.motor_efficiency - 1.0;
  const double full_flow = hst.pump_m3prev * hst.engine_radps / kTwoPi;
  pump_m3prad_ =
      profile.track_flow_factor[track] * hst.pump_m3prev / kTwoPi * (1.0 - constant * pump_loss);
  motor_m3prad_ = hst.motor_m3prev * hst.gear_ratio / kTwoPi;
  motor_flow_m3prad_ = motor_m3prad_ * (1.0 + constant * motor_loss);
  const double laminar_per_pa = (1.0 - constant) * full_flow / profile.hst_work_pa;
  pump_leak_m3pspa_ = laminar_per_pa * pump_loss;
  motor_leak_m3pspa_ = laminar_per_pa * hst.pump_efficiency * (1.0 - hst.motor_efficiency);
  for (WaveVolume& line : line_) {
    line.start(profile.hst_line_volume_m3, 0.0);
  }
}

void HstPath::feed(double engine_radps) {
  const double delivered = pump_.ratio() * pump_m3prad_ * engine_radps;
  for (std::size_t i = 0; i < line_.size(); ++i) {
    const double ideal = i == 0 ? delivered : -delivered;
    const auto after_leakage = [this, ideal](const WavePort& port) {
      const double pressure = leaking(port, pump_leak_m3pspa_).pressure_pa(ideal);
      return ideal - pump_leak_m3pspa_ * pressure;
    };
    flows_.pump_in[i] = protected_flow(line_[i].port(kPumpPort), protection_, after_leakage);
  }
}

double HstPath::flushing_m3pspa(std::size_t index) const {
  const double pressure_pa = line_[index].pressure_pa();
  const bool is_lower = pressure_pa + shuttle_pa_ < line_[1 - index].pressure_pa();
  return is_lower && pressure_pa > 0.0 ? flushing_m3pspa_ : 0.0;
}

void HstPath::turn(double traction_n, bool brake) {
  // J dw = h (D (p_A - p_B) - F r - friction), where the lines' pressures fall and rise with the
  // mean of old and new speed.
  const std::array<double, 2> leak_m3pspa = {motor_leak_m3pspa_ + flushing_m3pspa(0),
                                             motor_leak_m3pspa_ + flushing_m3pspa(1)};
  const WavePort a = leaking(line_[0].port(kMotorPort), leak_m3pspa[0]);
  const WavePort b = leaking(line_[1].port(kMotorPort), leak_m3pspa[1]);
  const double torque_per_pa = motor_.ratio() * motor_m3prad_;
  const double flow_per_speed = motor_.ratio() * motor_flow_m3prad_;
  const double damping = torque_per_pa * flow_per_speed * (a.impedance_paspm3 + b.impedance_paspm3);
  const double torque = torque_per_pa * (a.wave_pa - b.wave_pa);
  const double before = speed_radps_;
  const double mobility = step_ / (inertia_ + 0.5 * step_ * damping);
  const double free = before + mobility * (torque - damping * before - traction_n * radius_);
  const double friction = friction_share_ * std::abs(motor_torque_) + (brake ? brake_ : 0.0);
  speed_radps_ = free - std::clamp(free, -mobility * friction, mobility * friction);
  const double mean = 0.5 * (before + speed_radps_);
  const double a_pa = a.pressure_pa(-flow_per_speed * mean);
  const double b_pa = b.pressure_pa(flow_per_speed * mean);
  motor_torque_ = torque_per_pa * (a_pa - b_pa);
  flows_.motor_in = {-flow_per_speed * mean - leak_m3pspa[0] * a_pa,
                     flow_per_speed * mean - leak_m3pspa[1] * b_pa};
}

void HstPath::step(double engine_radps, double traction_n, bool brake) {
  pump_.step();
  motor_.step();
  feed(engine_radps);
  turn(traction_n, brake);
  for (std::size_t i = 0; i < line_.size(); ++i) {
    line_[i].set_flow(kPumpPort, flows_.pump_in[i]);
    line_[i].set_flow(kMotorPort, flows_.motor_in[i]);
    line_[i].scatter();
  }
}

}  // namespace graben::plant
