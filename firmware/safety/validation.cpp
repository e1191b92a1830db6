#include "firmware/safety/validation.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/safety/fault_table.hpp"

namespace graben {
namespace {

constexpr double kTwoPi = 6.28318530717958647693;
constexpr double kMicrosecondsPerSecond = 1e6;
/// A cylinder whose own oil feeds its other side, or whose load drives it, is faster than the pumps
/// alone make it; twice is more than any of them does.
constexpr double kFasterThanPumps = 2.0;
/// Over its rated speed an engine runs by a few per cent, downhill by some more.
constexpr double kMostOverspeed = 1.2;

/// A required number: where it comes from, where it goes, what its absence means, and what it
/// means that its sender calls it wrong.
struct Required {
  const Signal<double>* from;
  double* to;
  Fault missing;
  Fault wrong;
};

class Freshness {
 public:
  Freshness(double timeout_s, TimeUs now_us)
      : timeout_us_(static_cast<TimeUs>(timeout_s * kMicrosecondsPerSecond)), now_us_(now_us) {}

  [[nodiscard]] bool in_time(TimeUs stamp_us) const {
    // A stamp from the future is as useless as an old one. No difference with a stamp: any number
    // can stand there.
    return stamp_us <= now_us_ && stamp_us >= now_us_ - timeout_us_;
  }
  template <class T>
  [[nodiscard]] bool holds(const Signal<T>& signal) const {
    return signal.validity == Validity::kValid && in_time(signal.stamp_us);
  }
  [[nodiscard]] bool number(const Signal<double>& signal) const {
    return holds(signal) && std::isfinite(signal.value);
  }

 private:
  TimeUs timeout_us_;
  TimeUs now_us_;
};

constexpr std::size_t kRequiredCount = 4 * kAxisCount + kPumpCount + 1;

std::array<Required, kRequiredCount> required_signals(const ExcavatorInputs& inputs,
                                                      ValidInputs& valid) {
  const auto stroke = [&](unsigned i) {
    return Required{&valid.state.stroke_m[i], &valid.strokes_m[i], Fault::kStrokeMissing,
                    Fault::kNone};
  };
  const auto cap = [&](unsigned i) {
    return Required{&inputs.axis[i].cap_pressure_pa, &valid.cap_pressure_pa[i],
                    Fault::kPressureMissing, Fault::kPressureImplausible};
  };
  const auto rod = [&](unsigned i) {
    return Required{&inputs.axis[i].rod_pressure_pa, &valid.rod_pressure_pa[i],
                    Fault::kPressureMissing, Fault::kPressureImplausible};
  };
  const auto spool = [&](unsigned i) {
    return Required{&inputs.axis[i].spool_ratio, &valid.spool_ratio[i], Fault::kSpoolMissing,
                    Fault::kSensorError};
  };
  const auto swash = [&](unsigned j) {
    return Required{&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing,
                    Fault::kSensorError};
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
           spool(0),
           spool(1),
           spool(2),
           swash(0),
           swash(1),
           {&inputs.engine_speed_radps, &valid.engine_radps, Fault::kEngineSpeedMissing,
            Fault::kEngineSpeedMissing}}};
}

/// Faster than this no cylinder moves, m/s.
double fastest_mps(const ExcavatorProfile& profile, unsigned axis) {
  const auto pump = static_cast<unsigned>(profile.valve.spool[axis].pump);
  const double flow_m3ps =
      profile.pump[pump].displacement_m3prev / kTwoPi * profile.pump[pump].rated_speed_radps;
  return kFasterThanPumps * flow_m3ps / profile.geometry.cylinder[axis].rod_area_m2();
}

/// Frames that were lost give the cylinder time to move, frames that were refused do not: else a
/// jump that stays would be allowed as soon as it is old enough.
bool jumped(const ExcavatorProfile& profile, unsigned axis, const Signal<double>& last,
            TimeUs seen_us, const Signal<double>& next) {
  const TimeUs from_us = std::max(last.stamp_us, seen_us);
  const double elapsed_s = static_cast<double>(next.stamp_us - from_us) / kMicrosecondsPerSecond;
  return std::abs(next.value - last.value) > fastest_mps(profile, axis) * elapsed_s + kJumpMargin_m;
}

/// The strokes to believe: the new ones, but for those that jumped. Against the last one that was
/// believed however old it has become: it has to run out of time, not to give way to the jump.
void believe_strokes(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     const ValidationState& last, const Freshness& fresh, ValidInputs& valid) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const Signal<double>& next = inputs.axis[i].stroke_m;
    const Signal<double>& believed = last.stroke_m[i];
    const bool usable = fresh.number(next);
    if (usable && believed.validity == Validity::kValid &&
        jumped(profile, i, believed, last.seen_us[i], next)) {
      valid.faults.add(Fault::kStrokeJump);
      valid.state.stroke_m[i] = believed;
    } else if (usable) {
      valid.state.stroke_m[i] = next;
    }
    valid.state.seen_us[i] = next.stamp_us;
    if (next.validity == Validity::kError) {
      valid.faults.add(Fault::kSensorError);
    }
  }
}

void read_driver(const OperatorInputs& driver, const Freshness& fresh, ValidInputs& valid) {
  valid.enable = fresh.holds(driver.enable) && driver.enable.value;
  if (!fresh.holds(driver.enable) || !fresh.holds(driver.mode) || !fresh.holds(driver.task) ||
      !fresh.number(driver.speed_override_ratio)) {
    valid.faults.add(Fault::kOperatorMissing);
    return;
  }
  valid.automatic = driver.mode.value == OperatorMode::kAutomatic;
  valid.task = driver.task.value;
  valid.speed_override_ratio = std::clamp(driver.speed_override_ratio.value, 0.0, 1.0);
}

void read_bus(const LinkInputs& link, ValidInputs& valid) {
  valid.faults.add(link.message_faults);
  if (link.bus != BusState::kActive) {
    valid.faults.add(link.bus == BusState::kOff       ? Fault::kBusOff
                     : link.bus == BusState::kPassive ? Fault::kBusPassive
                                                      : Fault::kBusDown);
  }
  if (link.dropped_cycles >= 2) {
    valid.faults.add(Fault::kTransmitFailed);
  }
  if (link.out_of_range) {
    valid.faults.add(Fault::kValueOutOfRange);
  }
}

void bound_strokes(const ExcavatorProfile& profile, ValidInputs& valid) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double stroke_max_m = profile.geometry.cylinder[i].stroke_m;
    if (valid.strokes_m[i] < -kStrokeMargin_m ||
        valid.strokes_m[i] > stroke_max_m + kStrokeMargin_m) {
      valid.faults.add(Fault::kStrokeImplausible);
    }
    valid.strokes_m[i] = std::clamp(valid.strokes_m[i], 0.0, stroke_max_m);
  }
}

/// What of the faults stops and what only slows.
void judge(bool moving, ValidInputs& valid) {
  // A jump whose stroke is still in time is not there yet; kStrokeMissing comes with its end.
  const bool jump_bridged =
      valid.faults.has(Fault::kStrokeJump) && !valid.faults.has(Fault::kStrokeMissing);
  for (Fault fault = valid.faults.first(); fault != Fault::kNone;
       fault = valid.faults.after(fault)) {
    const bool slows = fault_row(fault).reaction == Reaction::kDegrade ||
                       (fault == Fault::kStrokeJump && jump_bridged);
    if (moving && slows) {
      valid.degraded.add(fault);
    } else if (valid.fault == Fault::kNone) {
      valid.fault = fault;
    }
  }
}

}  // namespace

ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     const ValidationState& last, bool moving, TimeUs now_us) {
  ValidInputs valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_driver(inputs.driver, fresh, valid);
  const Freshness known(kIdentityTimeout_s, now_us);
  if (!known.holds(inputs.same_machine) || !inputs.same_machine.value) {
    valid.faults.add(Fault::kIdentityMismatch);
  }
  read_bus(inputs.link, valid);
  believe_strokes(inputs, profile, moving ? last : ValidationState{}, fresh, valid);
  for (const Required& row : required_signals(inputs, valid)) {
    if (fresh.number(*row.from)) {
      *row.to = row.from->value;
    } else {
      valid.faults.add(row.missing);
    }
    if (row.from->validity == Validity::kError) {
      valid.faults.add(row.wrong);
    }
  }
  // Its frame is the one without protection, and a flow that is not there would lift lambda.
  if (!(fresh.number(inputs.engine_speed_radps) &&
        valid.engine_radps <= kMostOverspeed * profile.pump[0].rated_speed_radps)) {
    valid.faults.add(Fault::kEngineSpeedMissing);
    valid.engine_radps = profile.safety.idle_radps;
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    valid.load_known[i] = fresh.number(inputs.axis[i].cap_pressure_pa) &&
                          fresh.number(inputs.axis[i].rod_pressure_pa);
  }
  if (fresh.holds(inputs.valve_enabled)) {
    valid.valve_enabled = inputs.valve_enabled.value;
  } else {
    valid.faults.add(Fault::kSpoolMissing);
  }
  bound_strokes(profile, valid);
  judge(moving, valid);
  return valid;
}

std::array<double, kPumpCount> pump_flow_m3ps(const ExcavatorProfile& profile, double engine_radps,
                                              const std::array<double, kPumpCount>& swash_ratio) {
  std::array<double, kPumpCount> flow_m3ps{};
  for (unsigned j = 0; j < kPumpCount; ++j) {
    flow_m3ps[j] = std::max(0.0, profile.pump[j].displacement_m3prev / kTwoPi * engine_radps *
                                     std::min(swash_ratio[j], 1.0));
  }
  return flow_m3ps;
}

}  // namespace graben
