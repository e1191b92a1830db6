// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_dozer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/design_file.hpp"
#include "app/machines/dozer_sections.hpp"
#include "app/machines/simulated/simulated_sections.hpp"
#include "app/plant/random.hpp"

namespace graben::machines {
namespace {

constexpr Range kPressure{1e6, 1e8, "Pa"};
constexpr Range kVolume{1e-5, 1.0, "m3"};

plant::GroundProfile read_ground(TomlReader& reader) {
  plant::GroundProfile ground;
  ground.friction =
      reader.number("ground.friction", {0.05, 2.0, ""}, "largest traction over the load");
  ground.slip_modulus_m =
      reader.number("ground.slip_modulus", {1e-3, 1.0, "m"},
                    "shear deformation modulus over the contact's length (Janosi and Hanamoto)");
  ground.rolling_resistance = reader.number("ground.rolling_resistance", {0.0, 0.5, ""},
                                            "rolling resistance over the load");
  return ground;
}

plant::DozerSensorErrors read_sensors(TomlReader& reader) {
  const Range length{0.0, 0.1, "m"};
  const Range speed{0.0, 0.5, "m/s"};
  plant::DozerSensorErrors sensors;
  sensors.stroke_resolution_m = reader.number("sensors.stroke_resolution", {0.0, 0.01, "m"},
                                              "resolution of the blade's stroke");
  sensors.position_noise_m =
      reader.number("sensors.position_noise", length, "standard deviation of the position");
  sensors.height_noise_m =
      reader.number("sensors.height_noise", length, "standard deviation of the height");
  sensors.pitch_noise_rad =
      reader.number("sensors.pitch_noise", {0.0, 0.1, "rad"}, "standard deviation of the pitch");
  sensors.velocity_noise_mps =
      reader.number("sensors.velocity_noise", speed, "standard deviation of the velocity");
  sensors.climb_noise_mps =
      reader.number("sensors.climb_noise", speed, "standard deviation of the vertical velocity");
  sensors.pitch_rate_noise_radps = reader.number("sensors.pitch_rate_noise", {0.0, 0.5, "rad/s"},
                                                 "standard deviation of the pitch rate");
  sensors.track_speed_noise_mps =
      reader.number("sensors.track_speed_noise", speed, "standard deviation of each track's speed");
  sensors.height_bias_m =
      reader.number("sensors.height_bias", length, "constant error of the height, uniform within");
  return sensors;
}

void read_transmission(TomlReader& reader, plant::DozerPlantProfile& plant) {
  plant.hst_relief_pa =
      reader.number("hst.relief", kPressure, "relief of the transmission's lines");
  plant.charge_pa =
      reader.number("hst.charge", {1e5, 1e7, "Pa"}, "charge pressure of the transmission");
  plant.hst_line_volume_m3 =
      reader.number("hst.line_volume", kVolume, "oil in each line of the transmission");
  plant.pump_response_s = plant.machine.hst.response_s;
  plant.motor_response_s = reader.number("hst.motor_response", {0.001, 2.0, "s"},
                                         "first-order lag of the motor's displacement");
  plant.path_inertia_kgm2 = reader.number("hst.inertia", {0.1, 1e4, "kg m2"},
                                          "rotating parts of one track's drive, at the sprocket");
  plant.mechanical_efficiency =
      reader.number("hst.mechanical_efficiency", {0.3, 1.0, ""}, "of motor, gear and track");
}

/// Only with the profile's [tilt].
plant::TiltPlant read_tilt_plant(TomlReader& reader, const DozerProfile& nominal,
                                 double blade_width_m) {
  plant::TiltPlant tilt;
  const bool tilts = reader.lists() ? reader.has("tilt") : nominal.tilt.present;
  if (!tilts) {
    return tilt;
  }
  tilt.roll_inertia_kgm2 =
      reader.number("tilt.roll_inertia", {10.0, 1e6, "kg m2"},
                    "whole machine in roll; this and the next only with the profile's [tilt]");
  tilt.inertia_kgm2 = reader.number("tilt.inertia", {1.0, 1e5, "kg m2"}, "blade about its tilt");
  tilt.coulomb_n =
      reader.number("tilt.coulomb", {0.0, 1e6, "N"}, "Coulomb friction of the tilt cylinder");
  tilt.viscous_nspm =
      reader.number("tilt.viscous", {0.0, 1e7, "N s/m"}, "viscous friction of the tilt cylinder");
  tilt.dead_volume_m3 =
      reader.number("tilt.dead_volume", kVolume, "oil in each chamber with its hose, fully closed");
  constexpr double kSame_m = 1e-3;
  if (!reader.lists() && std::abs(blade_width_m - nominal.tilt.edge_width_m) > kSame_m) {
    reader.fail("blade.width", fmt::format("{} m; allowed: the profile's tilt.edge_width, {} m",
                                           blade_width_m, nominal.tilt.edge_width_m));
  }
  return tilt;
}

plant::BladeShape read_blade_shape(TomlReader& reader) {
  plant::BladeShape blade;
  blade.width_m = reader.number("blade.width", {0.5, 10.0, "m"}, "of the blade");
  blade.height_m = reader.number("blade.height", {0.2, 3.0, "m"}, "of the blade");
  blade.rake_rad = reader.number("blade.rake", {0.5, 1.8, "rad"},
                                 "from the direction of motion to the blade's face");
  blade.edge_m = reader.number("blade.edge", {0.001, 0.1, "m"}, "thickness of the worn edge");
  return blade;
}

plant::DozerPlantProfile read_plant(TomlReader& reader, const DozerProfile& nominal) {
  plant::DozerPlantProfile plant;
  plant.machine = nominal;
  plant.pitch_inertia_kgm2 = nominal.body.pitch_inertia_kgm2;
  plant.blade_mass_kg = reader.number("blade.mass", {10.0, 1e5, "kg"}, "blade with its frame");
  plant.blade_reach_m =
      reader.number("blade.reach", {0.1, 5.0, "m"}, "pivot to the mass centre of blade and frame");
  plant.blade_shape = read_blade_shape(reader);
  plant.tilt = read_tilt_plant(reader, nominal, plant.blade_shape.width_m);
  plant.engine_power_w =
      reader.number("engine.power", {1e3, 1e7, "W"}, "full power, with ground that resists");
  plant.engine_sag = {reader.number("engine.sag", {0.0, 0.5, ""},
                                    "share of its speed that the engine loses at full power"),
                      reader.number("engine.lag", {0.01, 10.0, "s"}, "from power to speed")};
  plant.coulomb_n = reader.number("implement.coulomb", {0.0, 1e6, "N"},
                                  "Coulomb friction of the blade cylinders together");
  plant.viscous_nspm = reader.number("implement.viscous", {0.0, 1e7, "N s/m"},
                                     "viscous friction of the blade cylinders together");
  const ValveOfPlant valve = read_valve_of_plant(reader, "implement");
  plant.spool_time_constant_s = valve.time_constant_s;
  plant.spool_damping = valve.damping;
  plant.deadband_ratio = valve.deadband_ratio;
  plant.bulk_modulus_pa = valve.bulk_modulus_pa;
  plant.dead_time_s = nominal.control.dead_time_s;
  plant.dead_volume_m3 = reader.number("implement.dead_volume", kVolume,
                                       "oil in each chamber with its hose, fully closed");
  plant.implement_relief_pa =
      reader.number("implement.relief", kPressure, "relief of the implement pump");
  read_transmission(reader, plant);
  plant.ground = read_ground(reader);
  plant.sensors = read_sensors(reader);
  plant.sensors.pose_latency_s = nominal.control.pose_latency_s;
  plant.start_position_m = reader.number("experiment.start", {-1000.0, 0.0, "m"},
                                         "position of the body at the start, on flat ground");
  return plant;
}

DozerExperiment read_experiment(TomlReader& reader) {
  DozerExperiment experiment;
  experiment.length_m = reader.number("experiment.length", {1.0, 1000.0, "m"},
                                      "the grade is made and measured from x = 0 to here");
  experiment.uncertainty = {reader.number("uncertainty.mass", {0.0, 0.5, ""},
                                          "error of mass and pitch inertia, each way, as a share"),
                            reader.number("uncertainty.friction", {0.0, 0.5, ""},
                                          "error of traction and rolling resistance"),
                            reader.number("uncertainty.efficiency", {0.0, 0.5, ""},
                                          "error of each volumetric efficiency")};
  return experiment;
}

/// The paper's figures fit the design.
void check_experiment(TomlReader& reader, const GradeDesign& grade, double length_m) {
  constexpr double kDepthTolerance_m = 1e-3;
  const double depth_max_m =
      reader.number("experiment.depth_max", {0.0, 5.0, "m"},
                    "depth of the design; says again its lowest point, within 1 mm");
  if (!reader.is_sound()) {
    return;
  }
  const double lowest_m = lowest_point_m(grade);
  if (std::abs(lowest_m + depth_max_m) > kDepthTolerance_m) {
    reader.fail("experiment.depth_max",
                fmt::format("{} m; the design's lowest point is at {} m", depth_max_m, lowest_m));
  }
  // Its end on the grid is as exact as a number of steps is.
  if (length_m > grade.end_m() + 1e-6) {
    reader.fail("experiment.length", fmt::format("{} m; allowed: at most to the design's end, {} m",
                                                 length_m, grade.end_m()));
  }
}

}  // namespace

void read_simulated_sections(TomlReader& reader, SimulatedDozer& machine) {
  machine.plant = read_plant(reader, machine.profile);
  machine.experiment = read_experiment(reader);
  check_experiment(reader, machine.profile.grade, machine.experiment.length_m);
}

SimulatedDozer load_simulated_dozer(const std::filesystem::path& file) {
  SimulatedDozer machine;
  static_cast<DozerMachine&>(machine) = load_dozer(file);
  read_as(read_simulation(file), MachineKind::kDozer,
          [&](TomlReader& reader) { read_simulated_sections(reader, machine); });
  return machine;
}

SimulatedDozer with_design(SimulatedDozer machine, const DesignLine& line, double rounding_m,
                           const std::string& file) {
  machine.profile.grade.rounding_m = rounding_m;
  set_design(machine, heights_of(line, rounding_m));
  machine.plant.machine.grade = machine.profile.grade;
  machine.experiment.length_m = machine.profile.grade.end_m();
  std::vector<std::string> errors;
  for (const DesignError& error : design_errors(machine.profile)) {
    errors.push_back(error.what);
  }
  if (!errors.empty()) {
    throw ProfileError(file, errors);
  }
  return machine;
}

plant::DozerPlantProfile draw_dozer(const SimulatedDozer& machine, std::uint64_t seed) {
  const DozerUncertainty& uncertainty = machine.experiment.uncertainty;
  plant::DozerPlantProfile plant = machine.plant;
  plant::Random random(seed, plant::Draw::kParameters);
  const double mass = 1.0 + random.symmetric(uncertainty.mass);
  for (double* kg : {&plant.machine.body.mass_kg, &plant.blade_mass_kg}) {
    *kg *= mass;
  }
  plant.pitch_inertia_kgm2 *= mass;
  plant.tilt.roll_inertia_kgm2 *= mass;
  for (double* share : {&plant.ground.friction, &plant.ground.rolling_resistance}) {
    *share *= 1.0 + random.symmetric(uncertainty.friction);
  }
  for (double* efficiency :
       {&plant.machine.implement.efficiency, &plant.machine.hst.pump_efficiency,
        &plant.machine.hst.motor_efficiency}) {
    *efficiency = std::min(*efficiency * (1.0 + random.symmetric(uncertainty.efficiency)), 1.0);
  }
  plant.sensor_errors = true;
  plant.seed = seed;
  return plant;
}

}  // namespace graben::machines
