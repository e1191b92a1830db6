#include "app/plant/wave_volume.hpp"

namespace graben::plant {

WaveVolume::WaveVolume(std::size_t port_count, const Oil& oil, double step_s)
    : count_(port_count), oil_(oil), step_(step_s) {}

void WaveVolume::set_volume(double volume_m3) {
  volume_ = volume_m3;
  stiffness_ = oil_.bulk_modulus_pa / volume_;
  impedance_ = 0.5 / (1.0 - kFilter) * static_cast<double>(count_) * stiffness_ * step_;
}

void WaveVolume::start(double volume_m3, double pressure_pa) {
  set_volume(volume_m3);
  surplus_ = pressure_pa / stiffness_;
  mean_ = pressure_pa;
  for (std::size_t i = 0; i < count_; ++i) {
    deviation_[i] = -impedance_ * flow_[i];
  }
}

void WaveVolume::scatter() {
  double flow_sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    flow_sum += flow_[i];
  }
  const double mean_flow = flow_sum / static_cast<double>(count_);
  const double gain = 2.0 * (1.0 - kFilter) * impedance_;
  for (std::size_t i = 0; i < count_; ++i) {
    deviation_[i] = (2.0 * kFilter - 1.0) * deviation_[i] - gain * (flow_[i] - mean_flow);
  }
  surplus_ += step_ * flow_sum;
  mean_ = stiffness_ * surplus_;
}

void WaveVolume::grow(double volume_m3) {
  set_volume(volume_ + volume_m3);
  mean_ = stiffness_ * surplus_;
}

}  // namespace graben::plant
