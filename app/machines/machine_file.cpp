#include "app/machines/machine_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "app/machines/excavator_sections.hpp"

namespace graben::machines {
namespace {

std::uint32_t fnv1a(const std::string& bytes) {
  std::uint32_t hash = 2166136261u;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 16777619u;
  }
  return hash;
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw std::runtime_error(fmt::format("{}: can't be read", file.string()));
  }
  return text.str();
}

}  // namespace

ProfileError::ProfileError(const std::string& file, std::vector<std::string> errors)
    : std::runtime_error(fmt::format("{}: {} error{}:\n  {}", file, errors.size(),
                                     errors.size() == 1 ? "" : "s", fmt::join(errors, "\n  "))),
      errors_(std::move(errors)) {}

std::filesystem::path find_profile(const std::string& name,
                                   const std::vector<std::filesystem::path>& folders) {
  if (std::filesystem::is_regular_file(name)) {
    return name;
  }
  std::string looked_in;
  for (const std::filesystem::path& folder : folders) {
    for (const std::filesystem::path& candidate : {folder / name, folder / (name + ".toml")}) {
      if (std::filesystem::is_regular_file(candidate)) {
        return candidate;
      }
    }
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  throw std::runtime_error(
      fmt::format("profile '{}' not found, neither as a file nor in {}", name, looked_in));
}

ExcavatorMachine load_excavator(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  toml::table document;
  try {
    document = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw ProfileError(file.string(),
                       {fmt::format("line {}, column {}: {}", error.source().begin.line,
                                    error.source().begin.column, error.description())});
  }
  TomlReader reader(document);
  // So far the one kind; another one's keys would only pile up errors.
  static_cast<void>(reader.choice("kind", {"excavator"}));
  if (!reader.errors().empty()) {
    throw ProfileError(file.string(), reader.errors());
  }
  ExcavatorMachine machine;
  machine.name = file.stem().string();
  machine.hash = fnv1a(text);
  machine.profile = read_controller_sections(reader);
  machine.plant = read_plant_sections(reader, machine.profile);
  machine.experiment = read_experiment_sections(reader, machine.profile.dig_path);
  check_across_keys(reader, machine.profile, machine.experiment.air.path);
  reader.refuse_unknown_keys();
  if (!reader.errors().empty()) {
    throw ProfileError(file.string(), reader.errors());
  }
  return machine;
}

}  // namespace graben::machines
