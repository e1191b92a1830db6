// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the simulated excavator is. The nominal data are those that its controller has too; the
/// rest only a plant knows: masses, friction, compressibility, each spool as it is made, leakage,
/// how far its pumps and its engine are from their data. SI units, pressures above ambient; axes in
/// the order boom, arm, bucket, drives with the swing after them.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "app/plant/bucket_contact.hpp"
#include "app/plant/cylinder.hpp"
#include "app/plant/engine.hpp"
#include "app/plant/hydraulics.hpp"
#include "app/plant/link_body.hpp"
#include "app/plant/pump_line.hpp"
#include "app/plant/soil/digging_profile.hpp"
#include "app/plant/spool.hpp"
#include "app/plant/swing_drive.hpp"
#include "app/plant/valve_section.hpp"
#include "firmware/core/time.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::plant {

/// Kim 5. Ratios are of `pressure_range_pa`. A zero is what a sensor shows where the truth is 0,
/// always; a bias is drawn beside it.
struct SensorErrors {
  double stroke_resolution_m = 0.0;
  double stroke_bias_m = 0.0;
  double swing_resolution_rad = 0.0;
  double swing_bias_rad = 0.0;
  double pressure_range_pa = 0.0;
  double pressure_bias_ratio = 0.0;
  double pressure_noise_ratio = 0.0;
  // Of each IMU, where the machine has them; noise is of one reading, vibration with it.
  double imu_tilt_bias_rad = 0.0;     ///< Of its alignment and its accelerometer.
  double imu_rate_bias_radps = 0.0;   ///< Of each of its gyros.
  double imu_rate_noise_radps = 0.0;  ///< Standard deviation.
  double imu_force_noise_mps2 = 0.0;  ///< Standard deviation.
  double joint_bias_rad = 0.0;        ///< Of a joint's angle, where the machine measures that.
  // Of second sensors, where the machine has them.
  double second_bias_m = 0.0;  ///< Of a stroke.
  double second_scale = 0.0;   ///< Of what a stroke or angle shows.
  double second_swing_bias_rad = 0.0;
  std::array<double, 2> second_age_s{};  ///< Least and most, of what they show.
  std::array<double, kAxisCount> stroke_zero_m{};
  std::array<double, kAxisCount> stroke_age_s{};  ///< Of what it shows.
  /// Of each drive's two chambers; of the swing cap is the left port, rod the right one.
  std::array<double, kDriveCount> cap_zero_pa{};
  std::array<double, kDriveCount> rod_zero_pa{};
};

/// The swing motor as the simulated machine has it; its displacement is the nominal one.
struct SwingMotorDetails {
  double dead_volume_m3 = 0.0;  ///< Each of its two chambers, with hose.
  double leak_m3pspa = 0.0;     ///< From port to port, laminar.
  double port_relief_pa = 0.0;  ///< Brakes the platform when the spool closes.
};

/// Of a spool's four full metering areas, on the nominal ones.
struct AreaFactors {
  double extend_in = 1.0;
  double extend_out = 1.0;
  double retract_in = 1.0;
  double retract_out = 1.0;
};

/// Of a main spool, see SpoolDynamics. No source gives it; half of the usual deadband.
inline constexpr double kBypassClosingTravel = 0.1;

/// The same where an edge opens earlier: open at neutral it has to be.
inline void fit_bypass(SpoolDynamics& spool) {
  spool.bypass_closing_travel =
      std::min({kBypassClosingTravel, spool.extend.start_ratio(), spool.retract.start_ratio()});
}

/// Parts off the shelf that the machine has in the place of what speaks our bus.
struct SoldParts {
  bool slopes = false;         ///< Slope sensors of SAE J1939 in the place of stroke sensors.
  bool encoders = false;       ///< Encoders of CANopen in the same place.
  bool inclinometers = false;  ///< Inclinometers of CANopen in the same place.
  bool transmitters = false;   ///< Pressure transmitters of CANopen.
  bool aux_valves = false;     ///< Auxiliary valves of ISO 11783-7.
  bool valve_driver = false;   ///< A driver that takes currents.
  /// Nothing of the machine speaks our bus but its engine. Sensors are on the second bus.
  bool silent = false;
};

struct ExcavatorPlantProfile : HydraulicDetails {
  /// Geometry, valve areas, regeneration, pumps: the plant reads these numbers, and none of the
  /// functions that the controller has for them.
  ExcavatorProfile machine;

  std::array<LinkBody, kAxisCount> link;  ///< The bucket's includes its linkage.
  std::array<PistonFriction, kAxisCount> friction;
  PlatformData platform;  ///< With `swing_motor` looked at only where there is a swing drive.
  SwingMotorDetails swing_motor;
  double gravity_mps2 = 9.80665;

  /// Each drive's: second-order lag, deadband (Kim 5), opening. Its exponents go before the
  /// nominal one of `machine`.
  std::array<SpoolDynamics, kDriveCount> spool;
  std::array<AreaFactors, kDriveCount> area_factors;
  std::array<double, kPumpCount> pump_flow_ratio{1.0, 1.0};  ///< Of the nominal displacement.
  EngineSag engine;

  double bulk_modulus_pa = 0.0;
  std::array<double, kAxisCount> dead_volume_m3{};  ///< Each of the axis' two chambers, with hose.
  std::array<double, kPumpCount> line_volume_m3{};
  double port_relief_pa = 0.0;  ///< Opening pressure of the relief at each cylinder port.

  std::array<double, kPumpCount> swash_ratio{};  ///< Of full swash, unless commanded.
  SensorErrors sensors;
  bool zx200 = false;  ///< It speaks the bus of its class instead of ours.
  SoldParts sold;
  /// Seed of the sensors' bias and noise and of the soil's random part.
  std::uint64_t seed = 0;
  bool sensor_errors = false;  ///< Without: strokes to the resolution, pressures exact.
  std::array<SideDelay, kDriveCount> dead_time;
  /// First-order lag of the pilot pressure that sends the spool, behind the dead time.
  std::array<double, kDriveCount> pilot_lag_s{};
  std::optional<SoilProfile> soil;
  BucketShape bucket;                     ///< As soil sees it.
  std::optional<DiggingProfile> digging;  ///< Ground that is cut.
  std::optional<ObstacleProfile> obstacle;
  /// So far the machine rocks on its tracks under the full force of its bucket at the boom's end,
  /// see RockingBase; 0: the ground is firm.
  double rocking_rad = 0.0;

  // No source gives the figures below; each default says why it is what it is.

  /// First-order lag from a commanded swash to the pump's. Chosen: regulators of the class take 0.1
  /// to 0.3 s over their whole range.
  double swash_time_constant_s = 0.1;

  /// Hose between valve and cylinder, laminar and turbulent share of its pressure drop: 0.1 and 0.3
  /// MPa at 200 L/min. Chosen; some 3 m of 25 mm hose with its fittings.
  double hose_linear_paspm3 = 3e7;
  double hose_quadratic_pas2pm6 = 2.7e10;
  /// Cushions: over this last part of the stroke the way out of the chamber narrows, so that a
  /// piston brakes evenly. Chosen.
  double cushion_length_m = 0.05;
  /// At half the cushion's length a piston of this speed meets this pressure: at full swash pistons
  /// come in at 0.07 - 0.24 m/s and then touch the end at less than 0.06.
  double cushion_speed_mps = 0.15;
  double cushion_pressure_pa = 15e6;
  /// What stays of the cushion's length to compute with at the very end, where it would be shut.
  double cushion_end_m = 1e-3;
  /// Fixed step of the simulation. Stable at any length (transmission-line elements); the length
  /// decides accuracy only, see `ExcavatorPlant`.
  TimeUs step_us = 200;

  [[nodiscard]] Oil oil() const { return {bulk_modulus_pa, boiling_pa}; }
  [[nodiscard]] CylinderData cylinder(int axis) const;
  [[nodiscard]] SwingMotorData motor() const;
  [[nodiscard]] SectionData section(int drive) const;
  [[nodiscard]] PumpLineData pump_line(int pump) const;
  /// Of the ports of a valve section.
  [[nodiscard]] PortProtection port_protection(int drive) const {
    return protection(drive == kSwing ? swing_motor.port_relief_pa : port_relief_pa);
  }
  [[nodiscard]] std::size_t drive_count() const {
    return static_cast<std::size_t>(machine.drive_count);
  }
  [[nodiscard]] double step_s() const { return 1e-6 * static_cast<double>(step_us); }
};

}  // namespace graben::plant
