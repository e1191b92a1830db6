#include "app/plant/wave_volume.hpp"

namespace graben::plant {

WaveVolume::WaveVolume(std::size_t port_count, double bulk_modulus_pa, double step_s)
    : count_(port_count),
      impedance_volume_(0.5 * static_cast<double>(port_count) * bulk_modulus_pa * step_s /
                        (1.0 - kFilter)) {}

void WaveVolume::scatter() {
  std::array<double, kMaxPorts> reflected{};
  double wave_sum = 0.0;
  double flow_sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    reflected[i] = wave_[i] + 2.0 * impedance_ * flow_[i];
    wave_sum += wave_[i];
    flow_sum += flow_[i];
  }
  const double count = static_cast<double>(count_);
  const double twice_mean = 2.0 * (wave_sum + 2.0 * impedance_ * flow_sum) / count;
  pressure_ = (wave_sum + impedance_ * flow_sum) / count;
  first_port_pressure_ = wave_[0] + impedance_ * flow_[0];
  for (std::size_t i = 0; i < count_; ++i) {
    wave_[i] = kFilter * wave_[i] + (1.0 - kFilter) * (twice_mean - reflected[i]);
  }
}

void WaveVolume::start(double pressure_pa) {
  pressure_ = pressure_pa;
  first_port_pressure_ = pressure_pa;
  for (std::size_t i = 0; i < count_; ++i) {
    wave_[i] = pressure_pa - impedance_ * flow_[i];
  }
}

}  // namespace graben::plant
