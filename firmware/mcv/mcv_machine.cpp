// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/mcv_machine.hpp"

#include <array>
#include <cmath>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/numeric/power.hpp"

namespace graben {

double full_opening_velocity_coefficient(const SpoolMetering& metering, double spool_in_m2,
                                         double spool_out_m2, double inlet_area_m2,
                                         double outlet_area_m2) {
  const auto cube_over_square = [](double piston, double opening) {
    return piston * piston * piston / (opening * opening);
  };
  const double resistance =
      cube_over_square(inlet_area_m2, spool_in_m2) + cube_over_square(outlet_area_m2, spool_out_m2);
  return std::sqrt(2.0 / metering.density_kgpm3) * metering.discharge / std::sqrt(resistance);
}

MonotoneTable velocity_coefficient_table(const SpoolMetering& metering, double coefficient_full) {
  /// Points of the table. [-; size: all that it has room for]
  constexpr int kPoints = MonotoneTable::capacity();
  std::array<double, kPoints> travel{};
  std::array<double, kPoints> coefficient{};
  for (int i = 0; i < kPoints; ++i) {
    const auto k = static_cast<unsigned>(i);
    const double share = static_cast<double>(i) / (kPoints - 1);
    const double opening = share * share;
    travel[k] = metering.spool_travel_m * opening;
    coefficient[k] = coefficient_full * power(opening, metering.opening_exponent);
  }
  MonotoneTable table;
  // A profile that passed its check fills it; another leaves it empty, which the machine's check
  // finds.
  static_cast<void>(table.fill(travel.data(), coefficient.data(), kPoints));
  return table;
}

namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

bool is_share(double value) { return not_negative(value) && value < 1.0; }

/// Over the opening on both sides, or at once on both.
bool is_closing(const BypassClosing& at) {
  return not_negative(at.extend) && not_negative(at.retract) && at.extend <= 1.0 &&
         at.retract <= 1.0 && (at.extend > 0.0) == (at.retract > 0.0);
}

/// A flow coefficient whose resistance 1/c^2 and square are numbers too.
bool usable(double coefficient) {
  return positive(coefficient) && positive(coefficient * coefficient) &&
         positive(1.0 / (coefficient * coefficient));
}

bool from_origin(const MonotoneTable& table) {
  return table.size() >= 2 && table.x_first() == 0.0 && table.y_first() == 0.0;
}

McvDefect check_actuator(const McvActuator& actuator, int pump_count) {
  if (actuator.pump < 0 || actuator.pump >= pump_count) {
    return McvDefect::kPumpIndex;
  }
  if (!positive(actuator.area_cap_m2) || !positive(actuator.area_rod_m2)) {
    return McvDefect::kArea;
  }
  if (actuator.regeneration != RegenerationSide::kNone &&
      !(usable(actuator.c_drain) && usable(actuator.c_check) &&
        actuator.c_drain < actuator.c_check)) {
    return McvDefect::kRegeneration;
  }
  if (!usable(actuator.bypass_open) || !usable(actuator.bypass_closed) ||
      !is_closing(actuator.bypass_closes_at)) {
    return McvDefect::kBypass;
  }
  if (!is_share(actuator.extend_outlet_share) || !is_share(actuator.retract_outlet_share)) {
    return McvDefect::kOutlet;
  }
  if (!not_negative(actuator.force_offset_n)) {
    return McvDefect::kForceOffset;
  }
  if (actuator.c_inflow_check != 0.0 && !usable(actuator.c_inflow_check)) {
    return McvDefect::kInflowCheck;
  }
  if (!from_origin(actuator.extend)) {
    return McvDefect::kExtendTable;
  }
  return from_origin(actuator.retract) ? McvDefect::kNone : McvDefect::kRetractTable;
}

bool has_sound_regulator(const McvPump& pump) {
  const PumpRegulator& by = pump.regulator;
  switch (by.kind) {
    case PumpKind::kPositive:
      return true;
    case PumpKind::kLoadSensing:
      return positive(by.margin_pa) && pump.has_relief;
    case PumpKind::kNegativeFlow:
      return not_negative(by.full_swash_pa) && positive(by.least_swash_pa - by.full_swash_pa) &&
             not_negative(by.least_swash_ratio) && by.least_swash_ratio < 1.0 && pump.has_relief &&
             usable(pump.tank_orifice);
  }
  return false;
}

McvDefect check_pump(const McvPump& pump) {
  if (!not_negative(pump.leak_linear) || !not_negative(pump.leak_quadratic)) {
    return McvDefect::kLeak;
  }
  if (!not_negative(pump.series_resistance)) {
    return McvDefect::kBypassSeries;
  }
  if (pump.has_relief && !positive(pump.relief_pa)) {
    return McvDefect::kRelief;
  }
  return has_sound_regulator(pump) ? McvDefect::kNone : McvDefect::kRegulator;
}

}  // namespace

McvCheck check_machine(const McvMachine& machine) {
  if (machine.actuator_count < 1 || machine.actuator_count > kMaxActuators) {
    return {McvDefect::kBadActuatorCount, 0};
  }
  if (machine.pump_count < 1 || machine.pump_count > kMaxPumps) {
    return {McvDefect::kBadPumpCount, 0};
  }
  for (int i = 0; i < machine.actuator_count; ++i) {
    const McvDefect defect =
        check_actuator(machine.actuator[static_cast<unsigned>(i)], machine.pump_count);
    if (defect != McvDefect::kNone) {
      return {defect, i};
    }
  }
  for (int j = 0; j < machine.pump_count; ++j) {
    const McvDefect defect = check_pump(machine.pump[static_cast<unsigned>(j)]);
    if (defect != McvDefect::kNone) {
      return {defect, j};
    }
  }
  return {};
}

McvCheck check_input(const McvMachine& machine, const McvInput& input) {
  for (int i = 0; i < machine.actuator_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    if (!std::isfinite(input.velocity_mps[k])) {
      return {McvDefect::kVelocity, i};
    }
    if (!not_negative(input.cap_pressure_pa[k]) || !not_negative(input.rod_pressure_pa[k])) {
      return {McvDefect::kPressure, i};
    }
  }
  for (int j = 0; j < machine.pump_count; ++j) {
    if (!not_negative(input.pump_flow_m3ps[static_cast<unsigned>(j)])) {
      return {McvDefect::kPumpFlow, j};
    }
  }
  return {};
}

namespace {

/// Of V = c_L sqrt(F): both edges open alike, so each has its share of F at every opening.
double outlet_share(double spool_in_m2, double spool_out_m2, double inlet_area_m2,
                    double outlet_area_m2) {
  const double in = inlet_area_m2 * inlet_area_m2 * inlet_area_m2 / (spool_in_m2 * spool_in_m2);
  const double out =
      outlet_area_m2 * outlet_area_m2 * outlet_area_m2 / (spool_out_m2 * spool_out_m2);
  return out / (in + out);
}

McvActuator actuator_of(const DriveRow& drive) {
  const SpoolProfile& spool = drive.spool;
  const double cap_m2 = drive.extend_area_m2;
  const double rod_m2 = drive.retract_area_m2;
  McvActuator actuator;
  actuator.area_cap_m2 = cap_m2;
  actuator.area_rod_m2 = rod_m2;
  actuator.pump = spool.pump;
  actuator.regeneration = spool.regeneration;
  actuator.c_drain = spool.c_drain;
  actuator.c_check = spool.c_check;
  actuator.bypass_open = spool.bypass_open;
  actuator.bypass_closed = spool.bypass_closed;
  actuator.force_offset_n = spool.force_offset_n;
  actuator.c_inflow_check = spool.c_inflow_check;
  actuator.bypass_closes_at = spool.bypass_closes_at;
  actuator.extend_outlet_share =
      outlet_share(spool.extend_in_m2, spool.extend_out_m2, cap_m2, rod_m2);
  actuator.retract_outlet_share =
      outlet_share(spool.retract_in_m2, spool.retract_out_m2, rod_m2, cap_m2);
  actuator.extend = velocity_coefficient_table(
      drive.metering, full_opening_velocity_coefficient(drive.metering, spool.extend_in_m2,
                                                        spool.extend_out_m2, cap_m2, rod_m2));
  actuator.retract = velocity_coefficient_table(
      drive.metering, full_opening_velocity_coefficient(drive.metering, spool.retract_in_m2,
                                                        spool.retract_out_m2, rod_m2, cap_m2));
  return actuator;
}

McvPump pump_of(const PumpProfile& from) {
  McvPump pump = {from.leak_linear, from.leak_quadratic,  0.0, true, from.relief_pa,
                  from.regulator,   from.bypass_series[1]};
  for (const double coefficient : from.bypass_series) {
    pump.series_resistance += orifice_resistance(coefficient);
  }
  return pump;
}

}  // namespace

McvMachine mcv_machine(DriveRows drives, Span<const PumpProfile> pumps) {
  McvMachine machine;
  machine.actuator_count = drives.count();
  machine.pump_count = pumps.count();
  for (int i = 0; i < drives.count(); ++i) {
    machine.actuator[static_cast<unsigned>(i)] = actuator_of(drives[i]);
  }
  for (int j = 0; j < pumps.count(); ++j) {
    machine.pump[static_cast<unsigned>(j)] = pump_of(pumps[j]);
  }
  return machine;
}

}  // namespace graben
