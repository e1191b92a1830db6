#pragma once
/// Machine profiles: TOML in, checked as a whole, const structs out.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/machines/experiment.hpp"
#include "app/plant/plant_profile.hpp"
#include "firmware/machine/excavator_profile.hpp"

namespace graben::machines {

/// Everything that is wrong with a profile, a line each: key path, line, value, unit, allowed
/// range.
class ProfileError : public std::runtime_error {
 public:
  ProfileError(const std::string& file, std::vector<std::string> errors);
  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// An excavator as its file describes it: what the controller knows, and the machine that the
/// simulation puts in its place.
struct ExcavatorMachine {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< FNV-1a of the file's bytes; on the bus as ProfileHash.
  ExcavatorProfile profile;
  plant::PlantProfile plant;
  Experiment experiment;
};

/// Finds `name` as a path, or as NAME or NAME.toml in one of the folders, in their order. Throws
/// std::runtime_error that lists where it looked.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name,
                                                 const std::vector<std::filesystem::path>& folders);
/// The same among the profiles of this source tree: for the tool and the tests, which stay in it.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name);

enum class MachineKind { kExcavator, kDozer };

/// Which kind of machine a profile describes; reads no more of it. Throws ProfileError if its
/// `kind` is missing or none of these.
[[nodiscard]] MachineKind profile_kind(const std::filesystem::path& file);

/// Reads and checks an excavator's profile. Throws ProfileError with every error found.
[[nodiscard]] ExcavatorMachine load_excavator(const std::filesystem::path& file);

}  // namespace graben::machines
