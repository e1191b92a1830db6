// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/data_sheet.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKinds[] = {"", "_ls", "_nfc"};
/// The shipped machine whose pump drives a swing motor, and its weight.
constexpr const char* kWithSwing = "excavator_12t";
constexpr double kWithSwing_t = 12.0;

const toml::table* table_at(const toml::table& root, const std::string& path) {
  return root.at_path(path).as_table();
}

int pump_count(const ProfileDocument& like) {
  const toml::array* pumps = like.root["pump"].as_array();
  return pumps == nullptr ? 0 : static_cast<int>(pumps->size());
}

int pump_kind(const ProfileDocument& like) {
  const std::string kind = like.root.at_path("pump[0].kind").value_or(std::string("positive"));
  return kind == "load_sensing" ? 1 : kind == "negative_flow" ? 2 : 0;
}

bool has_swing(const ProfileDocument& like) {
  return like.root.at_path("valve.pump.swing").node() != nullptr;
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

void scale(toml::table& table, const char* key, double factor) {
  toml::node* node = table.get(key);
  if (node == nullptr) {
    return;
  }
  if (toml::array* array = node->as_array()) {
    for (toml::node& entry : *array) {
      entry.as_floating_point()->get() *= factor;
    }
  } else if (toml::value<double>* number = node->as_floating_point()) {
    number->get() *= factor;
  }
}

/// The same flow of all of them, by another number.
void set_pump_count(toml::table& root, int count) {
  toml::array& pumps = *root["pump"].as_array();
  const double factor = static_cast<double>(pumps.size()) / count;
  toml::table pump = *pumps.get(0)->as_table();
  for (const char* key : {"displacement", "leak_linear", "leak_quadratic", "bypass_series"}) {
    scale(pump, key, factor);
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
    scale(*bypass, "open", factor);
  }
}

/// What a table lacks of another's keys whose name begins with swing.
void take_swing_keys(const toml::table& from, toml::table& into) {
  for (auto&& [key, node] : from) {
    if (std::string(key.str()).rfind("swing", 0) == 0 && !into.contains(key.str())) {
      node.visit([&, name = key.str()](const auto& value) { into.insert(name, value); });
    }
  }
}

void take_table(const toml::table& from, toml::table& into) {
  for (auto&& [key, node] : from) {
    if (!into.contains(key.str())) {
      node.visit([&, name = key.str()](const auto& value) { into.insert(name, value); });
    }
  }
}

/// By the machines' weights: torque and what turns grow faster than areas and flows.
void add_swing(toml::table& root, double weights) {
  const ProfileDocument other = read_document(find_profile(kWithSwing));
  const toml::table& from = other.root;
  toml::table swing = *table_at(from, "swing");
  scale(swing, "displacement", weights);
  scale(swing, "inertia", std::pow(weights, 5.0 / 3.0));
  take_table(swing, *root["swing"].as_table());
  for (const char* section : {"control", "safety"}) {
    take_swing_keys(*table_at(from, section), *root[section].as_table());
  }
  toml::table& valve = *root["valve"].as_table();
  toml::array areas = *from.at_path("valve.swing").as_array();
  for (toml::node& area : areas) {
    area.as_floating_point()->get() *= weights;
  }
  valve.insert_or_assign("swing", areas);
  valve["pump"].as_table()->insert_or_assign("swing", 1);
  if (toml::table* closed = root.at_path("valve.bypass.closed").as_table()) {
    closed->insert_or_assign("swing", closed->get("boom")->value_or(5.6e-7));
  }
}

void remove_swing(toml::table& root) {
  for (const char* key : {"displacement", "inertia", "lever", "range"}) {
    root["swing"].as_table()->erase(key);
  }
  for (const char* section : {"control", "safety"}) {
    toml::table& table = *root[section].as_table();
    for (auto it = table.begin(); it != table.end();) {
      const bool is_swings = std::string(it->first.str()).rfind("swing", 0) == 0;
      it = is_swings ? table.erase(it) : ++it;
    }
  }
  root["valve"].as_table()->erase("swing");
  for (const char* path : {"valve.pump", "valve.bypass.closed"}) {
    if (toml::table* table = root.at_path(path).as_table()) {
      table->erase("swing");
    }
  }
}

/// The experiment's line before a machine that can't swing, as far out as it was.
void lay_straight(toml::table& root) {
  for (const char* end : {"experiment.line.from.position", "experiment.line.to.position"}) {
    toml::array* at = root.at_path(end).as_array();
    if (at == nullptr || at->size() != 3) {
      continue;
    }
    const double out_m = std::hypot(at->get(0)->value_or(0.0), at->get(1)->value_or(0.0));
    at->get(0)->as_floating_point()->get() = out_m;
    at->get(1)->as_floating_point()->get() = 0.0;
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
    add_swing(made.root, weight_t(like) / kWithSwing_t);
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
  if (profile_kind(like) == MachineKind::kDozer || has_swing(structured) == has_swing(like)) {
    return made;
  }
  toml::table& sensors = *made.root["sensors"].as_table();
  if (!has_swing(structured)) {
    made.root.erase("swing");
    sensors.erase("swing_resolution");
    sensors.erase("swing_bias");
    lay_straight(made.root);
    return made;
  }
  const double weights = weight_t(like) / kWithSwing_t;
  const ProfileDocument other = read_document(simulation_file(find_profile(kWithSwing)));
  toml::table swing = *table_at(other.root, "swing");
  scale(swing, "inertia", std::pow(weights, 5.0 / 3.0));
  for (const char* key : {"coulomb", "viscous", "dead_volume", "leak"}) {
    scale(swing, key, weights);
  }
  made.root.insert_or_assign("swing", swing);
  take_swing_keys(*table_at(other.root, "sensors"), sensors);
  return made;
}

}  // namespace graben::machines
