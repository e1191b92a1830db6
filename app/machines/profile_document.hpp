#pragma once
/// From a file to a machine, whatever its kind.

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/machines/profile_file.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {

struct ProfileDocument {
  std::filesystem::path file;
  std::uint32_t hash = 0;  ///< FNV-1a of the file's bytes.
  toml::table root;
};

/// Throws std::runtime_error if the file can't be read, ProfileError if it is not TOML.
[[nodiscard]] ProfileDocument read_document(const std::filesystem::path& file);

/// What the file says it is. Throws ProfileError if it does not, or names no kind of ours.
[[nodiscard]] MachineKind read_kind(const ProfileDocument& document, TomlReader& reader);
[[nodiscard]] MachineKind profile_kind(const ProfileDocument& document);

/// Throws ProfileError if it is a machine of another kind: its keys would only pile up errors.
void require_kind(const ProfileDocument& document, TomlReader& reader, MachineKind kind);

/// Throws ProfileError if the reader has found any.
void throw_errors(const ProfileDocument& document, const TomlReader& reader);

/// A machine of this kind; `read(reader, machine)` fills it from its sections and checks it. No key
/// may be left over. Throws as the above, with every error found.
template <class Machine, class Read>
[[nodiscard]] Machine load_machine(const ProfileDocument& document, MachineKind kind, Read&& read) {
  TomlReader reader(document.root);
  require_kind(document, reader, kind);
  Machine machine;
  machine.name = document.file.stem().string();
  machine.hash = document.hash;
  read(reader, machine);
  reader.refuse_unknown_keys();
  throw_errors(document, reader);
  return machine;
}

}  // namespace graben::machines
