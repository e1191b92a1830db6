// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/identified_profile.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/drive_model.hpp"
#include "app/machines/tuned_control.hpp"

namespace graben::identify {
namespace {

/// Of what resists, that either edge has at least.
constexpr double kLeastShare = 0.1;
/// See kLagShare of drive_bank.hpp: two equal lags, and what they are off.
constexpr double kSettlePerLag = 1.75;
/// A profile has none below that.
constexpr double kLeastClosing = 0.01;
/// Two points of a table are at least so far apart.
constexpr double kApart = 1e-4;
/// Pace at which valves that were measured are learnt: what seems to be theirs at work is mostly
/// the pumps' and the oil's. Of 12 hidden 22 t the worst tip is 37.7 mm off; at the usual
/// pace 56.4, at none 39.5.
constexpr double kLearnShare = 0.1;

double cube(double value) { return value * value * value; }

/// A table with rising duties that ends within the full travel.
DutyTable table_of(const std::vector<double>& duty) {
  std::array<double, kTableOpenings.size()> opening = kTableOpenings;
  opening.front() = 0.0;
  std::array<double, kTableOpenings.size()> rising{};
  double least = 0.0;
  for (std::size_t at = 0; at < rising.size(); ++at) {
    const double most = 1.0 - kApart * static_cast<double>(rising.size() - 1 - at);
    rising[at] = std::clamp(duty[at], least, most);
    least = rising[at] + kApart;
  }
  DutyTable table;
  static_cast<void>(
      table.fill(opening.data(), rising.data(), static_cast<int>(kTableOpenings.size())));
  return table;
}

/// Curve and areas are of one fit: one without the other would be another machine.
bool has_curve(const SideEstimate& side) { return side.edge.known && !side.duty.empty(); }

void set_side(const DriveEstimate& drive, bool extends, double pump_s, SaidAnswer& answer) {
  const SideEstimate& side = drive.side(extends);
  if (has_curve(side)) {
    answer.spool_to_duty = table_of(side.duty);
  }
  if (side.dead_time_s.known) {
    answer.dead_time_s = side.dead_time_s.value;
  }
  if (drive.spool_time_constant_s.known) {
    answer.lag_s = drive.lag_s() + kOilLag_s + pump_s;
    answer.spool_time_constant_s = 0.5 * drive.lag_s();
  }
}

/// Full areas of one side's metering edges, m^2.
struct SideAreas {
  double in_m2 = 0.0;
  double out_m2 = 0.0;
};

/// Those of a side whose velocity coefficient and draining area were found: the in-flow edge's is
/// what (9), (11) leave for it.
SideAreas areas_of(const ExcavatorProfile& profile, int axis, bool extends,
                   const SideEstimate& side) {
  const auto k = static_cast<unsigned>(axis);
  const SpoolProfile& spool = profile.valve.spool[k];
  const bool turns = axis == kSwing;
  const double cap_m2 =
      turns ? profile.swing.area_m2() : profile.geometry.cylinder[k].cap_area_m2();
  const double rod_m2 =
      turns ? profile.swing.area_m2() : profile.geometry.cylinder[k].rod_area_m2();
  const double fed3 = cube(extends ? cap_m2 : rod_m2);
  const double drained3 = cube(extends ? rod_m2 : cap_m2);
  const double in_m2 = extends ? spool.extend_in_m2 : spool.retract_in_m2;
  const double out_m2 = extends ? spool.extend_out_m2 : spool.retract_out_m2;
  const double factor = side.coefficient_factor.value;
  const double resistance =
      (fed3 / (in_m2 * in_m2) + drained3 / (out_m2 * out_m2)) / (factor * factor);
  const double wanted_out_m2 = side.out_area_factor.value * out_m2;
  const double drains = std::clamp(drained3 / (wanted_out_m2 * wanted_out_m2),
                                   kLeastShare * resistance, (1.0 - kLeastShare) * resistance);
  return {std::sqrt(fed3 / (resistance - drains)), std::sqrt(drained3 / drains)};
}

void set_areas(int axis, const DriveEstimate& drive, ExcavatorProfile& profile) {
  SpoolProfile& spool = profile.valve.spool[static_cast<unsigned>(axis)];
  for (const bool extends : {true, false}) {
    const SideEstimate& side = drive.side(extends);
    if (!has_curve(side)) {
      continue;
    }
    const SideAreas areas = areas_of(profile, axis, extends, side);
    (extends ? spool.extend_in_m2 : spool.retract_in_m2) = areas.in_m2;
    (extends ? spool.extend_out_m2 : spool.retract_out_m2) = areas.out_m2;
  }
}

/// Each side by its own curve: the bypass closes over the travel, and how much of the edges is open
/// by then is another share on each. Where the curve of a side is known it goes with it, as its
/// areas do: the fit had this bypass.
void set_closing(const MachineEstimate& machine, std::size_t drive, ValveProfile& valve) {
  BypassClosing& closes_at = valve.spool[drive].bypass_closes_at;
  for (const bool extends : {true, false}) {
    const SideEstimate& side = machine.drive[drive].side(extends);
    double& opening = extends ? closes_at.extend : closes_at.retract;
    if (has_curve(side) && side.bypass_closed_at > 0.0) {
      opening = std::clamp(table_of(side.duty).inverse(side.bypass_closed_at), kLeastClosing, 1.0);
    } else if (machine.bypass_closes_at.known) {
      opening = std::min(1.0, machine.bypass_closes_at.value);
    }
  }
}

void set_regulator(const RegulatorEstimate& found, PumpRegulator& regulator) {
  if (found.margin_pa.known) {
    regulator.margin_pa = found.margin_pa.value;
  }
  if (found.response_s.known) {
    regulator.response_s = found.response_s.value;
  }
  // Both, well known or not, are the fit's own: its curves hold with them.
  if (found.full_swash_pa.value > 0.0 && found.least_swash_pa.value > 0.0) {
    regulator.full_swash_pa = found.full_swash_pa.value;
    regulator.least_swash_pa = found.least_swash_pa.value;
  }
  if (found.least_swash_ratio.known) {
    regulator.least_swash_ratio = found.least_swash_ratio.value;
  }
}

/// What the profile's lag has beyond its spool's and its oil's is its pump's, where that sets its
/// own swash: no log of spools tells it.
double pump_lag_s(const ExcavatorProfile& profile) {
  const double of_spool_s = 2.0 * profile.oil.spool_time_constant_s + kOilLag_s;
  return profile.pump[0].regulator.sets_swash()
             ? std::max(0.0, profile.control.response_s - of_spool_s)
             : 0.0;
}

/// Cylinders' valves that were all measured. With negative flow a bypass closes over the opening by
/// one key for all sides: what that leaves has to be learnt.
bool has_known_valves(const ExcavatorProfile& profile, const MachineEstimate& machine) {
  return profile.pump[0].regulator.kind != PumpKind::kNegativeFlow &&
         std::all_of(machine.drive.begin(), machine.drive.begin() + kAxisCount,
                     [](const DriveEstimate& drive) {
                       return has_curve(drive.extend) && has_curve(drive.retract);
                     });
}

}  // namespace

ExcavatorProfile identified(const ExcavatorProfile& profile, const MachineEstimate& machine) {
  ExcavatorProfile result = profile;
  double longest_lag_s = 0.0;
  const double pump_s = pump_lag_s(profile);
  for (int axis = 0; axis < result.drive_count; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const DriveEstimate& drive = machine.drive[k];
    set_side(drive, true, pump_s, result.valve.answer[k].extend);
    set_side(drive, false, pump_s, result.valve.answer[k].retract);
    set_areas(axis, drive, result);
    set_closing(machine, k, result.valve);
    if (axis == kSwing) {
      continue;
    }
    longest_lag_s = std::max(longest_lag_s, drive.lag_s());
    if (drive.stroke_zero_m.known) {
      result.sensor_zero.stroke_m[k] = drive.stroke_zero_m.value;
    }
    if (drive.cap_zero_pa.known) {
      result.sensor_zero.cap_pa[k] = drive.cap_zero_pa.value;
    }
    if (drive.rod_zero_pa.known) {
      result.sensor_zero.rod_pa[k] = drive.rod_zero_pa.value;
    }
  }
  if (machine.swing.inertia_kgm2.known) {
    result.swing.inertia_kgm2 = machine.swing.inertia_kgm2.value;
  }
  for (unsigned j = 0; j < static_cast<unsigned>(result.pump_count); ++j) {
    if (machine.pump_flow_factor[j].known) {
      result.pump[j].displacement_m3prev *= machine.pump_flow_factor[j].value;
    }
    set_regulator(machine.regulator[j], result.pump[j].regulator);
  }
  // The mode that the profile's own low-pass is made for.
  const machines::TunedControl tuned = machines::tuned_control(
      machines::latest_answer_s(result), profile.control.servo_frequency_hz / machines::kBelowMode,
      profile.dig_speed_mps);
  if (!DriveModel(result).quick) {
    result.control.law = ControlLaw::kServo;
  }
  result.control.convergence_length_m = tuned.convergence_length_m;
  result.control.servo_gain_ps = tuned.servo_gain_ps;
  result.control.servo_damping = tuned.servo_damping;
  result.control.pressure_filter_s = tuned.pressure_filter_s;
  if (has_known_valves(profile, machine)) {
    result.control.learn_share = std::min(result.control.learn_share, kLearnShare);
  }
  result.safety.settle_s = std::max(result.safety.settle_s, kSettlePerLag * longest_lag_s);
  return result;
}

}  // namespace graben::identify
