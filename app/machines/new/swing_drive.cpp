// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/swing_drive.hpp"

#include <cmath>
#include <string>

#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

/// The shipped machine whose pump drives a swing motor, and its weight.
constexpr const char* kWithSwing = "excavator_12t";
constexpr double kWithSwing_t = 12.0;

const toml::table* table_at(const toml::table& root, const std::string& path) {
  return root.at_path(path).as_table();
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

}  // namespace

bool has_swing(const ProfileDocument& like) {
  return like.root.at_path("valve.pump.swing").node() != nullptr;
}

void scale_values(toml::table& table, const char* key, double factor) {
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

void add_swing(toml::table& root, double weight_t) {
  const double weights = weight_t / kWithSwing_t;
  const ProfileDocument other = read_document(find_profile(kWithSwing));
  const toml::table& from = other.root;
  toml::table swing = *table_at(from, "swing");
  scale_values(swing, "displacement", weights);
  scale_values(swing, "inertia", std::pow(weights, 5.0 / 3.0));
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

void add_simulated_swing(toml::table& root, double weight_t) {
  const double weights = weight_t / kWithSwing_t;
  const ProfileDocument other = read_document(simulation_file(find_profile(kWithSwing)));
  toml::table swing = *table_at(other.root, "swing");
  scale_values(swing, "inertia", std::pow(weights, 5.0 / 3.0));
  for (const char* key : {"coulomb", "viscous", "dead_volume", "leak"}) {
    scale_values(swing, key, weights);
  }
  root.insert_or_assign("swing", swing);
  take_swing_keys(*table_at(other.root, "sensors"), *root["sensors"].as_table());
}

void remove_simulated_swing(toml::table& root) {
  root.erase("swing");
  for (const char* key : {"swing_resolution", "swing_bias"}) {
    root["sensors"].as_table()->erase(key);
  }
  lay_straight(root);
}

}  // namespace graben::machines
