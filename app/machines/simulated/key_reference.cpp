// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/key_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>
#include <vector>

#include "app/machines/answer_section.hpp"
#include "app/machines/axis_names.hpp"
#include "app/machines/dozer_sections.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/profile_document.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"

namespace graben::machines {
namespace {

/// A key, or those of several drives that are alike.
struct Row {
  KeyEntry entry;
  bool required = true;
  std::string pattern;              ///< The key with '*' for the drive.
  std::vector<std::string> drives;  ///< In their order; none where the key has no drive.
};

bool is_same(const Row& a, const Row& b) {
  const auto told = [](const Row& row) {
    const KeyEntry& e = row.entry;
    return std::tie(row.pattern, row.required, e.type, e.allowed, e.unit, e.fallback, e.help);
  };
  return told(a) == told(b);
}

/// "boom.cylinder.bore" as "*.cylinder.bore" of the boom.
Row row_of(const KeyEntry& entry, bool required) {
  Row row{entry, required, "", {}};
  std::string rest = entry.key + ".";
  for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
    const std::string part = rest.substr(0, dot);
    rest.erase(0, dot + 1);
    const bool is_drive =
        std::find(kDriveNames.begin(), kDriveNames.end(), part) != kDriveNames.end();
    if (is_drive) {
      row.drives.push_back(part);
    }
    row.pattern += (row.pattern.empty() ? "" : ".") + (is_drive ? std::string("*") : part);
  }
  return row;
}

const KeyEntry* find(const std::vector<KeyEntry>& entries, const std::string& key) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const KeyEntry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

using Read = std::function<void(TomlReader&)>;

/// Every key that is asked for with all optional ones there or with none; those alone are required
/// that are asked for either way.
std::vector<Row> rows_of(const Read& read) {
  TomlReader all = TomlReader::listing(true);
  TomlReader none = TomlReader::listing(false);
  read(all);
  read(none);
  std::vector<KeyEntry> entries = all.keys();
  std::string before;
  for (const KeyEntry& entry : none.keys()) {
    if (find(entries, entry.key) == nullptr) {
      const auto place = std::find_if(entries.begin(), entries.end(),
                                      [&](const KeyEntry& other) { return other.key == before; });
      entries.insert(place == entries.end() ? place : place + 1, entry);
    }
    before = entry.key;
  }
  std::vector<Row> rows;
  for (const KeyEntry& entry : entries) {
    const bool required = entry.fallback.empty() && find(all.keys(), entry.key) != nullptr &&
                          find(none.keys(), entry.key) != nullptr;
    Row row = row_of(entry, required);
    const auto alike = std::find_if(rows.begin(), rows.end(),
                                    [&](const Row& other) { return is_same(row, other); });
    if (alike != rows.end() && !row.drives.empty()) {
      alike->drives.insert(alike->drives.end(), row.drives.begin(), row.drives.end());
    } else {
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string key_text(const Row& row) {
  std::string key = row.pattern;
  const std::size_t star = key.find('*');
  if (star != std::string::npos) {
    key.replace(star, 1,
                row.drives.size() == 1 ? row.drives.front()
                                       : fmt::format("{{{}}}", fmt::join(row.drives, ", ")));
  }
  const std::size_t index = key.find("[0]");
  return index == std::string::npos ? key : key.replace(index, 3, "[]");
}

std::string allowed_text(const KeyEntry& entry) {
  if (entry.type == "number" || entry.type == "one of") {
    return entry.allowed;
  }
  return entry.type + (entry.allowed.empty() ? "" : ", " + entry.allowed);
}

/// "{boom, arm}" of "{boom, arm}.length"; of a key without a section itself.
std::string section_of(const std::string& key) {
  const std::size_t brace = key.front() == '{' ? key.find('}') : 0;
  return key.substr(0, key.find_first_of(".[", brace));
}

void add_file(std::string& text, const char* title, const Read& read) {
  const std::vector<Row> rows = rows_of(read);
  std::vector<std::string> sections;
  for (const Row& row : rows) {
    const std::string section = section_of(key_text(row));
    if (std::find(sections.begin(), sections.end(), section) == sections.end()) {
      sections.push_back(section);
    }
  }
  text += fmt::format(
      "\n## {}\n\n| key | meaning | unit | allowed | default |\n|---|---|---|---|---|\n", title);
  for (const std::string& section : sections) {
    for (const Row& row : rows) {
      const std::string key = key_text(row);
      if (section_of(key) == section) {
        const KeyEntry& entry = row.entry;
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key, entry.help, entry.unit,
                            allowed_text(entry),
                            row.required             ? "required"
                            : entry.fallback.empty() ? "optional"
                                                     : entry.fallback);
      }
    }
  }
}

/// The reader of a simulated machine looks at the path of its machine.
SimulatedExcavator with_path() {
  SimulatedExcavator machine;
  machine.profile.dig_path = {0.0, 2.0, 0.0, 2.0, 0.5, 0.0, 0.0};
  machine.profile.drive_count = kDriveCount;
  return machine;
}

void read_kind(TomlReader& reader) {
  static_cast<void>(reader.choice("kind", kind_names(), kKindHelp));
  read_like(reader);
}

}  // namespace

std::string key_reference() {
  std::string text =
      "# Keys of profiles and tasks\n\nMade by `graben check --keys` of what the readers ask for. "
      "All "
      "values are in SI units; a wrong or unknown key is an\nerror. A key that is *optional* "
      "stands "
      "with others or instead of them, as its meaning says.\n";
  add_file(text, "An excavator: NAME.toml", [](TomlReader& reader) {
    read_kind(reader);
    const ExcavatorProfile profile = read_excavator_sections(reader);
    static_cast<void>(read_driven(reader, kDriveCount));
    static_cast<void>(reader.provenance());
    check_excavator_across_keys(reader, profile);
  });
  add_file(text, "An excavator's simulation: NAME.sim.toml", [](TomlReader& reader) {
    read_kind(reader);
    SimulatedExcavator machine = with_path();
    read_simulated_sections(reader, machine);
  });
  add_file(text, "A dozer: NAME.toml", [](TomlReader& reader) {
    read_kind(reader);
    const DozerProfile profile = read_dozer_sections(reader);
    static_cast<void>(reader.provenance());
    check_dozer_across_keys(reader, profile);
  });
  add_file(text, "A dozer's simulation: NAME.sim.toml", [](TomlReader& reader) {
    read_kind(reader);
    SimulatedDozer machine;
    read_simulated_sections(reader, machine);
  });
  const ExcavatorProfile machine = with_path().profile;
  add_file(text, "A task in steps, of an excavator",
           [&](TomlReader& reader) { static_cast<void>(read_step_task(reader, machine, {})); });
  add_file(text, "A task that is an area",
           [&](TomlReader& reader) { static_cast<void>(read_area_task(reader, machine)); });
  return text;
}

}  // namespace graben::machines
