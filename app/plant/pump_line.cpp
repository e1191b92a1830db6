// SPDX-License-Identifier: Apache-2.0
#include "app/plant/pump_line.hpp"

#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

constexpr std::size_t kPumpPort = 0;
constexpr std::size_t kBypassPort = 1;
constexpr int kStandbyHalvings = 60;

double inverse_square(double k) { return 1.0 / (k * k); }

}  // namespace

PumpLine::PumpLine(const PumpLineData& data, std::size_t section_count)
    : line_(2 + 2 * section_count, data.oil, data.step_s),
      volume_(data.volume_m3),
      protection_(data.protection),
      displacement_m3prev_(data.pump.displacement_m3prev),
      speed_radps_(data.pump.rated_speed_radps),
      leak_linear_(data.pump.leak_linear),
      leak_quadratic_(data.pump.leak_quadratic),
      fixed_inverse_square_(inverse_square(data.pump.bypass_series[0]) +
                            inverse_square(data.pump.bypass_series[1])),
      regulator_(data.pump.regulator,
                 {data.pump.displacement_m3prev * data.pump.rated_speed_radps / kTwoPi,
                  data.oil.bulk_modulus_pa / data.volume_m3, data.pump.bypass_series[1],
                  data.protection.relief_pa},
                 data.step_s) {
  set_swash(data.swash_ratio);
}

void PumpLine::set_swash(double swash_ratio) {
  swash_ = swash_ratio;
  ideal_flow_ = displacement_m3prev_ * swash_ * speed_ratio_ * speed_radps_ / kTwoPi;
}

double PumpLine::rated_flow_m3ps() const { return displacement_m3prev_ * speed_radps_ / kTwoPi; }

void PumpLine::set_section_flows(std::size_t section, double supply_out_m3ps,
                                 double recycle_in_m3ps) {
  line_.set_flow(2 + 2 * section, -supply_out_m3ps);
  line_.set_flow(3 + 2 * section, recycle_in_m3ps);
}

void PumpLine::set_bypass(double inverse_square_of_sections) {
  k_bypass_ = 1.0 / std::sqrt(fixed_inverse_square_ + inverse_square_of_sections);
}

double PumpLine::delivery(const WavePort& port) const {
  // With p = c + Z (Q - l p - m p^2): Z m p^2 + (1 + Z l) p - (c + Z Q) = 0. Below ambient nothing
  // leaks.
  const double z = port.impedance_paspm3;
  const double unleaked = port.wave_pa + z * ideal_flow_;
  if (unleaked <= 0.0) {
    return ideal_flow_;
  }
  const double b = 1.0 + z * leak_linear_;
  const double pressure =
      2.0 * unleaked / (b + std::sqrt(b * b + 4.0 * z * leak_quadratic_ * unleaked));
  return ideal_flow_ - (leak_linear_ + leak_quadratic_ * pressure) * pressure;
}

void PumpLine::step() {
  const WavePort pump = line_.port(kPumpPort);
  flows_.line_in_m3ps = protected_flow(pump, protection_, [this](const WavePort& port) {
    return flows_.delivered_m3ps = delivery(port);
  });
  flows_.pump_port_pa = pump.pressure_pa(flows_.line_in_m3ps);
  const WavePort bypass = line_.port(kBypassPort);
  flows_.bypass_m3ps = orifice_flow(k_bypass_, bypass, kTank);
  flows_.bypass_port_pa = bypass.pressure_pa(-flows_.bypass_m3ps);
  line_.set_flow(kPumpPort, flows_.line_in_m3ps);
  line_.set_flow(kBypassPort, -flows_.bypass_m3ps);
  line_.scatter();
}

void PumpLine::regulate(double load_pa) {
  set_swash(regulator_.next(swash_, {pressure_pa(), load_pa, flows_.bypass_m3ps}));
  protection_.relief_pa = regulator_.relief_pa(load_pa);
}

/// Nothing but leakage is given.
void PumpLine::start_at_margin() {
  const double pressure = regulator_.margin_pa();
  const double lost =
      (leak_linear_ + leak_quadratic_ * pressure) * pressure + k_bypass_ * std::sqrt(pressure);
  set_swash(lost / rated_flow_m3ps());
  regulator_.start(swash_);
  const double flow = k_bypass_ * std::sqrt(pressure);
  flows_ = {flow, flow, flow, pressure, pressure};
  line_.set_flow(kPumpPort, flow);
  line_.set_flow(kBypassPort, -flow);
  line_.start(volume_, pressure);
}

void PumpLine::start() {
  if (regulator_.senses_load()) {
    start_at_margin();
    return;
  }
  double low = 0.0;
  double high = protection_.relief_pa;
  for (int i = 0; i < kStandbyHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (regulator_.sets_swash()) {
      set_swash(regulator_.settled(k_bypass_ * std::sqrt(middle)));
    }
    const double surplus = delivery({middle, 0.0}) - k_bypass_ * std::sqrt(middle);
    (surplus > 0.0 ? low : high) = middle;
  }
  const double flow = delivery({low, 0.0});
  flows_ = {flow, flow, flow, low, low};
  line_.set_flow(kPumpPort, flow);
  line_.set_flow(kBypassPort, -flow);
  line_.start(volume_, low);
}

}  // namespace graben::plant
