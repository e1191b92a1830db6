#pragma once
/// The dozer's profile: as machine_file.hpp has it for the excavator.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/machines/profile_file.hpp"
#include "app/plant/dozer_plant_profile.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

struct ProfileDocument;

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

/// A dozer as its file describes it: what the controller knows, and the machine that the
/// simulation puts in its place.
struct DozerMachine {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< FNV-1a of the file's bytes; on the bus as ProfileHash.
  DozerProfile profile;
  plant::DozerPlantProfile plant;
  DozerExperiment experiment;
};

/// Reads and checks a dozer's profile. Throws ProfileError with every error found.
[[nodiscard]] DozerMachine load_dozer(const std::filesystem::path& file);
[[nodiscard]] DozerMachine load_dozer(const ProfileDocument& document);

/// A dozer that is not quite what its file says, and has sensor errors: mass (the moment of inertia
/// in proportion), traction, rolling resistance and the efficiency of implement pump, pumps and
/// motors each off by a uniform draw within `experiment.uncertainty`. An efficiency is drawn about
/// its nominal value, as a share of it, and is at most 1. Same seed, same draw; the controller's
/// profile is for the caller to leave as it is.
[[nodiscard]] plant::DozerPlantProfile draw_dozer(const DozerMachine& machine, std::uint64_t seed);

}  // namespace graben::machines
