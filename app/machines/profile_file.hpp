#pragma once
/// Machine profiles as files, whatever their kind: TOML in, checked as a whole.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

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

/// Finds `name` as a path, or as NAME or NAME.toml in one of the folders, in their order. Throws
/// std::runtime_error that lists where it looked, and calls it `what`.
[[nodiscard]] std::filesystem::path find_file(const char* what, const std::string& name,
                                              const std::vector<std::filesystem::path>& folders);
/// A profile.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name,
                                                 const std::vector<std::filesystem::path>& folders);
/// The same among the profiles of this source tree: for the tool and the tests, which stay in it.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name);

enum class MachineKind { kExcavator, kDozer };

/// Which kind of machine a profile describes; reads no more of it. Throws ProfileError if its
/// `kind` is missing or none of these.
[[nodiscard]] MachineKind profile_kind(const std::filesystem::path& file);

}  // namespace graben::machines
