#include "app/machines/simulated/simulated_dozer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/dozer_sections.hpp"
#include "app/machines/simulated/simulated_sections.hpp"
#include "app/plant/random.hpp"

namespace graben::machines {
namespace {

constexpr Range kPressure{1e6, 1e8, "Pa"};
constexpr Range kVolume{1e-5, 1.0, "m3"};

plant::GroundProfile read_ground(TomlReader& reader) {
  plant::GroundProfile ground;
  ground.friction = reader.number("ground.friction", {0.05, 2.0, ""});
  ground.slip_modulus_m = reader.number("ground.slip_modulus", {1e-3, 1.0, "m"});
  ground.rolling_resistance = reader.number("ground.rolling_resistance", {0.0, 0.5, ""});
  return ground;
}

plant::DozerSensorErrors read_sensors(TomlReader& reader) {
  const Range length{0.0, 0.1, "m"};
  const Range speed{0.0, 0.5, "m/s"};
  plant::DozerSensorErrors sensors;
  sensors.stroke_resolution_m = reader.number("sensors.stroke_resolution", {0.0, 0.01, "m"});
  sensors.position_noise_m = reader.number("sensors.position_noise", length);
  sensors.height_noise_m = reader.number("sensors.height_noise", length);
  sensors.pitch_noise_rad = reader.number("sensors.pitch_noise", {0.0, 0.1, "rad"});
  sensors.velocity_noise_mps = reader.number("sensors.velocity_noise", speed);
  sensors.climb_noise_mps = reader.number("sensors.climb_noise", speed);
  sensors.pitch_rate_noise_radps = reader.number("sensors.pitch_rate_noise", {0.0, 0.5, "rad/s"});
  sensors.track_speed_noise_mps = reader.number("sensors.track_speed_noise", speed);
  sensors.height_bias_m = reader.number("sensors.height_bias", length);
  return sensors;
}

void read_transmission(TomlReader& reader, plant::DozerPlantProfile& plant) {
  plant.hst_relief_pa = reader.number("hst.relief", kPressure);
  plant.charge_pa = reader.number("hst.charge", {1e5, 1e7, "Pa"});
  plant.hst_line_volume_m3 = reader.number("hst.line_volume", kVolume);
  plant.pump_response_s = plant.machine.hst.response_s;
  plant.motor_response_s = reader.number("hst.motor_response", {0.001, 2.0, "s"});
  plant.path_inertia_kgm2 = reader.number("hst.inertia", {0.1, 1e4, "kg m2"});
  plant.mechanical_efficiency = reader.number("hst.mechanical_efficiency", {0.3, 1.0, ""});
}

plant::DozerPlantProfile read_plant(TomlReader& reader, const DozerProfile& nominal) {
  plant::DozerPlantProfile plant;
  plant.machine = nominal;
  plant.pitch_inertia_kgm2 = reader.number("body.pitch_inertia", {10.0, 1e6, "kg m2"});
  plant.blade_mass_kg = reader.number("blade.mass", {10.0, 1e5, "kg"});
  plant.blade_reach_m = reader.number("blade.reach", {0.1, 5.0, "m"});
  plant.coulomb_n = reader.number("implement.coulomb", {0.0, 1e6, "N"});
  plant.viscous_nspm = reader.number("implement.viscous", {0.0, 1e7, "N s/m"});
  read_valve_of_plant(reader, "implement", plant);
  plant.dead_time_s = nominal.control.dead_time_s;
  plant.dead_volume_m3 = reader.number("implement.dead_volume", kVolume);
  plant.implement_relief_pa = reader.number("implement.relief", kPressure);
  read_transmission(reader, plant);
  plant.ground = read_ground(reader);
  plant.sensors = read_sensors(reader);
  plant.start_position_m = reader.number("experiment.start", {-1000.0, 0.0, "m"});
  return plant;
}

DozerExperiment read_experiment(TomlReader& reader) {
  DozerExperiment experiment;
  experiment.length_m = reader.number("experiment.length", {1.0, 1000.0, "m"});
  experiment.uncertainty = {reader.number("uncertainty.mass", {0.0, 0.5, ""}),
                            reader.number("uncertainty.friction", {0.0, 0.5, ""}),
                            reader.number("uncertainty.efficiency", {0.0, 0.5, ""})};
  return experiment;
}

/// The paper's figures fit the design.
void check_experiment(TomlReader& reader, const GradeDesign& grade, double length_m) {
  constexpr double kDepthTolerance_m = 1e-3;
  const double depth_max_m = reader.number("experiment.depth_max", {0.0, 5.0, "m"});
  if (!reader.errors().empty()) {
    return;
  }
  const double lowest_m = lowest_point_m(grade);
  if (std::abs(lowest_m + depth_max_m) > kDepthTolerance_m) {
    reader.fail("experiment.depth_max",
                fmt::format("{} m; the profile's lowest point is at {} m", depth_max_m, lowest_m));
  }
  const GradePoint& last = grade.point[static_cast<unsigned>(grade.count - 1)];
  if (length_m > last.x_m) {
    reader.fail("experiment.length", fmt::format("{} m; allowed: at most to the profile's end, {} "
                                                 "m",
                                                 length_m, last.x_m));
  }
}

}  // namespace

SimulatedDozer load_simulated_dozer(const std::filesystem::path& file) {
  SimulatedDozer machine;
  static_cast<DozerMachine&>(machine) = load_dozer(file);
  read_as(read_simulation(file), MachineKind::kDozer, [&](TomlReader& reader) {
    machine.plant = read_plant(reader, machine.profile);
    machine.experiment = read_experiment(reader);
    check_experiment(reader, machine.profile.grade, machine.experiment.length_m);
  });
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
