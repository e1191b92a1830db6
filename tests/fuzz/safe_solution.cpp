// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/plain_circuit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace graben::test {
namespace {

template <class Values>
bool all_finite(const Values& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

bool finite(const McvSolution& solution) {
  const McvPoint& point = solution.point;
  return std::isfinite(point.lambda) && std::isfinite(solution.shortfall) &&
         std::isfinite(solution.standstill.short_n) && all_finite(point.pump_pressure_pa) &&
         all_finite(point.sqrt_pressure) && all_finite(point.feed_margin_m3ps) &&
         all_finite(point.out_pressure_pa) && all_finite(point.drive_force_n) &&
         all_finite(point.spool_m) && all_finite(point.yield_mpsn) &&
         all_finite(solution.margins.flow_m3ps) && all_finite(solution.margins.force_n) &&
         all_finite(solution.margins.travel_m);
}

bool closed(const McvSolution& solution) {
  return solution.point.lambda == 0.0 &&
         std::all_of(solution.point.spool_m.begin(), solution.point.spool_m.end(),
                     [](double spool) { return spool == 0.0; });
}

bool at_least_0(double value) { return value >= 0.0 && std::isfinite(value); }
bool over_0(double value) { return value > 0.0 && std::isfinite(value); }

/// A flow coefficient: c^2 and 1/c^2 are in every formula.
bool coefficient(double c) { return over_0(c) && over_0(c * c) && over_0(1.0 / (c * c)); }

bool share(double value) { return at_least_0(value) && value < 1.0; }

/// Both sides close their bypass at once, or both at an opening that there is.
bool closing(const BypassClosing& at) {
  const auto opening = [](double value) { return over_0(value) && value <= 1.0; };
  return (at.extend == 0.0 && at.retract == 0.0) || (opening(at.extend) && opening(at.retract));
}

/// A pump without a relief valve sets no swash of its own.
bool regulator(const McvPump& pump) {
  const PumpRegulator& by = pump.regulator;
  if (by.kind == PumpKind::kLoadSensing) {
    return pump.has_relief && over_0(by.margin_pa);
  }
  if (by.kind == PumpKind::kNegativeFlow) {
    return pump.has_relief && at_least_0(by.full_swash_pa) && std::isfinite(by.least_swash_pa) &&
           by.least_swash_pa > by.full_swash_pa && share(by.least_swash_ratio) &&
           coefficient(pump.tank_orifice);
  }
  return by.kind == PumpKind::kPositive;
}

/// What a caller may ask for, in words of its own: not the core's check once more.
bool sound(const McvMachine& machine, const McvInput& input, const LambdaRange& range) {
  if (machine.actuator_count < 1 || machine.actuator_count > kMaxActuators ||
      machine.pump_count < 1 || machine.pump_count > kMaxPumps) {
    return false;
  }
  bool good = over_0(range.most) && range.most <= 1.0 && at_least_0(range.reserve_n) &&
              at_least_0(range.hold) && range.hold <= 1.0 && at_least_0(range.hold_share) &&
              range.hold_share <= 1.0;
  for (unsigned j = 0; j < static_cast<unsigned>(machine.pump_count); ++j) {
    const McvPump& pump = machine.pump[j];
    good = good && at_least_0(input.pump_flow_m3ps[j]) && at_least_0(pump.leak_linear) &&
           at_least_0(pump.leak_quadratic) && at_least_0(pump.series_resistance) &&
           (!pump.has_relief || over_0(pump.relief_pa)) && regulator(pump);
  }
  for (unsigned i = 0; i < static_cast<unsigned>(machine.actuator_count); ++i) {
    const McvActuator& a = machine.actuator[i];
    good = good && a.pump >= 0 && a.pump < machine.pump_count && over_0(a.area_cap_m2) &&
           over_0(a.area_rod_m2) && coefficient(a.bypass_open) && coefficient(a.bypass_closed) &&
           at_least_0(a.force_offset_n) && a.extend.size() >= 2 && a.retract.size() >= 2 &&
           std::isfinite(input.velocity_mps[i]) && at_least_0(input.cap_pressure_pa[i]) &&
           at_least_0(input.rod_pressure_pa[i]);
    good = good && closing(a.bypass_closes_at) && share(a.extend_outlet_share) &&
           share(a.retract_outlet_share);
    good = good && (a.c_inflow_check == 0.0 || coefficient(a.c_inflow_check));
    good = good && (a.regeneration == RegenerationSide::kNone ||
                    (coefficient(a.c_drain) && coefficient(a.c_check) && a.c_drain < a.c_check));
    good = good && a.extend.x(0) == 0.0 && a.extend.y(0) == 0.0 && a.retract.x(0) == 0.0 &&
           a.retract.y(0) == 0.0;
  }
  return good;
}

/// Whether a spool is closed at rest, and otherwise open the way it should and no farther.
bool spool_is_sound(const McvActuator& actuator, double velocity, double spool) {
  if (velocity == 0.0) {
    return spool == 0.0;
  }
  const MonotoneTable& table = velocity > 0.0 ? actuator.extend : actuator.retract;
  return std::abs(spool) <= table.x_last() && spool * (velocity > 0.0 ? 1.0 : -1.0) >= 0.0;
}

bool limit_is_sound(const McvMachine& machine, const Limit& limit) {
  switch (limit.kind) {
    case LimitKind::kNone:
      return true;
    case LimitKind::kPumpFlow:
      return limit.index < machine.pump_count;
    case LimitKind::kBackFlow:
    case LimitKind::kSpoolTravel:
      return limit.index < machine.actuator_count;
    default:  // None of the solution's.
      return false;
  }
}

std::string unsound_point(const McvMachine& machine, const McvInput& input,
                          const McvSolution& solution) {
  for (unsigned i = 0; i < static_cast<unsigned>(machine.actuator_count); ++i) {
    if (!spool_is_sound(machine.actuator[i], input.velocity_mps[i], solution.point.spool_m[i])) {
      return fmt::format("spool {} at {}", i, solution.point.spool_m[i]);
    }
    if (solution.margins.force_n[i] < 0.0 || solution.margins.travel_m[i] < 0.0) {
      return fmt::format("margins of actuator {} below 0", i);
    }
  }
  for (const double margin : solution.margins.flow_m3ps) {
    if (margin < 0.0) {
      return "margin of a pump below 0";
    }
  }
  return "";
}

}  // namespace

std::string unsafe(const McvMachine& machine, const McvInput& input, const LambdaRange& range,
                   const McvSolution& solution) {
  if (!finite(solution)) {
    return "a number that is not finite";
  }
  if (solution.status != SolveStatus::kOk && !closed(solution)) {
    return fmt::format("status {} with lambda {}", static_cast<int>(solution.status),
                       solution.point.lambda);
  }
  const bool good = sound(machine, input, range);
  const bool refused = solution.status == SolveStatus::kBadInput;
  if (good == refused || refused != (solution.defect.defect != McvDefect::kNone)) {
    return fmt::format("status {} and defect {} for {} input", static_cast<int>(solution.status),
                       static_cast<int>(solution.defect.defect), good ? "good" : "bad");
  }
  if (solution.status != SolveStatus::kOk) {
    return "";
  }
  if (!(solution.point.lambda >= 0.0 && solution.point.lambda <= range.most)) {
    return fmt::format("lambda {} of at most {}", solution.point.lambda, range.most);
  }
  if (!limit_is_sound(machine, solution.limit)) {
    return fmt::format("limit {}[{}]", static_cast<int>(solution.limit.kind), solution.limit.index);
  }
  return solution.point.lambda > 0.0 ? unsound_point(machine, input, solution) : "";
}

}  // namespace graben::test
