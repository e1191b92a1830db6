// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_excavator.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/planned_line.hpp"
#include "app/machines/simulated/drive_sections.hpp"
#include "app/machines/simulated/simulated_sections.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"

namespace graben::machines {
namespace {

/// As valve.deadband and valve.edge.
constexpr double kMostDeadband = 0.9;

plant::LinkBody read_link(TomlReader& reader, const std::string& axis) {
  plant::LinkBody link;
  link.mass_kg = reader.number(axis + ".mass", {10.0, 1e5, "kg"},
                               "mass of the link; the bucket's with its linkage, empty");
  link.inertia_kgm2 = reader.number(axis + ".inertia", {1.0, 1e6, "kg m2"},
                                    "moment of inertia about the mass centre, out of plane");
  link.mass_centre_m =
      reader.point(axis + ".mass_centre", {-10.0, 10.0, "m"}, "mass centre, link frame");
  return link;
}

/// What is not said is as buckets of this length have it.
plant::BucketShape read_bucket(TomlReader& reader, double length_m) {
  plant::BucketShape bucket;
  bucket.width_m = reader.number_or(0.8 * length_m, "bucket.width", {0.1, 5.0, "m"},
                                    "of the edge; 0.8 of the bucket's length unless told");
  bucket.floor_m =
      reader.number_or(0.45 * length_m, "bucket.floor", {0.1, 3.0, "m"},
                       "from the teeth to the heel; 0.45 of the bucket's length unless told");
  bucket.floor_rad = reader.number_or(0.65, "bucket.floor_angle", {0.1, 1.4, "rad"},
                                      "from the line teeth to bucket pin down to the floor");
  bucket.edge_m = reader.number_or(bucket.edge_m, "bucket.edge", {0.002, 0.1, "m"},
                                   "thickness of the edge, which goes into the ground");
  bucket.capacity_m3 = reader.number_or(
      0.3 * bucket.width_m * length_m * length_m, "bucket.capacity", {0.005, 30.0, "m3"},
      "loose soil that the bucket holds, heaped; 0.3 of width and length squared unless told");
  return bucket;
}

void read_swing(TomlReader& reader, plant::ExcavatorPlantProfile& plant) {
  plant.platform.inertia_kgm2 =
      reader.number("swing.inertia", {100.0, 1e6, "kg m2"},
                    "upper structure without boom, arm, bucket; only with valve.swing");
  plant.platform.coulomb_nm = reader.number("swing.coulomb", {0.0, 1e6, "N m"},
                                            "Coulomb friction of the swing; only with valve.swing");
  plant.platform.viscous_nmsprad =
      reader.number("swing.viscous", {0.0, 1e6, "N m s/rad"},
                    "viscous friction of the swing; only with valve.swing");
  plant.swing_motor.dead_volume_m3 =
      reader.number("swing.dead_volume", {1e-5, 1.0, "m3"},
                    "oil on each side of the motor with its hose; only with valve.swing");
  plant.swing_motor.leak_m3pspa = reader.number("swing.leak", {0.0, 1e-9, "m3/(s Pa)"},
                                                "leakage from port to port; only with valve.swing");
  plant.swing_motor.port_relief_pa = reader.number(
      "swing.port_relief", {1e6, 1e8, "Pa"}, "relief of the motor's ports; only with valve.swing");
}

/// Figures of the class unless told: 0.2 deg and 0.2 deg/s; 0.1 deg/s and 0.03 g on a running
/// machine, chosen.
void read_imu_errors(TomlReader& reader, plant::SensorErrors& sensors) {
  sensors.imu_tilt_bias_rad =
      reader.number_or(3.5e-3, "sensors.imu_tilt_bias", {0.0, 0.1, "rad"},
                       "constant error of an IMU's angle, uniform within; where there are IMUs");
  sensors.imu_rate_bias_radps =
      reader.number_or(3.5e-3, "sensors.imu_rate_bias", {0.0, 0.1, "rad/s"},
                       "constant error of each of its gyros, uniform within");
  sensors.imu_rate_noise_radps =
      reader.number_or(1.75e-3, "sensors.imu_rate_noise", {0.0, 0.1, "rad/s"},
                       "standard deviation of a gyro's reading, vibration with it");
  sensors.imu_force_noise_mps2 =
      reader.number_or(0.3, "sensors.imu_acceleration_noise", {0.0, 10.0, "m/s2"},
                       "standard deviation of an accelerometer's reading, vibration with it");
}

/// As fit_usual_seconds() allows for, and a little less.
void read_second_errors(TomlReader& reader, plant::SensorErrors& sensors) {
  sensors.second_bias_m =
      reader.number_or(1.5e-3, "sensors.second_bias", {0.0, 0.05, "m"},
                       "constant error of a cylinder's second sensor, uniform within; where there "
                       "are any");
  sensors.second_swing_bias_rad = reader.number_or(1.5e-3, "sensors.second_swing_bias",
                                                   {0.0, 0.05, "rad"}, "the same of the swing's");
  sensors.second_scale = reader.number_or(1.5e-3, "sensors.second_scale", {0.0, 0.05, ""},
                                          "error of each, of what it shows, uniform within");
  sensors.second_age_s = {0.0, 0.02};
  if (reader.has("sensors.second_age")) {
    const std::vector<double> age =
        reader.numbers("sensors.second_age", {0.0, 0.1, "s"}, 2,
                       "least and most age of what they show; 0 and 0.02 without it");
    sensors.second_age_s = {age[0], std::max(age[0], age[1])};
  }
}

plant::SensorErrors read_sensors(TomlReader& reader, const ExcavatorProfile& nominal) {
  plant::SensorErrors sensors;
  sensors.stroke_resolution_m =
      reader.number("sensors.stroke_resolution", {0.0, 0.01, "m"}, "resolution of the strokes");
  sensors.stroke_bias_m = reader.number("sensors.stroke_bias", {0.0, 0.05, "m"},
                                        "constant error of each stroke, uniform within");
  if (nominal.has_swing()) {
    sensors.swing_resolution_rad =
        reader.number("sensors.swing_resolution", {0.0, 0.01, "rad"},
                      "resolution of the swing angle; only with valve.swing");
    sensors.swing_bias_rad =
        reader.number("sensors.swing_bias", {0.0, 0.05, "rad"},
                      "constant error of the swing angle; only with valve.swing");
  }
  sensors.pressure_range_pa = nominal.safety.pressure_rail_pa;
  sensors.pressure_bias_ratio = reader.number("sensors.pressure_bias", {0.0, 0.5, ""},
                                              "constant error of each pressure, of pressure_range");
  sensors.pressure_noise_ratio =
      reader.number("sensors.pressure_noise", {0.0, 0.5, ""},
                    "standard deviation of each pressure, of pressure_range");
  read_imu_errors(reader, sensors);
  read_second_errors(reader, sensors);
  sensors.joint_bias_rad =
      reader.number_or(3.5e-3, "sensors.joint_bias", {0.0, 0.1, "rad"},
                       "constant error of a joint's angle, uniform within; where the bus has them");
  return sensors;
}

plant::ExcavatorPlantProfile read_plant(TomlReader& reader, const ExcavatorProfile& nominal) {
  plant::ExcavatorPlantProfile plant;
  plant.machine = nominal;
  const std::vector<double> coulomb =
      reader.numbers("friction.coulomb", {0.0, 1e6, "N"}, kAxisCount,
                     "Coulomb friction of boom, arm, bucket, all cylinders of an axis together");
  const std::vector<double> viscous = reader.numbers(
      "friction.viscous", {0.0, 1e7, "N s/m"}, kAxisCount, "viscous friction of boom, arm, bucket");
  const std::vector<double> dead_volume =
      reader.numbers("valve.dead_volume", {1e-5, 1.0, "m3"}, kAxisCount,
                     "oil in each chamber with its hose, fully closed: boom, arm, bucket");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    plant.link[i] = read_link(reader, kAxisNames[i]);
    plant.friction[i] = {coulomb[i], viscous[i]};
    plant.dead_volume_m3[i] = dead_volume[i];
  }
  plant.bucket = read_bucket(reader, nominal.geometry.bucket_length_m);
  plant.line_volume_m3.fill(
      reader.number("valve.line_volume", {1e-5, 1.0, "m3"}, "oil in each pump line"));
  const ValveOfPlant valve = read_valve_of_plant(reader, "valve");
  const plant::SpoolSide side{valve.deadband_ratio, 0.0, nominal.valve.opening_exponent};
  plant.spool.fill({valve.time_constant_s, valve.damping, side, side, plant::kBypassClosingTravel});
  for (unsigned i = 0; i < kDriveCount; ++i) {
    plant.spool[i].bypass_closes_at = nominal.valve.spool[i].bypass_closes_at.extend;
  }
  plant.bulk_modulus_pa = valve.bulk_modulus_pa;
  plant.engine.lag_s =
      reader.number("engine.lag", {0.01, 10.0, "s"},
                    "first-order lag of the engine's speed behind the pumps' power, "
                    "where it sags");
  plant.port_relief_pa =
      reader.number("valve.port_relief", {1e6, 1e8, "Pa"}, "relief of the cylinders' ports");
  if (nominal.has_swing()) {
    read_swing(reader, plant);
  }
  plant.swash_ratio = nominal.dig_swash_ratio;
  plant.dead_time.fill(nominal.control.dead_time_s);
  plant.sensors = read_sensors(reader, nominal);
  return plant;
}

plant::SoilProfile read_soil(TomlReader& reader) {
  const std::string at = "experiment.soil.";
  plant::SoilProfile soil;
  soil.ground_y_m =
      reader.number(at + "ground", {-30.0, 30.0, "m"}, "surface of the soil, from the boom foot");
  const std::vector<double> bias =
      reader.numbers(at + "bias", {0.0, 1e6, "N"}, 2, "mean soil force on the teeth, +x and +y");
  soil.bias_n = {bias[0], bias[1]};
  soil.ramp_m = reader.number(at + "ramp", {0.0, 10.0, "m"}, "depth at which it is full");
  soil.sine_ratio = reader.number(at + "sine", {0.0, 1.0, ""}, "sinusoidal part, of the mean");
  soil.sine_hz = reader.number(at + "sine_frequency", {0.0, 50.0, "Hz"}, "frequency of that part");
  soil.random_ratio = reader.number(at + "random", {0.0, 1.0, ""},
                                    "standard deviation of the random part, of the mean");
  soil.random_hz = reader.number(at + "random_frequency", {0.0, 50.0, "Hz"},
                                 "corner frequency of the random part");
  return soil;
}

/// It stands across the path, so that the bucket runs into it.
plant::ObstacleProfile read_obstacle(TomlReader& reader, const RoundedRectangle& path) {
  const std::string at = "experiment.obstacle.";
  plant::ObstacleProfile obstacle;
  const PathPoint point = path.at_share(reader.number(
      at + "share", {0.0, 1.0, ""}, "where the rock stands: share of the way round the path"));
  obstacle.point_m = point.position_m;
  obstacle.normal = -point.tangent;
  obstacle.stiffness_npm =
      reader.number(at + "stiffness", {1e5, 1e9, "N/m"}, "stiffness of the rock");
  obstacle.damping_nspm = reader.number(at + "damping", {0.0, 1e6, "N s/m"}, "damping of the rock");
  obstacle.friction =
      reader.number(at + "friction", {0.0, 2.0, ""}, "friction of the teeth on the rock");
  obstacle.size_m =
      reader.number(at + "size", {0.01, 2.0, "m"}, "width of the rock across the path");
  obstacle.hold_s = reader.number(at + "hold", {0.1, 60.0, "s"}, "time for which it holds");
  return obstacle;
}

FoundRanges read_found_ranges(TomlReader& reader) {
  const Range share{0.0, 0.9, ""};
  FoundRanges found;
  found.deadband_ratio = reader.number("uncertainty.dead_band", {0.0, 0.3, ""},
                                       "as found: deadband, each way, of the spool's travel");
  found.opening_exponent = reader.number("uncertainty.opening_exponent", {0.0, 0.4, ""},
                                         "as found: exponent of a spool's opening, each way");
  found.bulk_modulus_pa =
      read_interval(reader, "uncertainty.oil", {1e8, 1e11, "Pa"},
                    "as found: bulk modulus of the oil with its hoses, from, to");
  found.spool_time_constant_s = read_interval(reader, "uncertainty.spool_lag", {0.001, 1.0, "s"},
                                              "as found: time constant of a spool, from, to");
  found.friction =
      reader.number("uncertainty.friction", share, "as found: each friction, each way, as a share");
  found.link_mass = reader.number("uncertainty.link_mass", share,
                                  "as found: mass of each link, its inertia with it");
  found.pump_flow =
      reader.number("uncertainty.pump_flow", share, "as found: displacement of each pump");
  found.engine_sag = reader.number("uncertainty.engine_sag", {0.0, 0.5, ""},
                                   "as found, from 0: share of its speed that the engine loses at "
                                   "full pump power");
  found.dead_time_s = reader.number("uncertainty.dead_time_on_top", {0.0, 0.5, "s"},
                                    "as found, from 0: dead time that a spool has beside what the "
                                    "controller is told");
  return found;
}

Uncertainty read_uncertainty(TomlReader& reader) {
  const Range share{0.0, 0.9, ""};
  return {reader.number("uncertainty.regeneration", share,
                        "error of c_drain, c_check and bypass_series, each way, as a share"),
          reader.number("uncertainty.spool_opening", share, "error of each metering area"),
          reader.number("uncertainty.bypass", share, "error of the bypass's coefficients"),
          reader.number("uncertainty.leak", share, "error of the pumps' leakage"),
          reader.number("uncertainty.dead_time", share, "error of each spool's dead time"),
          read_found_ranges(reader)};
}

AirManoeuvre read_air(TomlReader& reader) {
  AirManoeuvre air;
  air.path = read_path(reader, "experiment.air.path");
  const std::vector<double> start =
      reader.numbers("experiment.air.start", {-30.0, 30.0, "m, m, rad"}, 3,
                     "x, y of the teeth from the boom foot, attitude");
  air.start = {start[0], start[1], start[2]};
  air.loops = reader.number("experiment.air.loops", {0.1, 10.0, ""}, "how much of the way round");
  air.speed_mps =
      reader.number("experiment.air.speed", {0.01, 3.0, "m/s"}, "speed of the teeth in the air");
  air.payload_kg =
      reader.number("experiment.air.payload", {0.0, 1e5, "kg"}, "load in the bucket, a point mass");
  air.payload_centre_m = reader.point("experiment.air.payload_centre", {-10.0, 10.0, "m"},
                                      "where it is, bucket frame");
  return air;
}

LineTask read_line_task(TomlReader& reader) {
  const std::string at = "experiment.line";
  return {read_teeth(reader, at + ".from"), read_teeth(reader, at + ".to"),
          reader.number(at + ".duration", {0.5, 600.0, "s"}, "duration of the line")};
}

Experiment read_experiment(TomlReader& reader, const DigPath& path) {
  Experiment experiment;
  experiment.uncertainty = read_uncertainty(reader);
  experiment.soil = read_soil(reader);
  experiment.obstacle = read_obstacle(reader, RoundedRectangle(path));
  experiment.air = read_air(reader);
  experiment.line = read_line_task(reader);
  experiment.stiff_bulk_modulus_pa =
      reader.number("valve.bulk_modulus_kim", {1e8, 1e11, "Pa"},
                    "bulk modulus of the stiff variant (--stiff-oil)");
  return experiment;
}

void check_line(TomlReader& reader, const ExcavatorProfile& profile, const LineTask& task) {
  LineRequest request{task.from, task.to, profile.line.acceleration_mps2};
  request.duration_s = task.duration_s;
  const std::string refusal = line_refusal(profile, request);
  if (!refusal.empty()) {
    reader.fail("experiment.line", refusal);
  }
}

/// The path in the air lies in the work space, the line can be planned. Only where each key by
/// itself is right.
void check_experiment(TomlReader& reader, const ExcavatorProfile& profile,
                      const Experiment& experiment) {
  if (!reader.is_sound()) {
    return;
  }
  ExcavatorProfile in_air = profile;
  in_air.dig_path = experiment.air.path;
  check_path(reader, "experiment.air.path", profile_check(in_air));
  check_line(reader, profile, experiment.line);
}

/// No draw is below nothing or of the whole travel. Only where each key by itself is right.
void check_deadband(TomlReader& reader, const SimulatedExcavator& machine) {
  if (!reader.is_sound()) {
    return;
  }
  const double off = machine.experiment.uncertainty.found.deadband_ratio;
  for (const plant::SpoolDynamics& spool : machine.plant.spool) {
    for (const plant::SpoolSide* side : {&spool.extend, &spool.retract}) {
      const double nominal = side->deadband_ratio;
      if (nominal < off || nominal + off > kMostDeadband) {
        reader.fail("uncertainty.dead_band",
                    fmt::format("{} about valve.deadband of {}; allowed: within 0 .. {}", off,
                                nominal, kMostDeadband));
        return;
      }
    }
  }
}

}  // namespace

void read_simulated_sections(TomlReader& reader, SimulatedExcavator& machine) {
  if (reader.has("machine")) {
    static_cast<void>(
        reader.text("machine",
                    "profile of the machine that this one is but for what this file says, by name "
                    "or by its file; NAME.toml, and all keys here, without"));
  }
  machine.plant = read_plant(reader, machine.profile);
  read_each_drive(reader, machine);
  machine.experiment = read_experiment(reader, machine.profile.dig_path);
  check_experiment(reader, machine.profile, machine.experiment);
  check_deadband(reader, machine);
}

}  // namespace graben::machines
