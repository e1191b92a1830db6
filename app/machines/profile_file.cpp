// SPDX-License-Identifier: Apache-2.0
#include "app/machines/profile_document.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/machines/near_word.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::machines {
namespace {

const std::string& kind_name(MachineKind kind) {
  return kind_names()[static_cast<std::size_t>(kind)];
}

constexpr std::string_view kSimulation = ".sim.toml";

std::string read_file(const std::filesystem::path& file) {
  // An empty file can be read; what it lacks is said later.
  return plain_text(file, "a file in TOML");
}

ProfileDocument read_alone(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    return {file, toml::parse(text, file.string())};
  } catch (const toml::parse_error& error) {
    throw ProfileError(file.string(), {syntax_words(text, error)});
  }
}

/// The machine, or the simulated one, that a file is like: of the same folder, else a shipped one.
std::filesystem::path base_file(const std::filesystem::path& file, const std::string& name) {
  const auto in = [&](const std::filesystem::path& folder) {
    const std::filesystem::path machine = folder / (name + ".toml");
    return is_simulation_file(file) ? simulation_file(machine) : machine;
  };
  std::error_code error;
  std::filesystem::path beside = in(file.parent_path());
  if (std::filesystem::is_regular_file(beside, error)) {
    return beside;
  }
  for (const std::filesystem::path& folder : shipped_folders()) {
    if (std::filesystem::is_regular_file(in(folder), error)) {
      return in(folder);
    }
  }
  return beside;
}

/// Throws ProfileError of the file that names it, unless it is another file that is there.
void check_base(const ProfileDocument& document, const std::filesystem::path& base,
                const std::string& name) {
  const auto refuse = [&](const std::string& what) {
    throw ProfileError(document.file.string(),
                       {fmt::format("like (line {}): \"{}\"{}; allowed: the name of another "
                                    "machine's file beside this one or of a shipped one, without "
                                    ".toml",
                                    document.root.get("like")->source().begin.line, name, what)});
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(base, error)) {
    refuse(fmt::format(": there is no {}", base.string()));
  }
  if (std::filesystem::equivalent(base, document.file, error)) {
    refuse(" is this file itself");
  }
}

/// Sections that only the other kind has, where it has none of its own: two hundred keys would be
/// called missing.
void refuse_other_sections(const ProfileDocument& document, TomlReader& reader, MachineKind kind) {
  const toml::table& root = document.root;
  const bool digs = root.contains("boom") && root.contains("arm");
  const bool grades = root.contains("blade") && root.contains("hst");
  const bool is_other = kind == MachineKind::kDozer ? digs && !grades : grades && !digs;
  if (is_other) {
    reader.fail("kind", fmt::format("\"{}\", and the file has {}; is it \"{}\"?", kind_name(kind),
                                    digs ? "[boom] and [arm]" : "[blade] and [hst]",
                                    digs ? "excavator" : "dozer"));
  }
}

MachineKind read_kind(const ProfileDocument& document, TomlReader& reader) {
  const auto kind = static_cast<MachineKind>(reader.choice("kind", kind_names(), kKindHelp));
  throw_errors(document, reader);
  return kind;
}

}  // namespace

const std::vector<std::string>& kind_names() {
  static const std::vector<std::string> names = {"excavator", "dozer"};
  return names;
}

void refuse_other_sort(const ProfileDocument& document, const std::string& wanted) {
  const toml::table& root = document.root;
  const std::string sort = is_simulation_file(document.file)                   ? kSimulationSort
                           : root.contains("receive") || root.contains("send") ? kBusSort
                           : root.contains("area") || root.contains("step")    ? kTaskSort
                           : root.contains("kind")                             ? kMachineSort
                                                                               : wanted;
  if (sort != wanted) {
    throw ProfileError(document.file.string(), {fmt::format("is {}; wanted: {}", sort, wanted)});
  }
}

ProfileError::ProfileError(const std::string& file, std::vector<std::string> errors)
    : std::runtime_error(fmt::format("{}: {} error{}:\n  {}", file, errors.size(),
                                     errors.size() == 1 ? "" : "s", fmt::join(errors, "\n  "))),
      errors_(std::move(errors)) {}

std::filesystem::path find_file(const char* what, const std::string& name,
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
  const std::vector<std::string> there = file_names(folders);
  throw std::runtime_error(fmt::format(
      "{} '{}': there is no such file, nor one of that name in {}{}{}", what, name, looked_in,
      there.empty() ? "" : fmt::format("; wanted: a file or one of {}", fmt::join(there, ", ")),
      near_word_hint(name, there)));
}

std::vector<std::string> file_names(const std::vector<std::filesystem::path>& folders) {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".toml" && !is_simulation_file(entry.path())) {
        names.insert(entry.path().stem().string());
      }
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> simulation_names(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (is_simulation_file(entry.path())) {
      names.insert(entry.path().stem().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

std::filesystem::path find_profile(const std::string& name,
                                   const std::vector<std::filesystem::path>& folders) {
  std::filesystem::path file = find_file("profile", name, folders);
  if (is_simulation_file(file)) {
    throw std::runtime_error(
        fmt::format("{}: describes a simulated machine; the profile is the file beside it without "
                    "'.sim'",
                    file.string()));
  }
  return file;
}

std::filesystem::path simulation_file(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + std::string(kSimulation));
}

bool is_simulation_file(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.size() > kSimulation.size() &&
         name.compare(name.size() - kSimulation.size(), kSimulation.size(), kSimulation) == 0;
}

void lay_over(toml::table& base, toml::table&& differences) {
  for (auto&& [key, node] : differences) {
    toml::table* const inner = node.as_table();
    toml::table* const under = base.get_as<toml::table>(key.str());
    if (inner != nullptr && under != nullptr) {
      lay_over(*under, std::move(*inner));
      continue;
    }
    node.visit(
        [&base, name = key.str()](auto& value) { base.insert_or_assign(name, std::move(value)); });
  }
}

ProfileDocument read_document(const std::filesystem::path& file) {
  return laid_over_base(read_alone(file));
}

std::optional<std::filesystem::path> base_of(const ProfileDocument& document) {
  const auto like = document.root["like"].value<std::string>();
  return like ? std::optional(base_file(document.file, *like)) : std::nullopt;
}

ProfileDocument laid_over_base(ProfileDocument document) {
  const auto like = document.root["like"].value<std::string>();
  if (!like) {
    return document;
  }
  const std::filesystem::path file = document.file;
  const std::filesystem::path base_at = base_file(file, *like);
  check_base(document, base_at, *like);
  ProfileDocument base = read_alone(base_at);
  if (base.root.contains("like")) {
    throw ProfileError(file.string(),
                       {fmt::format("like: {} is like another itself; allowed: one that is not",
                                    base.file.string())});
  }
  lay_over(base.root, std::move(document.root));
  base.file = file;
  return base;
}

std::string syntax_words(const std::string& text, const toml::parse_error& error) {
  const toml::source_position at = error.source().begin;
  std::istringstream lines(text);
  std::string line;
  for (toml::source_index number = 0; number < at.line; ++number) {
    std::getline(lines, line);
  }
  constexpr std::size_t kShown = 60;
  line = line.size() > kShown ? line.substr(0, kShown) + " ..." : line;
  const std::string strange = strange_character(line);
  const bool is_twice = error.description().find("redefine") != std::string_view::npos;
  return fmt::format("line {}, column {}: {}: {}{}", at.line, at.column,
                     is_twice ? "is there for the second time" : "can't be read as TOML", line,
                     strange.empty() ? "" : "; it has " + strange);
}

void require_kind(const ProfileDocument& document, TomlReader& reader, MachineKind kind) {
  const MachineKind found = read_kind(document, reader);
  if (found != kind) {
    reader.fail(
        "kind",
        fmt::format("a machine of kind {}; here it must be {}{}", kind_name(found), kind_name(kind),
                    found == MachineKind::kDozer ? " (a dozer works by graben grade)"
                                                 : " (an excavator digs by graben dig)"));
  } else {
    refuse_other_sections(document, reader, kind);
  }
  throw_errors(document, reader);
}

void read_like(TomlReader& reader) {
  if (reader.has("like")) {
    static_cast<void>(reader.text("like", kLikeHelp));
  }
}

void throw_errors(const ProfileDocument& document, const TomlReader& reader) {
  if (!reader.errors().empty()) {
    throw ProfileError(document.file.string(), reader.errors());
  }
}

MachineKind profile_kind(const ProfileDocument& document) {
  TomlReader reader(document.root, document.file.string());
  return read_kind(document, reader);
}

MachineKind profile_kind(const std::filesystem::path& file) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kMachineSort);
  return profile_kind(document);
}

}  // namespace graben::machines
