// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An excavator with what only its simulation needs: its plant, and what can be tried on it beside
/// its plain run.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/excavator_file.hpp"
#include "app/machines/simulated/found.hpp"
#include "app/plant/bucket_contact.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::machines {

class TomlReader;

/// How far a controller's parameters may be off, each way, as a share (Kim 5).
struct Uncertainty {
  double regeneration = 0.0;   ///< c_r, c_d, and the fixed orifices of the bypass (Tk1, Tk2).
  double spool_opening = 0.0;  ///< Each metering area.
  double bypass = 0.0;         ///< c_v,by, open and closed.
  double leak = 0.0;           ///< Both coefficients of each pump.
  double dead_time = 0.0;      ///< Each spool's, against what the controller takes it for.
  FoundRanges found;           ///< Of the machine itself.
};

/// A second way round, in the air, with something in the bucket.
struct AirManoeuvre {
  DigPath path;
  TipPose start;
  double loops = 0.0;  ///< Of the way round.
  double speed_mps = 0.0;
  double payload_kg = 0.0;
  Eigen::Vector2d payload_centre_m = Eigen::Vector2d::Zero();  ///< Bucket frame; a point mass.
};

/// A straight line of the teeth over the ground (Zhang et al., 4).
struct LineTask {
  TeethPose from;
  TeethPose to;
  double duration_s = 0.0;
};

struct Experiment {
  Uncertainty uncertainty;
  plant::SoilProfile soil;
  plant::ObstacleProfile obstacle;
  AirManoeuvre air;
  LineTask line;
  double stiff_bulk_modulus_pa = 0.0;  ///< Oil as stiff as the paper's modes need it.
};

/// What the controller knows, and the machine that a simulation puts in its place.
struct SimulatedExcavator : ExcavatorMachine {
  plant::ExcavatorPlantProfile plant;
  /// What stands in the place of the profile's own machine, as "excavator_22t_found hidden 7";
  /// empty: nothing does.
  std::string simulated;
  bool has_dead_time = false;  ///< The plant's are its own; else they are the controller's.
  Experiment experiment;
};

/// Reads and checks the sections of NAME.sim.toml, for the machine whose NAME.toml has been read.
void read_simulated_sections(TomlReader& reader, SimulatedExcavator& machine);

/// Reads and checks NAME.toml, then NAME.sim.toml beside it; where that names another machine, the
/// plant is that machine's. Throws ProfileError with every error
/// of the first that has any, std::runtime_error where a file is missing.
[[nodiscard]] SimulatedExcavator load_simulated_excavator(const std::filesystem::path& file);

/// What is drawn. kKim has all of his (Kim 5): sensors and the controller's parameters; kAll the
/// machine as it is found beside them.
enum class Errors { kNone, kStrokeBias, kSensors, kParameters, kKim, kAll };

/// Sensors that a machine may be without.
inline constexpr std::array<const char*, 3> kSensorNames = {"spool", "swash", "pressure"};

struct Scenario {
  bool soil = false;   ///< Kim's field of force below the ground.
  std::string ground;  ///< Soil that is cut, of kSoilNames; empty: none.
  /// It lies at the profile's ground line, as Kim's field, instead of where the tracks stand.
  bool ground_at_line = false;
  bool obstacle = false;
  bool air = false;        ///< The manoeuvre in the air instead of the digging path.
  bool stiff_oil = false;  ///< The paper's, for comparison with its figures.
  Errors errors = Errors::kNone;
  std::optional<double> dead_time_s;  ///< Of every spool, as the controller takes it.
  /// IMUs instead of stroke sensors, of a machine whose profile says nothing of them.
  bool imus = false;
  bool seconds = false;  ///< Second sensors on every joint, of such a machine too.
  /// Each IMU of a link is turned by up to so much against its profile, of which the controller is
  /// told nothing; drawn from the seed.
  double imu_mounting_rad = 0.0;
  /// Bus profile, by name or file, of a machine whose own profile says nothing of it; empty: none.
  std::string bus;
  /// Sensors that the machine has not, of kSensorNames; what stands in is the usual.
  std::vector<std::string> without;
  std::uint64_t seed = 0;  ///< Of everything that is drawn.
  Found found;             ///< What is told goes before what is drawn.
};

/// The machine with this scenario's plant, and a controller profile whose parameters are off by a
/// uniform draw within `experiment.uncertainty` of each. The plant keeps the nominal figures, but
/// for dead times, which only it has, and what it is found to be (Errors::kAll, `found`), of which
/// the controller is told nothing. All of that is drawn about what the plant is. Same seed, same
/// draw, whatever else is switched on. Throws std::runtime_error where two of the scenario's
/// switches say the oil, or for a soil that has no such name.
[[nodiscard]] SimulatedExcavator arranged(SimulatedExcavator machine, const Scenario& scenario);

/// Strokes of a start pose. Throws std::runtime_error where it is out of reach.
[[nodiscard]] Eigen::Vector3d strokes_at(const ExcavatorProfile& profile, const TipPose& pose);

/// Strokes that a digging machine starts at unless told: from above the path's far upper corner, as
/// it comes down. Throws as strokes_at().
[[nodiscard]] Eigen::Vector3d dig_start(const ExcavatorProfile& profile);

}  // namespace graben::machines
