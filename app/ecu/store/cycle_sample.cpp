// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/cycle_sample.hpp"

#include <cmath>

namespace graben::ecu {
namespace {

/// Fills a sample in, value by value in its order.
class Filling {
 public:
  explicit Filling(CycleSample& sample) : sample_(sample) {}

  void stroke(std::size_t at, const Signal<double>& from) { set(sample_.stroke[at], at, from); }
  void pressure(std::size_t at, const Signal<double>& from) {
    set(sample_.pressure_pa[at], kSampleStrokes + at, from);
  }
  void duty(std::size_t at, double ratio) { sample_.duty_ratio[at] = finite(ratio); }

 private:
  static float finite(double value) {
    return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
  }
  void set(float& to, std::size_t bit, const Signal<double>& from) {
    if (from.validity == Validity::kValid && std::isfinite(from.value)) {
      to = static_cast<float>(from.value);
      sample_.known = static_cast<std::uint16_t>(sample_.known | 1U << bit);
    }
  }

  CycleSample& sample_;
};

CycleSample of_status(const MachineStatus& status, TimeUs now_us) {
  CycleSample sample;
  sample.now_us = now_us;
  sample.lambda = std::isfinite(status.lambda) ? static_cast<float>(status.lambda) : 0.0F;
  sample.mode = status.mode;
  return sample;
}

constexpr SampleNames kExcavatorNames = {
    {"boom_m", "arm_m", "bucket_m", "swing_rad"},
    {"boom_cap_pa", "boom_rod_pa", "arm_cap_pa", "arm_rod_pa", "bucket_cap_pa", "bucket_rod_pa",
     "swing_left_pa", "swing_right_pa"},
    {"boom_duty", "arm_duty", "bucket_duty", "swing_duty"}};
constexpr SampleNames kDozerNames = {
    {"blade_m", "tilt_m", nullptr, nullptr},
    {"left_line_pa", "right_line_pa", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
    {"blade_duty", "tilt_duty", "left_pump", "right_pump"}};

}  // namespace

CycleSample sample_of(const ExcavatorInputs& in, const ExcavatorOutputs& out, TimeUs now_us) {
  CycleSample sample = of_status(out.status, now_us);
  Filling to(sample);
  for (std::size_t i = 0; i < in.axis.size(); ++i) {
    to.stroke(i, in.axis[i].stroke_m);
    to.pressure(2 * i, in.axis[i].cap_pressure_pa);
    to.pressure(2 * i + 1, in.axis[i].rod_pressure_pa);
  }
  to.stroke(in.axis.size(), in.swing.angle_rad);
  to.pressure(2 * in.axis.size(), in.swing.left_pressure_pa);
  to.pressure(2 * in.axis.size() + 1, in.swing.right_pressure_pa);
  for (std::size_t i = 0; i < out.duty_ratio.size(); ++i) {
    to.duty(i, out.duty_ratio[i]);
  }
  return sample;
}

CycleSample sample_of(const DozerInputs& in, const DozerOutputs& out, TimeUs now_us) {
  CycleSample sample = of_status(out.status, now_us);
  Filling to(sample);
  to.stroke(0, in.blade_stroke_m);
  to.stroke(1, in.tilt_stroke_m);
  to.duty(0, out.blade_duty_ratio);
  to.duty(1, out.tilt_duty_ratio);
  for (std::size_t i = 0; i < in.track.size(); ++i) {
    to.pressure(i, in.track[i].line_pressure_pa);
    to.duty(2 + i, out.pump_ratio[i]);
  }
  return sample;
}

const SampleNames& sample_names(SampleKind kind) {
  return kind == SampleKind::kDozer ? kDozerNames : kExcavatorNames;
}

}  // namespace graben::ecu
