// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From a file to a machine, whatever its kind.

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/machines/profile_file.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {

struct ProfileDocument {
  std::filesystem::path file;
  toml::table root;
};

/// In the order of MachineKind.
[[nodiscard]] const std::vector<std::string>& kind_names();
inline constexpr const char* kKindHelp = "which controller; the same in both files";
inline constexpr const char* kLikeHelp =
    "name of another machine's file beside this one, or of a shipped one, which holds but for what "
    "this one says; "
    "arrays, those of tables too, are taken or replaced as a whole";

/// Lays differences over a document: tables key by key, everything else as a whole. Moved, so that
/// each value keeps its line.
void lay_over(toml::table& base, toml::table&& differences);

/// Of a file that says `like = "NAME"`, what NAME.toml beside it says but for what the file itself
/// does; of NAME.sim.toml the same. Throws std::runtime_error if a file can't be read, ProfileError
/// if it is not TOML, or like one that is not there, is itself or is like another.
[[nodiscard]] ProfileDocument read_document(const std::filesystem::path& file);

/// The same of what has been read already, as of `document.file`, which need not be there.
[[nodiscard]] ProfileDocument laid_over_base(ProfileDocument document);

/// File that it says to be like; none where it says so of none.
[[nodiscard]] std::optional<std::filesystem::path> base_of(const ProfileDocument& document);

/// Why a text is not TOML, with its place and the line that is meant.
[[nodiscard]] std::string syntax_words(const std::string& text, const toml::parse_error& error);

inline constexpr const char* kMachineSort = "a machine's profile";
inline constexpr const char* kSimulationSort = "a simulated machine's file";
inline constexpr const char* kBusSort = "a bus profile";
inline constexpr const char* kTaskSort = "a task";
/// Throws ProfileError where a file is one of ours, but of another of these sorts than
/// `wanted`: its keys would only pile up errors.
void refuse_other_sort(const ProfileDocument& document, const std::string& wanted);

/// As of a file.
[[nodiscard]] MachineKind profile_kind(const ProfileDocument& document);

/// Throws ProfileError if it is a machine of another kind: its keys would only pile up errors.
void require_kind(const ProfileDocument& document, TomlReader& reader, MachineKind kind);

/// Throws ProfileError if the reader has found any.
void throw_errors(const ProfileDocument& document, const TomlReader& reader);

/// Knows the key `like`, which read_document has looked at.
void read_like(TomlReader& reader);

/// Reads a file of this kind; `read(reader)` asks for its sections and checks them. No key may be
/// left over. Throws as the above, with every error found. Returns the hash of what was read.
template <class Read>
std::uint32_t read_as(const ProfileDocument& document, MachineKind kind, Read&& read) {
  TomlReader reader(document.root, document.file.string());
  require_kind(document, reader, kind);
  read_like(reader);
  read(reader);
  reader.refuse_unknown_keys();
  throw_errors(document, reader);
  return reader.hash();
}

}  // namespace graben::machines
