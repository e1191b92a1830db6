// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/drive_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/identify/machine/falling_flow.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/circuit.hpp"
#include "firmware/mcv/evaluation.hpp"

namespace graben::identify {
namespace {

/// With less on the fed side, oil comes from the tank as well: the load drives it.
constexpr double kFed_pa = 0.8e6;
constexpr int kHalvings = 40;
/// Of a line without a relief valve, Pa.
constexpr double kMost_pa = 60e6;

/// Of the swing's sensors a profile says none.
std::array<double, kDriveCount> with_swing_zero(const std::array<double, kAxisCount>& zero_pa) {
  std::array<double, kDriveCount> all{};
  std::copy(zero_pa.begin(), zero_pa.end(), all.begin());
  return all;
}

/// Root of a falling function in [low, high]; an end where there is none.
template <class Falling>
double root(double low, double high, const Falling& falling) {
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle = 0.5 * (low + high);
    (falling(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double force_n(const CircuitAxis& at_1_mps, double speed_mps, double sqrt_line) {
  CircuitAxis now = at_1_mps;
  now.q_out_m3ps = speed_mps * at_1_mps.q_out_m3ps;
  return drive_force(now, 1.0, sqrt_line).force_n -
         speed_mps * speed_mps * at_1_mps.inflow_check_force_n;
}

/// v = c sqrt(F(v)) at this pressure of the line, with no more than a compensator leaves of F.
double speed_at(const CircuitAxis& at_1_mps, double coefficient, double sqrt_line) {
  const double most_n = force_n(at_1_mps, 0.0, sqrt_line);
  if (most_n <= 0.0) {
    return 0.0;
  }
  const double most_mps = coefficient * std::sqrt(std::min(most_n, at_1_mps.most_force_n));
  if (!at_1_mps.regeneration && at_1_mps.inflow_check_force_n == 0.0) {
    return most_mps;
  }
  return root(0.0, most_mps, [&](double speed_mps) {
    const double left_n = force_n(at_1_mps, speed_mps, sqrt_line);
    return coefficient * std::sqrt(std::clamp(left_n, 0.0, at_1_mps.most_force_n)) - speed_mps;
  });
}

/// Adds what an axis takes and gives at this speed.
void take_flow(const CircuitAxis& at_1_mps, double speed_mps, FlowBalance& line) {
  const double in_m3ps = speed_mps * at_1_mps.q_in_m3ps;
  const double out_m3ps = speed_mps * at_1_mps.q_out_m3ps;
  line.in_flow_m3ps += in_m3ps;
  if (at_1_mps.regeneration && out_m3ps > 0.0) {
    line.in_flow_m3ps -= out_m3ps;
    line.regeneration[static_cast<std::size_t>(line.regeneration_count++)] = {
        out_m3ps, at_1_mps.c_drain, at_1_mps.c_check, out_m3ps / at_1_mps.c_drain};
  }
}

/// An axis that is open.
struct Open {
  int axis = 0;
  CircuitAxis at_1_mps;       ///< Flows are those of the speed.
  double coefficient = 0.0;   ///< c_L, m/(s sqrt(N)).
  double drained_mps = -1.0;  ///< By its draining edge, where nothing feeds it; else below 0.
};

double drained_mps(const DriveModel& model, const CircuitAxis& at_1_mps, const ValveMoment& moment,
                   int axis, double area_ratio) {
  const auto k = static_cast<std::size_t>(axis);
  const double fed_pa = at_1_mps.extends ? moment.cap_pa[k] : moment.rod_pa[k];
  const double drained_pa = at_1_mps.extends ? moment.rod_pa[k] : moment.cap_pa[k];
  if (fed_pa > kFed_pa || drained_pa <= fed_pa) {
    return -1.0;
  }
  const SpoolProfile& spool = model.drive[k].spool;
  double out = model.metering.discharge * std::sqrt(2.0 / model.metering.density_kgpm3) *
               area_ratio * (at_1_mps.extends ? spool.extend_out_m2 : spool.retract_out_m2);
  if (at_1_mps.regeneration) {
    out = out * at_1_mps.c_drain / std::hypot(out, at_1_mps.c_drain);
  }
  return out * std::sqrt(drained_pa) / at_1_mps.q_out_m3ps;
}

Open open_axis(const DriveModel& model, const McvCircuit& circuit, const ValveMoment& moment,
               int axis) {
  const auto k = static_cast<std::size_t>(axis);
  Open open;
  open.axis = axis;
  open.at_1_mps = circuit.axis[k];
  const double area_ratio = std::pow(std::abs(moment.opening[k]), model.metering.opening_exponent);
  open.coefficient = area_ratio * open.at_1_mps.spool->y_last();
  open.drained_mps = drained_mps(model, open.at_1_mps, moment, axis, area_ratio);
  return open;
}

/// Flow coefficient of a line's bypass at all its openings.
double bypass_of(const McvMachine& valve, const PumpProfile& pump, unsigned of,
                 const ValveMoment& moment) {
  double resistance =
      orifice_resistance(pump.bypass_series[0]) + orifice_resistance(pump.bypass_series[1]);
  for (std::size_t k = 0; k < static_cast<std::size_t>(valve.actuator_count); ++k) {
    const McvActuator& actuator = valve.actuator[k];
    if (static_cast<unsigned>(actuator.pump) == of) {
      const double closed = moment.bypass_closed[k];
      const double closes_at = actuator.bypass_closes_at.side(moment.opening[k] > 0.0);
      resistance += orifice_resistance(
          closed == kByOpening ? bypass_at(actuator, closes_at, std::abs(moment.opening[k]))
                               : bypass_at(actuator, 1.0, closed));
    }
  }
  return 1.0 / std::sqrt(resistance);
}

/// What holds the margin at the heaviest of those that are open, as fast as it then goes, but no
/// more than `most`: more a line has not that senses its load.
double held_sqrt_line(const std::vector<Open>& opens, double margin_pa, double most) {
  double held = std::sqrt(margin_pa);
  for (const Open& open : opens) {
    const CircuitAxis& axis = open.at_1_mps;
    const double metered_mps = open.coefficient * std::sqrt(axis.margin_force_n);
    held = std::max(held, root(0.0, most, [&](double tried) {
                      return axis.margin_force_n - force_n(axis, metered_mps, tried);
                    }));
  }
  return std::min(held, most);
}

}  // namespace

DriveModel::DriveModel(const ExcavatorProfile& profile)
    : drive(excavator_bank(profile).row),
      valve(mcv_machine({drive.data(), profile.drive_count},
                        {profile.pump.data(), profile.pump_count})),
      quick(are_quick({drive.data(), profile.drive_count})),
      metering(drive.front().metering),
      answer{profile.valve.spool_to_duty, profile.control.dead_time_s, profile.control.response_s,
             profile.oil.spool_time_constant_s},
      pump(profile.pump),
      cap_zero_pa(with_swing_zero(profile.sensor_zero.cap_pa)),
      rod_zero_pa(with_swing_zero(profile.sensor_zero.rod_pa)) {}

PerPump<double> DriveModel::flow_m3ps(double engine_radps,
                                      const std::array<double, kPumpCount>& swash) const {
  PerPump<double> each_m3ps{};
  for (std::size_t j = 0; j < static_cast<std::size_t>(valve.pump_count); ++j) {
    const bool sets_swash = pump[j].regulator.sets_swash();
    each_m3ps[j] = pump_flow_m3ps(pump[j], engine_radps, sets_swash ? 1.0 : swash[j]);
  }
  return each_m3ps;
}

std::array<double, kDriveCount> DriveModel::speeds_mps(const ValveMoment& moment) const {
  std::array<double, kDriveCount> speeds{};
  McvInput input;
  for (std::size_t k = 0; k < drives(); ++k) {
    input.velocity_mps[k] = moment.opening[k] == 0.0 ? 0.0 : std::copysign(1.0, moment.opening[k]);
    input.cap_pressure_pa[k] = std::max(0.0, moment.cap_pa[k]);
    input.rod_pressure_pa[k] = std::max(0.0, moment.rod_pa[k]);
  }
  input.pump_flow_m3ps = flow_m3ps(moment.engine_radps, moment.swash);
  const McvCircuit circuit = make_circuit(valve, input);
  for (unsigned j = 0; j < static_cast<unsigned>(valve.pump_count); ++j) {
    std::vector<Open> opens;
    for (int axis = 0; axis < valve.actuator_count; ++axis) {
      const CircuitAxis& of = circuit.axis[static_cast<std::size_t>(axis)];
      if (of.moves && of.pump == j) {
        opens.push_back(open_axis(*this, circuit, moment, axis));
      }
    }
    if (opens.empty()) {
      continue;
    }
    FlowBalance idle = circuit.line[j];
    idle.in_flow_m3ps = 0.0;
    idle.regeneration_count = 0;
    const bool falls = pump_kind() == PumpKind::kNegativeFlow;
    if (falls) {
      idle.bypass = bypass_of(valve, pump[j], j, moment);
    }
    const auto speed = [](const Open& open, double sqrt_line) {
      return open.drained_mps >= 0.0 ? open.drained_mps
                                     : speed_at(open.at_1_mps, open.coefficient, sqrt_line);
    };
    double most = idle.has_relief ? idle.sqrt_relief : std::sqrt(kMost_pa);
    if (pump_kind() == PumpKind::kLoadSensing) {
      most = held_sqrt_line(opens, pump[j].regulator.margin_pa, most);
    }
    const double sqrt_line = root(0.0, most, [&](double tried) {
      FlowBalance line = idle;
      for (const Open& open : opens) {
        take_flow(open.at_1_mps, speed(open, tried), line);
      }
      return falls ? falling_flow_left(line, tried) : flow_left(line, 1.0, tried);
    });
    for (const Open& open : opens) {
      const double along_mps = speed(open, sqrt_line);
      speeds[static_cast<std::size_t>(open.axis)] = open.at_1_mps.extends ? along_mps : -along_mps;
    }
  }
  return speeds;
}

}  // namespace graben::identify
