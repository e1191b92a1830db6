// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer with what only its simulation needs.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/design_file.hpp"
#include "app/machines/dozer_file.hpp"
#include "app/plant/dozer_plant_profile.hpp"

namespace graben::machines {

class TomlReader;

/// How far a dozer may be off from what its controller takes it for, each way, as a share.
struct DozerUncertainty {
  double mass = 0.0;        ///< Of the whole machine, its moment of inertia with it.
  double friction = 0.0;    ///< The ground's: largest traction, and rolling resistance.
  double efficiency = 0.0;  ///< Volumetric, of each pump and of the motors.
};

struct DozerExperiment {
  double length_m = 0.0;  ///< The grade is made and judged from x = 0 to here.
  DozerUncertainty uncertainty;
};

/// What the controller knows, and the machine that a simulation puts in its place.
struct SimulatedDozer : DozerMachine {
  plant::DozerPlantProfile plant;
  DozerExperiment experiment;
};

/// Reads and checks the sections of NAME.sim.toml, for the machine whose NAME.toml has been read.
void read_simulated_sections(TomlReader& reader, SimulatedDozer& machine);

/// Reads and checks NAME.toml, then NAME.sim.toml beside it. Throws as load_simulated_excavator.
[[nodiscard]] SimulatedDozer load_simulated_dozer(const std::filesystem::path& file);

/// The machine with this line along the track as its design, rounded as far, all of it to be
/// made. Throws ProfileError of `file` with what of it this machine can't make.
[[nodiscard]] SimulatedDozer with_design(SimulatedDozer machine, const DesignLine& line,
                                         double rounding_m, const std::string& file);

/// A dozer that is not quite what its file says, and has sensor errors: mass (the moment of inertia
/// in proportion), traction, rolling resistance and the efficiency of implement pump, pumps and
/// motors each off by a uniform draw within `experiment.uncertainty`. An efficiency is drawn about
/// its nominal value, as a share of it, and is at most 1. Same seed, same draw; the controller's
/// profile is for the caller to leave as it is.
[[nodiscard]] plant::DozerPlantProfile draw_dozer(const SimulatedDozer& machine,
                                                  std::uint64_t seed);

struct DozerScenario {
  SpeedPolicy policy = SpeedPolicy::kBounded;
  std::optional<double> speed_mps;       ///< v_d; the profile's unless told.
  std::optional<double> engine_radps;    ///< Where the throttle stands; the profile's unless told.
  std::optional<double> dead_time_s;     ///< Of the blade's valve, in controller and plant.
  std::optional<double> pose_latency_s;  ///< Of the pose sensor, in controller and plant.
  std::optional<double>
      pass_depth_m;        ///< Of the first; else the profile's, 0.08 at most in a soil.
  std::string soil;        ///< Of kSoilNames: the ground resists; empty: it does not.
  bool errors = false;     ///< The machine is drawn: draw_dozer.
  std::uint64_t seed = 0;  ///< Of everything that is drawn.
};

/// The machine with this scenario's plant, and a controller profile with its policy and speed. The
/// engine's speed is the machine's alone: the controller has to take it from the bus. Throws
/// std::runtime_error where it is out of the profile's range.
[[nodiscard]] SimulatedDozer arranged(SimulatedDozer machine, const DozerScenario& scenario);

}  // namespace graben::machines
