#include "app/plant/wave_volume.hpp"

namespace graben::plant {

WaveVolume::WaveVolume(std::size_t port_count, const Oil& oil, double step_s)
    : count_(port_count),
      oil_(oil),
      step_(step_s),
      port_share_(1.0 / static_cast<double>(port_count)),
      impedance_per_stiffness_(0.5 / (1.0 - kFilter) * static_cast<double>(port_count) * step_s) {}

void WaveVolume::start(double volume_m3, double pressure_pa) {
  set_volume(volume_m3);
  surplus_ = pressure_pa / stiffness_;
  mean_ = pressure_pa;
  for (std::size_t i = 0; i < count_; ++i) {
    deviation_[i] = -impedance_ * flow_[i];
  }
}

}  // namespace graben::plant
