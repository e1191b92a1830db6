// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the simulated dozer is: the nominal data that its controller has too, and what only a plant
/// knows. SI units.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/plant/cylinder.hpp"
#include "app/plant/engine.hpp"
#include "app/plant/hydraulics.hpp"
#include "app/plant/soil/soil_kind.hpp"
#include "app/plant/spool.hpp"
#include "firmware/core/time.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::plant {

/// Standard deviations of white noise on each reading; the bias is constant, uniform within.
struct DozerSensorErrors {
  double stroke_resolution_m = 0.0;
  double position_noise_m = 0.0;
  double height_noise_m = 0.0;
  double pitch_noise_rad = 0.0;
  double velocity_noise_mps = 0.0;
  double climb_noise_mps = 0.0;
  double pitch_rate_noise_radps = 0.0;
  double track_speed_noise_mps = 0.0;
  double heading_noise_rad = 0.0015;  ///< Of two antennas a metre apart.
  double height_bias_m = 0.0;
  double pose_latency_s = 0.0;  ///< Between a pose and its message.
};

/// Firmness of the ground (Wong, Janosi and Hanamoto).
struct GroundProfile {
  double friction = 0.0;            ///< Largest traction over the load.
  double slip_modulus_m = 0.0;      ///< Shear deformation modulus K.
  double rolling_resistance = 0.0;  ///< Of the load.
};

/// The blade by what soil sees of it.
struct BladeShape {
  double width_m = 0.0;
  double height_m = 0.0;
  double rake_rad = 0.0;  ///< From the direction of motion to its face, edge on the ground.
  double edge_m = 0.0;    ///< Thickness of its edge, worn.
};

/// What only the plant knows of a blade that tilts; all 0 without.
struct TiltPlant {
  double roll_inertia_kgm2 = 0.0;  ///< Of the whole machine about its longitudinal axis.
  double inertia_kgm2 = 0.0;       ///< Of the blade about the tilt's axis.
  double coulomb_n = 0.0;          ///< Of the tilt cylinder.
  double viscous_nspm = 0.0;
  double dead_volume_m3 = 0.0;  ///< Each chamber with its hose.
};

/// A spool of the blade as it is made.
struct BladeValve {
  SpoolDynamics spool;
  SideDelay dead_time;
  double pilot_lag_s = 0.0;
  double flow_factor = 1.0;  ///< Of the profile's largest flow.
};

struct DozerPlantProfile : HydraulicDetails {
  /// Geometry, displacements, ratios: the plant reads these numbers, and none of the functions that
  /// the controller has for them.
  DozerProfile machine;

  double pitch_inertia_kgm2 = 0.0;  ///< J_c of (15), blade included.
  double gravity_mps2 = 9.80665;

  double blade_mass_kg = 0.0;
  double blade_reach_m = 0.0;  ///< Pivot to the blade's mass centre.
  double coulomb_n = 0.0;      ///< Of the blade cylinders together.
  double viscous_nspm = 0.0;
  double spool_time_constant_s = 0.0;
  double spool_damping = 1.0;
  double deadband_ratio = 0.0;
  double dead_time_s = 0.0;
  double dead_volume_m3 = 0.0;
  double bulk_modulus_pa = 0.0;
  double implement_relief_pa = 0.0;
  TiltPlant tilt;
  /// Lift and tilt where each is its own; else both are as the figures above say.
  std::array<std::optional<BladeValve>, 2> own_valve;

  double hst_relief_pa = 0.0;
  double charge_pa = 0.0;
  double hst_line_volume_m3 = 0.0;
  double pump_response_s = 0.0;
  double motor_response_s = 0.0;
  double displacement_dead_time_s = 0.0;  ///< Of pumps and motors, from a command on.
  std::array<double, kTrackCount> track_flow_factor = {1.0, 1.0};  ///< Of each path's pump.
  double path_inertia_kgm2 = 0.0;                                  ///< At the sprocket.
  double mechanical_efficiency = 0.0;

  GroundProfile ground;
  BladeShape blade_shape;
  /// What resists the blade. Without, nothing does, traction doesn't turn the body, and the engine
  /// holds its speed: the paper's finishing cut.
  std::optional<SoilKind> soil;
  double engine_power_w = 0.0;  ///< Full.
  EngineSag engine_sag;
  DozerSensorErrors sensors;
  std::uint64_t seed = 0;
  bool sensor_errors = false;  ///< Without: resolution only.
  double start_position_m = 0.0;

  // No source gives the figures below; each default says why it is what it is.

  /// Pressure that the load-sensing section keeps over its in-flow edge. Of the class.
  double compensator_margin_pa = 2e6;
  /// Pressure in the chamber that empties. As the blade lowers: above what its weight alone makes
  /// there (3.5 MPa, fully lowered), so that it cannot run ahead of what is fed. As it rises: for
  /// damping.
  double lowering_back_pressure_pa = 6e6;
  double raising_back_pressure_pa = 1.5e6;
  /// Relief at the blade cylinders' ports: above the implement pump's.
  double port_relief_pa = 25e6;

  /// The tilt's chamber that empties, either way: hardly anything drives it but its oil.
  double tilt_back_pressure_pa = 3e6;

  /// Pressure over pump or motor at which the profile's volumetric efficiencies hold: that of work.
  double hst_work_pa = 15e6;
  /// Share of the volumetric losses that goes with speed alone (a displacement derived from tests
  /// is smaller than the geometric one); the rest is laminar leakage. So on the level, at 1 - 3
  /// MPa, the tracks run 3 - 4 % faster than at work.
  double hst_constant_loss_share = 0.6;
  /// Of the valve that flushes a path: what it lets out of the lower line per pressure over the
  /// charge pressure. Some 10 L/min at 0.5 MPa are usual.
  double hst_flushing_m3pspa = 3e-10;
  /// From this difference of the two lines on its shuttle is over.
  double hst_shuttle_pa = 0.4e6;
  /// A displacement's largest rate over the one that the controller counts on.
  double displacement_rate_margin = 1.25;
  /// Of each parking brake, at the sprocket: above what the motor gives at its relief pressure.
  double brake_nm = 60e3;

  /// Damping of the shear of ground and track, each track: 0.8 of what is critical for the machine
  /// on its sheared ground, as soil gives hardly anything back.
  double shear_damping_nspm = 1e5;
  /// Below it the rolling resistance goes to 0 with the speed.
  double rolling_onset_mps = 0.02;
  /// Half the length of track that one wheel presses on the ground.
  double wheel_half_width_m = 0.1;
  double terrain_cell_m = 0.02;

  TimeUs step_us = 500;

  /// Of lift (0) or tilt (1).
  [[nodiscard]] BladeValve valve(std::size_t drive) const {
    const SpoolSide side{deadband_ratio, 0.0, 1.0};
    return own_valve[drive].value_or(
        BladeValve{{spool_time_constant_s, spool_damping, side, side, 1.0}, dead_time_s, 0.0, 1.0});
  }
  /// Both cylinders together; the stroke comes from the blade's reach.
  [[nodiscard]] CylinderData blade_cylinder(double stroke_m) const;
  [[nodiscard]] double step_s() const { return 1e-6 * static_cast<double>(step_us); }
};

}  // namespace graben::plant
