#include "firmware/safety/validation.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double kTwoPi = 6.28318530717958647693;
constexpr double kMicrosecondsPerSecond = 1e6;

/// A required number: where it comes from, where it goes, what its absence means.
struct Required {
  const Signal<double>* from;
  double* to;
  Fault missing;
};

class Freshness {
 public:
  Freshness(double timeout_s, TimeUs now_us)
      : timeout_us_(static_cast<TimeUs>(timeout_s * kMicrosecondsPerSecond)), now_us_(now_us) {}

  template <class T>
  [[nodiscard]] bool holds(const Signal<T>& signal) const {
    // A stamp from the future is as useless as an old one. No difference with a stamp: any number
    // can stand there.
    return signal.validity == Validity::kValid && signal.stamp_us <= now_us_ &&
           signal.stamp_us >= now_us_ - timeout_us_;
  }

 private:
  TimeUs timeout_us_;
  TimeUs now_us_;
};

constexpr std::size_t kRequiredCount = 3 * kAxisCount + kPumpCount + 1;

std::array<Required, kRequiredCount> required_signals(const ExcavatorInputs& inputs,
                                                      ValidInputs& valid,
                                                      std::array<double, kPumpCount>& swash,
                                                      double& engine_radps) {
  const auto stroke = [&](unsigned i) {
    return Required{&inputs.axis[i].stroke_m, &valid.strokes_m[i], Fault::kStrokeMissing};
  };
  const auto cap = [&](unsigned i) {
    return Required{&inputs.axis[i].cap_pressure_pa, &valid.cap_pressure_pa[i],
                    Fault::kPressureMissing};
  };
  const auto rod = [&](unsigned i) {
    return Required{&inputs.axis[i].rod_pressure_pa, &valid.rod_pressure_pa[i],
                    Fault::kPressureMissing};
  };
  const auto swash_of = [&](unsigned j) {
    return Required{&inputs.swash_ratio[j], &swash[j], Fault::kSwashMissing};
  };
  return {{stroke(0),
           stroke(1),
           stroke(2),
           cap(0),
           cap(1),
           cap(2),
           rod(0),
           rod(1),
           rod(2),
           swash_of(0),
           swash_of(1),
           {&inputs.engine_speed_radps, &engine_radps, Fault::kEngineSpeedMissing}}};
}

}  // namespace

ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     TimeUs now_us) {
  ValidInputs valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);

  const OperatorInputs& driver = inputs.driver;
  valid.enable = fresh.holds(driver.enable) && driver.enable.value;
  if (!fresh.holds(driver.enable) || !fresh.holds(driver.mode) || !fresh.holds(driver.task) ||
      !fresh.holds(driver.speed_override_ratio) ||
      !std::isfinite(driver.speed_override_ratio.value)) {
    valid.fault = Fault::kOperatorMissing;
    return valid;
  }
  const Freshness known(kIdentityTimeout_s, now_us);
  if (!known.holds(inputs.same_machine) || !inputs.same_machine.value) {
    valid.fault = Fault::kIdentityMismatch;
    return valid;
  }
  valid.automatic = driver.mode.value == OperatorMode::kAutomatic;
  valid.task = driver.task.value;
  valid.speed_override_ratio = std::clamp(driver.speed_override_ratio.value, 0.0, 1.0);

  std::array<double, kPumpCount> swash{};
  double engine_radps = 0.0;
  for (const Required& row : required_signals(inputs, valid, swash, engine_radps)) {
    if (!fresh.holds(*row.from) || !std::isfinite(row.from->value)) {
      valid.fault = row.missing;
      return valid;
    }
    *row.to = row.from->value;
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double stroke_max_m = profile.geometry.cylinder[i].stroke_m;
    if (valid.strokes_m[i] < -kStrokeMargin_m ||
        valid.strokes_m[i] > stroke_max_m + kStrokeMargin_m) {
      valid.fault = Fault::kStrokeImplausible;
      return valid;
    }
    valid.strokes_m[i] = std::clamp(valid.strokes_m[i], 0.0, stroke_max_m);
  }
  for (unsigned j = 0; j < kPumpCount; ++j) {
    valid.pump_flow_m3ps[j] =
        std::max(0.0, profile.pump[j].displacement_m3prev / kTwoPi * engine_radps * swash[j]);
  }
  return valid;
}

}  // namespace graben
