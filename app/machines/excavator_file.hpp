#pragma once
/// The excavator's profile: TOML in, checked as a whole, const structs out.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/machines/profile_file.hpp"
#include "app/machines/simulated/experiment.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

struct ProfileDocument;

/// An excavator as its file describes it: what the controller knows, and the machine that the
/// simulation puts in its place.
struct ExcavatorMachine {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< FNV-1a of the file's bytes; on the bus as ProfileHash.
  ExcavatorProfile profile;
  plant::ExcavatorPlantProfile plant;
  Experiment experiment;
};

/// Reads and checks an excavator's profile. Throws ProfileError with every error found.
[[nodiscard]] ExcavatorMachine load_excavator(const std::filesystem::path& file);
[[nodiscard]] ExcavatorMachine load_excavator(const ProfileDocument& document);

}  // namespace graben::machines
