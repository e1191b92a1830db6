// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Machine profiles as files, whatever their kind: TOML in, checked as a whole. NAME.toml is the
/// machine, as its controller has to know it; NAME.sim.toml beside it is what only a simulation of
/// it needs.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace graben::machines {

/// Everything that is wrong with a file, a line each: key path, line, value, unit, allowed range.
class ProfileError : public std::runtime_error {
 public:
  ProfileError(const std::string& file, std::vector<std::string> errors);
  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// Finds `name` as a path, or as NAME or NAME.toml in one of the folders, in their order. Throws
/// std::runtime_error that lists where it looked, what is there and what may have been meant, and
/// calls it `what`.
[[nodiscard]] std::filesystem::path find_file(const char* what, const std::string& name,
                                              const std::vector<std::filesystem::path>& folders);
/// A profile. Throws the same, and where the file is a simulated machine's.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name,
                                                 const std::vector<std::filesystem::path>& folders);
/// The same among the profiles that the tool brings: /usr/share/graben/machines where it is
/// installed in /usr/bin, those of the sources in a build folder.
[[nodiscard]] std::filesystem::path find_profile(const std::string& name);
/// Where these are; the tool's first, then the deployed process'.
[[nodiscard]] std::vector<std::filesystem::path> shipped_folders();
/// What find_profile(name) and find_task(name) know, in order; none where nothing is shipped.
[[nodiscard]] std::vector<std::string> shipped_profile_names();
[[nodiscard]] std::vector<std::string> shipped_task_names();
/// A design as it is named, or of that name among the shipped ones, such as trench.xml.
[[nodiscard]] std::filesystem::path find_design(const std::filesystem::path& name);
/// Names of the profiles or tasks in these folders: each NAME.toml that is no simulated machine's,
/// once, in order.
[[nodiscard]] std::vector<std::string> file_names(
    const std::vector<std::filesystem::path>& folders);
/// Names of the simulated machines in this folder: each NAME.sim.toml, in order.
[[nodiscard]] std::vector<std::string> simulation_names(const std::filesystem::path& folder);
/// A profile in the folder `beside`, then among those that the tool brings.
[[nodiscard]] std::filesystem::path find_machine(const std::string& name,
                                                 const std::filesystem::path& beside);
/// NAME.sim.toml there. Throws std::runtime_error where there is none.
[[nodiscard]] std::filesystem::path find_shipped_simulation(const std::string& name);
/// What find_shipped_simulation(name) knows, in order.
[[nodiscard]] std::vector<std::string> shipped_simulation_names();

/// NAME.sim.toml beside this machine's NAME.toml, be it there or not.
[[nodiscard]] std::filesystem::path simulation_file(const std::filesystem::path& file);
/// True for NAME.sim.toml.
[[nodiscard]] bool is_simulation_file(const std::filesystem::path& file);

enum class MachineKind { kExcavator, kDozer };

/// The kind of machine that a file describes; reads no more of it. Throws ProfileError if its
/// `kind` is missing or none of these.
[[nodiscard]] MachineKind profile_kind(const std::filesystem::path& file);

struct ProfileDocument;

}  // namespace graben::machines
