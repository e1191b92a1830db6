// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A main control valve as data: which spool hangs on which pump, which side regenerates (Kim
/// Fig. 3; Remarks 2, 3). Kim's machine is one value of this.

#include <array>
#include <cstdint>

#include "firmware/machine/drive_bank.hpp"
#include "firmware/machine/valve.hpp"
#include "firmware/numeric/monotone_table.hpp"

namespace graben {

/// Actuators that a valve may have. [-; derived: one for each drive of a machine, kMostDrives]
inline constexpr int kMaxActuators = kMostDrives;
/// Pumps that a valve may have. [-; size: one more than Kim's machine]
inline constexpr int kMaxPumps = 3;
/// Fixed orifices in a bypass line that files of valves may list. [-; size: room in a list; their
/// resistances are summed]
inline constexpr int kMaxBypassSeries = 8;

template <class T>
using PerActuator = std::array<T, kMaxActuators>;
template <class T>
using PerPump = std::array<T, kMaxPumps>;

/// A cylinder with its spool, or the swing's motor at its lever, with equal areas. Areas in m^2,
/// flow coefficients in m^3/(s sqrt(Pa)).
struct McvActuator {
  double area_cap_m2 = 0.0;  ///< A_A, parallel cylinders added up.
  double area_rod_m2 = 0.0;  ///< A_B.
  int pump = 0;
  RegenerationSide regeneration = RegenerationSide::kNone;
  double c_drain = 0.0;        ///< c_d of (15); used only where the circuit exists.
  double c_check = 0.0;        ///< c_r of (16).
  double bypass_open = 0.0;    ///< c_v,by at x = 0 of (20).
  double bypass_closed = 0.0;  ///< c_v,by at x != 0.
  double force_offset_n = 0.0;
  double c_inflow_check = 0.0;  ///< Extra check valve before the spool (Remark 3); 0: none.
  BypassClosing bypass_closes_at;
  /// Share of the drive force that is lost at the draining edge, whatever the opening.
  double extend_outlet_share = 0.0;
  double retract_outlet_share = 0.0;
  MonotoneTable extend;   ///< c_L of (9) over |x|, m/(s sqrt(N)) over m, from (0, 0) to x_m.
  MonotoneTable retract;  ///< |c_L| of (11).
};

struct McvPump {
  double leak_linear = 0.0;        ///< m^3/(s Pa)
  double leak_quadratic = 0.0;     ///< m^3/(s Pa^2)
  double series_resistance = 0.0;  ///< Sum of 1/c^2 of the fixed orifices in the bypass line.
  bool has_relief = false;
  double relief_pa = 0.0;  ///< P_pr of Remark 2.
  PumpRegulator regulator;
  double tank_orifice = 0.0;  ///< Last of the bypass, before which negative flow control feels.
};

struct McvMachine {
  int actuator_count = 0;
  int pump_count = 0;
  PerActuator<McvActuator> actuator{};
  PerPump<McvPump> pump{};
};

/// Input of one cycle.
struct McvInput {
  PerActuator<double> velocity_mps{};  ///< V_L^d; exactly 0 keeps that spool closed.
  PerActuator<double> cap_pressure_pa{};
  PerActuator<double> rod_pressure_pa{};
  PerPump<double> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25): flow at zero pressure.
};

/// Defects of a machine or an input, and their place.
enum class McvDefect : std::uint8_t {
  kNone = 0,
  kBadActuatorCount,
  kBadPumpCount,
  kPumpIndex,     ///< Actuator on a pump that is not there.
  kArea,          ///< Not finite or not positive.
  kRegeneration,  ///< Not 0 < c_drain < c_check.
  kBypass,        ///< Not finite or not positive; or closed at no opening, 0 .. 1.
  kForceOffset,   ///< Not finite or negative.
  kExtendTable,   ///< Empty, not from (0, 0).
  kRetractTable,
  kLeak,          ///< Not finite or negative.
  kBypassSeries,  ///< Not finite or negative.
  kRelief,        ///< Not finite or not positive.
  kVelocity,      ///< Not finite.
  kPressure,      ///< Not finite or negative.
  kPumpFlow,      ///< Not finite or negative.
  kInflowCheck,   ///< Neither 0 nor a positive finite coefficient.
  kLambdaRange,   ///< Not in (0, 1], or a reserve out of its range.
  kRegulator,     ///< A margin, a pressure or an orifice that no regulator can have.
  kOutlet,        ///< Not in 0 .. 1.
};

struct McvCheck {
  McvDefect defect = McvDefect::kNone;
  int index = 0;  ///< Of the actuator or pump.
};

/// First defect of a machine; kNone if it may be solved.
[[nodiscard]] McvCheck check_machine(const McvMachine& machine);
/// First defect of an input for a machine that passed its check.
[[nodiscard]] McvCheck check_input(const McvMachine& machine, const McvInput& input);

/// The valve of a bank of drives, actuators in their order. The pumps' flow is an input.
[[nodiscard]] McvMachine mcv_machine(DriveRows drives, Span<const PumpProfile> pumps);

/// c_L at full opening, m/(s sqrt(N)): `inlet_area_m2` is the piston area that the in-flow fills
/// (cap while extending, rod while retracting), `outlet_area_m2` the other one.
[[nodiscard]] double full_opening_velocity_coefficient(const SpoolMetering& metering,
                                                       double spool_in_m2, double spool_out_m2,
                                                       double inlet_area_m2, double outlet_area_m2);

/// c_L against |x|, from closed to x_m, for an area that grows as travel ^ opening_exponent.
/// Points are denser near closed, where the curve bends most.
[[nodiscard]] MonotoneTable velocity_coefficient_table(const SpoolMetering& metering,
                                                       double coefficient_full);

}  // namespace graben
