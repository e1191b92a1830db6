// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_excavator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/machines/bus_file.hpp"
#include "app/machines/bus_key.hpp"
#include "app/machines/imu_section.hpp"
#include "app/machines/second_section.hpp"
#include "app/machines/simulated/soil_kinds.hpp"
#include "app/plant/random.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"

namespace graben::machines {
namespace {

using plant::Draw;
using plant::Random;

/// A draw keeps the drain this much smaller than the check, or regeneration would have no model.
constexpr double kMostDrainToCheck = 0.95;

/// Above the path's far upper corner.
constexpr double kStartAbove_m = 0.6;
constexpr double kStartBack_m = 0.8;

void vary(double& value, double share, Random& random) { value *= 1.0 + random.symmetric(share); }

void vary_parameters(ExcavatorProfile& profile, const Uncertainty& uncertainty,
                     std::uint64_t seed) {
  Random random(seed, Draw::kParameters);
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    SpoolProfile& spool = profile.valve.spool[i];
    for (double* area :
         {&spool.extend_in_m2, &spool.extend_out_m2, &spool.retract_in_m2, &spool.retract_out_m2}) {
      vary(*area, uncertainty.spool_opening, random);
    }
    vary(spool.bypass_open, uncertainty.bypass, random);
    vary(spool.bypass_closed, uncertainty.bypass, random);
    vary(spool.c_drain, uncertainty.regeneration, random);
    vary(spool.c_check, uncertainty.regeneration, random);
    spool.c_drain = std::min(spool.c_drain, kMostDrainToCheck * spool.c_check);
  }
  for (PumpProfile& pump : profile.pump) {
    vary(pump.leak_linear, uncertainty.leak, random);
    vary(pump.leak_quadratic, uncertainty.leak, random);
    for (double& orifice : pump.bypass_series) {
      vary(orifice, uncertainty.regeneration, random);
    }
  }
  // After all that every machine has, whose draws stay what they are.
  for (PumpProfile& pump : profile.pump) {
    vary(pump.regulator.margin_pa, uncertainty.bypass, random);
  }
}

/// What forces and payloads that pressures tell hang on, and no file knows: hoses of another bore,
/// length or fittings, and where the load lies in the bucket.
void vary_load(std::uint64_t seed, plant::ExcavatorPlantProfile& plant) {
  constexpr Interval kHoses{0.5, 1.6};
  constexpr double kMiddleOff = 0.06;
  Random random(seed, Draw::kLoad);
  const double hoses = kHoses.least + random.uniform() * (kHoses.most - kHoses.least);
  plant.hose_linear_paspm3 *= hoses;
  plant.hose_quadratic_pas2pm6 *= hoses;
  plant.digging->bucket.middle_along += random.symmetric(kMiddleOff);
  plant.digging->bucket.middle_below += random.symmetric(kMiddleOff);
}

void lay_ground(const Scenario& scenario, const ExcavatorGeometry& geometry, double line_m,
                plant::ExcavatorPlantProfile& plant) {
  plant.digging.emplace();
  plant.digging->soil = ground_of(scenario.ground, scenario.errors == Errors::kAll, scenario.seed);
  plant.digging->bucket = plant.bucket;
  plant.digging->pin_m = geometry.bucket_length_m;
  // Else at the height of the tracks.
  plant.digging->level_m = scenario.ground_at_line ? geometry.boom_foot_m.y() + line_m : 0.0;
  plant.digging->gravity_mps2 = plant.gravity_mps2;
}

/// As if its profile said so. Throws where that can't be made safe.
void take_away(const std::vector<std::string>& sensors, BusCapabilities& bus) {
  for (const std::string& sensor : sensors) {
    (sensor == "spool"   ? bus.spool_feedback
     : sensor == "swash" ? bus.swash_feedback
                         : bus.pressures) = false;
  }
  if (const std::string words = unsafe_words(bus); !words.empty()) {
    throw std::runtime_error(fmt::format("--without {}: {}", fmt::join(sensors, ","), words));
  }
}

/// What a bus of this name needs of the simulated machine.
const std::map<std::string, std::vector<bool plant::SoldParts::*>>& sold_parts() {
  using Parts = plant::SoldParts;
  static const std::map<std::string, std::vector<bool Parts::*>> parts = {
      {"slopes", {&Parts::slopes}},
      {"encoders", {&Parts::encoders}},
      {"inclinometers", {&Parts::inclinometers}},
      {"aux_valves", {&Parts::aux_valves}},
      {"valve_driver", {&Parts::valve_driver}},
      {"retrofit", {&Parts::encoders, &Parts::transmitters, &Parts::aux_valves, &Parts::silent}}};
  return parts;
}

/// Throws where nothing that is simulated says what the bus needs.
void speak(const std::string& speaks, bool own_frames, plant::ExcavatorPlantProfile& plant) {
  const auto named = sold_parts().find(speaks);
  plant.zx200 = speaks == "zx200";
  if (named != sold_parts().end()) {
    for (bool plant::SoldParts::*part : named->second) {
      plant.sold.*part = true;
    }
  } else if (!plant.zx200 && !own_frames) {
    throw std::runtime_error(fmt::format(
        "bus of '{}': no simulated machine speaks it; there is retrofit, zx200", speaks));
  }
}

/// Throws where the machine has no IMUs to be turned.
void turn_imus(double most_rad, std::uint64_t seed, plant::ExcavatorPlantProfile& plant) {
  if (most_rad == 0.0) {
    return;
  }
  if (!plant.machine.imu.known()) {
    throw std::runtime_error(
        "--imu-mounting: the simulated machine has no IMUs; allowed: with [imu] in its profile, or "
        "--sensors imu");
  }
  Random random(seed, Draw::kImuMounting);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    plant.machine.imu.mount[i].turn_rad += random.symmetric(most_rad);
  }
}

}  // namespace

SimulatedExcavator arranged(SimulatedExcavator machine, const Scenario& scenario) {
  const Experiment& experiment = machine.experiment;
  plant::ExcavatorPlantProfile& plant = machine.plant;
  plant.seed = scenario.seed;
  if (scenario.stiff_oil && scenario.found.bulk_modulus_gpa) {
    throw std::runtime_error("the oil is told to be stiff and of a found bulk modulus");
  }
  if (scenario.imus && !machine.profile.imu.known()) {
    fit_usual_imus(machine.profile);
    plant.machine.imu = machine.profile.imu;
  }
  if (scenario.seconds && !machine.profile.second.any()) {
    fit_usual_seconds(machine.profile);
    plant.machine.second = machine.profile.second;
  }
  turn_imus(scenario.imu_mounting_rad, scenario.seed, plant);
  if (!scenario.bus.empty()) {
    put_on_bus(scenario.bus, machine);
    plant.swash_ratio =
        machine.profile.bus.swash_command ? plant.swash_ratio : machine.profile.dig_swash_ratio;
  }
  take_away(scenario.without, machine.profile.bus);
  if (!machine.bus.empty()) {
    speak(machine.bus_speaks, machine.bus.own_frames, plant);
  }
  const bool parameter_errors = scenario.errors == Errors::kParameters ||
                                scenario.errors == Errors::kKim || scenario.errors == Errors::kAll;
  plant.sensor_errors = scenario.errors != Errors::kNone && scenario.errors != Errors::kParameters;
  if (scenario.errors == Errors::kStrokeBias) {
    plant.sensors.pressure_bias_ratio = 0.0;
    plant.sensors.pressure_noise_ratio = 0.0;
  }
  double& assumed_s = machine.profile.control.dead_time_s;
  if (scenario.dead_time_s) {
    assumed_s = *scenario.dead_time_s;
    for (SaidAnswers& said : machine.profile.valve.answer) {
      said.extend.dead_time_s = kUnsaid_s;
      said.retract.dead_time_s = kUnsaid_s;
    }
  }
  Random dead_time(scenario.seed, Draw::kDeadTime);
  for (plant::SideDelay& delay : plant.dead_time) {
    if (!machine.has_dead_time) {
      delay = assumed_s;
    }
    if (parameter_errors) {
      const double factor = 1.0 + dead_time.symmetric(experiment.uncertainty.dead_time);
      delay.extend_s *= factor;
      delay.retract_s *= factor;
    }
  }
  // Before the oil is stiff and the bucket loaded: what is in the bucket is no error of it.
  make_as_found(plant, experiment.uncertainty.found, scenario.errors == Errors::kAll,
                scenario.found);
  if (scenario.soil) {
    plant.soil = experiment.soil;
  }
  if (!scenario.ground.empty()) {
    lay_ground(scenario, machine.profile.geometry, experiment.soil.ground_y_m, plant);
    if (scenario.errors == Errors::kAll) {
      vary_load(scenario.seed, plant);
    }
  }
  if (scenario.obstacle) {
    plant.obstacle = experiment.obstacle;
  }
  if (scenario.stiff_oil) {
    plant.bulk_modulus_pa = experiment.stiff_bulk_modulus_pa;
    // The controller is told.
    if (machine.profile.oil.known()) {
      machine.profile.oil.bulk_modulus_pa = experiment.stiff_bulk_modulus_pa;
    }
  }
  if (scenario.air) {
    machine.profile.dig_path = experiment.air.path;
    machine.profile.dig_speed_mps = experiment.air.speed_mps;
    plant.link[kBucket] = plant::together(
        plant.link[kBucket], {experiment.air.payload_kg, 0.0, experiment.air.payload_centre_m});
  }
  if (parameter_errors) {
    vary_parameters(machine.profile, experiment.uncertainty, scenario.seed);
  }
  return machine;
}

Eigen::Vector3d strokes_at(const ExcavatorProfile& profile, const TipPose& pose) {
  const StrokeResult strokes = ExcavatorKinematics(profile.geometry).strokes_from_pose(pose);
  if (strokes.status != ReachStatus::kOk) {
    throw std::runtime_error(
        fmt::format("start pose x {} m, y {} m, attitude {} rad is outside the work space",
                    pose.x_m, pose.y_m, pose.attitude_rad));
  }
  return strokes.strokes_m;
}

Eigen::Vector3d dig_start(const ExcavatorProfile& profile) {
  const DigPath& path = profile.dig_path;
  const PathPoint below =
      RoundedRectangle(path).closest({path.x_max_m - kStartBack_m, path.y_max_m});
  return strokes_at(
      profile, {below.position_m.x(), below.position_m.y() + kStartAbove_m, below.attitude_rad});
}

}  // namespace graben::machines
