// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/data_sheet.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "app/machines/new/swing_drive.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKinds[] = {"", "_ls", "_nfc"};
int pump_count(const ProfileDocument& like) {
  const toml::array* pumps = like.root["pump"].as_array();
  return pumps == nullptr ? 0 : static_cast<int>(pumps->size());
}

int pump_kind(const ProfileDocument& like) {
  const std::string kind = like.root.at_path("pump[0].kind").value_or(std::string("positive"));
  return kind == "load_sensing" ? 1 : kind == "negative_flow" ? 2 : 0;
}

/// By its name, as excavator_22t; else by its links, which are a sixth of it.
double weight_t(const ProfileDocument& like) {
  if (const auto mass_kg = like.root.at_path("body.mass").value<double>()) {
    return *mass_kg * 1e-3;
  }
  const std::string name = like.file.stem().string();
  const std::size_t bar = name.find('_');
  char* end = nullptr;
  const double named = bar == std::string::npos ? 0.0 : std::strtod(&name[bar + 1], &end);
  if (named > 0.0 && *end == 't') {
    return named;
  }
  double links_kg = 0.0;
  if (const toml::array* masses = like.root.at_path("oil.mass").as_array()) {
    for (const toml::node& mass : *masses) {
      links_kg += mass.value_or(0.0);
    }
  }
  return std::round(6e-2 * links_kg) * 0.1;
}

int told(const ProfileAnswers& answers, const char* key, int otherwise) {
  const auto found = answers.find(key);
  return found == answers.end() ? otherwise : static_cast<int>(std::lround(found->second.front()));
}

/// The same flow of all of them, by another number.
void set_pump_count(toml::table& root, int count) {
  toml::array& pumps = *root["pump"].as_array();
  const double factor = static_cast<double>(pumps.size()) / count;
  toml::table pump = *pumps.get(0)->as_table();
  for (const char* key : {"displacement", "leak_linear", "leak_quadratic", "bypass_series"}) {
    scale_values(pump, key, factor);
  }
  pumps.clear();
  for (int i = 0; i < count; ++i) {
    pumps.push_back(pump);
  }
  toml::table& fed = *root.at_path("valve.pump").as_table();
  for (auto&& [drive, number] : fed) {
    const bool is_first = drive == "arm" || drive == "swing";
    *number.as_integer() = is_first || count == 1 ? 1 : 2;
  }
  if (toml::table* bypass = root.at_path("valve.bypass").as_table()) {
    scale_values(*bypass, "open", factor);
  }
}

/// The profile of the same machine with pumps of this kind.
fs::path file_of_kind(const ProfileDocument& like, int kind) {
  std::string stem = like.file.stem().string();
  for (const char* suffix : {"_ls", "_nfc"}) {
    const std::size_t length = std::string(suffix).size();
    if (stem.size() > length && stem.compare(stem.size() - length, length, suffix) == 0) {
      stem.resize(stem.size() - length);
    }
  }
  fs::path file = like.file.parent_path() / (stem + kKinds[kind] + ".toml");
  if (!fs::is_regular_file(file)) {
    throw std::runtime_error(
        fmt::format("pump_kind: there is no {} to take such pumps from; allowed: --like with a "
                    "shipped excavator",
                    file.filename().string()));
  }
  return file;
}

}  // namespace

std::vector<ProfileQuestion> sheet_questions(const ProfileDocument& like) {
  std::vector<ProfileQuestion> questions = {
      {kWeightKey,
       "operating weight; masses, inertia and what hangs on them follow",
       {"t", 1e3},
       {weight_t(like)},
       0.5,
       1000.0}};
  if (profile_kind(like) == MachineKind::kDozer) {
    const std::optional<ProfileDocument> simulation = simulation_of(like, like);
    const auto width_m =
        simulation ? simulation->root.at_path("blade.width").value<double>() : std::nullopt;
    if (width_m) {
      questions.push_back({kBladeWidthKey,
                           "of the blade, end to end of its edge",
                           {"mm", 1e-3},
                           {1e3 * *width_m},
                           500.0,
                           10000.0});
    }
    return questions;
  }
  questions.push_back({kPumpCountKey,
                       "main pumps; of two the first feeds arm and swing",
                       {"pumps", 1.0},
                       {static_cast<double>(pump_count(like))},
                       1.0,
                       2.0});
  questions.push_back({kPumpKindKey,
                       "who sets their swash: 0 the controller, 1 load sensing, 2 negative flow "
                       "control",
                       {"kind", 1.0},
                       {static_cast<double>(pump_kind(like))},
                       0.0,
                       2.0});
  questions.push_back({kSwingKey,
                       "whether one of these pumps drives the swing: 1; a circuit of its own: 0",
                       {"yes(1)/no(0)", 1.0},
                       {has_swing(like) ? 1.0 : 0.0},
                       0.0,
                       1.0});
  return questions;
}

ProfileDocument with_structure(const ProfileDocument& like, const ProfileAnswers& answers) {
  if (profile_kind(like) == MachineKind::kDozer) {
    return like;
  }
  const int kind = told(answers, kPumpKindKey, pump_kind(like));
  ProfileDocument made = kind == pump_kind(like) ? like : read_document(file_of_kind(like, kind));
  const int count = told(answers, kPumpCountKey, pump_count(made));
  const bool swings = told(answers, kSwingKey, has_swing(made) ? 1 : 0) == 1;
  if (swings && !has_swing(made)) {
    add_swing(made.root, weight_t(like));
  } else if (!swings && has_swing(made)) {
    remove_swing(made.root);
  }
  if (count != pump_count(made)) {
    set_pump_count(made.root, count);
  }
  made.file = like.file;
  return made;
}

std::optional<ProfileDocument> simulation_of(const ProfileDocument& like,
                                             const ProfileDocument& structured) {
  const fs::path file = simulation_file(like.file);
  if (!fs::is_regular_file(file)) {
    return std::nullopt;
  }
  ProfileDocument made = read_document(file);
  made.root.erase("like");
  if (made.root.contains("machine")) {
    return std::nullopt;
  }
  if (profile_kind(like) == MachineKind::kExcavator && has_swing(structured) != has_swing(like)) {
    if (has_swing(structured)) {
      add_simulated_swing(made.root, weight_t(like));
    } else {
      remove_simulated_swing(made.root);
    }
  }
  return made;
}

}  // namespace graben::machines
