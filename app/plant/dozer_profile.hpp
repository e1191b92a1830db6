#pragma once
/// What the simulated dozer is: the nominal data that its controller has too, and what only a plant
/// knows. SI units.

#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/machine/dozer_profile.hpp"

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
  double height_bias_m = 0.0;
};

/// Firmness of the ground (Wong, Janosi and Hanamoto).
struct GroundProfile {
  double friction = 0.0;            ///< Largest traction over the load.
  double slip_modulus_m = 0.0;      ///< Shear deformation modulus K.
  double rolling_resistance = 0.0;  ///< Of the load.
};

struct DozerPlantProfile {
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

  double hst_relief_pa = 0.0;
  double charge_pa = 0.0;
  double hst_line_volume_m3 = 0.0;
  double pump_response_s = 0.0;
  double motor_response_s = 0.0;
  double path_inertia_kgm2 = 0.0;  ///< At the sprocket.
  double mechanical_efficiency = 0.0;

  GroundProfile ground;
  DozerSensorErrors sensors;
  std::uint64_t seed = 0;
  bool sensor_errors = false;  ///< Without: resolution only.
  double start_position_m = 0.0;

  TimeUs step_us = 500;

  [[nodiscard]] double step_s() const { return 1e-6 * static_cast<double>(step_us); }
};

}  // namespace graben::plant
