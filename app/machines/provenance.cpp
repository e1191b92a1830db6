// SPDX-License-Identifier: Apache-2.0
#include "app/machines/provenance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

constexpr const char* kSection = "provenance";
constexpr const char* kAllowed = "allowed: { deviation = 0 or more, from = \"text\" }";

/// What is wrong with a path; empty if it leads to a value.
std::string wrong_with(const toml::node* named) {
  if (named == nullptr) {
    return "the profile has no such key";
  }
  const toml::array* array = named->as_array();
  const bool is_section =
      named->is_table() || (array != nullptr && !array->empty() && array->get(0)->is_table());
  return is_section ? "is a section; allowed: a key with a value" : "";
}

bool is_deviation(const toml::node& node) {
  const double value = node.value<double>().value_or(-1.0);
  return node.is_number() && std::isfinite(value) && value >= 0.0;
}

/// Texts and truth values have no deviation.
bool may_deviate(const toml::node& named) { return named.is_number() || named.is_array(); }

}  // namespace

std::vector<Provenance> TomlReader::provenance() {
  std::vector<Provenance> all;
  if (!has(kSection)) {
    return all;
  }
  known_.insert(kSection);
  keys_.push_back({"provenance.\"KEY\".deviation", "number", "0 and more", "as KEY", "",
                   "standard deviation of the value at this key path of the profile"});
  keys_.push_back({"provenance.\"KEY\".from", "text", "", "", "",
                   "where that value is from: log and its hash, date, method"});
  const toml::node* section = root_.at_path(kSection).node();
  if (section != nullptr && !section->is_table()) {
    fail(kSection, "must be a section");
  } else if (section != nullptr) {
    for (const auto& [name, told] : *section->as_table()) {
      all.push_back(provenance_of(std::string(name.str()), told));
    }
  }
  return all;
}

Provenance TomlReader::provenance_of(const std::string& key, const toml::node& told) {
  Provenance entry{key, std::nullopt, ""};
  const std::string at = fmt::format("provenance.\"{}\"", key);
  const auto refuse = [&](const std::string& what) {
    errors_.push_back(fmt::format("{} ({}): {}", at, place(told), what));
  };
  const toml::node* named = root_.at_path(key).node();
  const toml::table* parts = told.as_table();
  if (const std::string wrong = wrong_with(named); !wrong.empty()) {
    refuse(wrong);
    return entry;
  }
  if (parts == nullptr || parts->empty()) {
    refuse(fmt::format("says nothing; {}", kAllowed));
    return entry;
  }
  for (const auto& [part, value] : *parts) {
    if (part.str() == "deviation" && is_deviation(value)) {
      if (!may_deviate(*named)) {
        refuse("deviation; the value at this key is no number");
      }
      entry.deviation = value.value<double>();
      note(at + ".deviation", {*entry.deviation});
    } else if (part.str() == "from" && value.is_string()) {
      entry.from = value.value<std::string>().value_or("");
      note(at + ".from", {entry.from.begin(), entry.from.end()});
    } else {
      refuse(fmt::format("{}; {}", std::string(part.str()), kAllowed));
    }
  }
  return entry;
}

}  // namespace graben::machines
