// SPDX-License-Identifier: Apache-2.0
#include "app/machines/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "app/machines/near_word.hpp"
#include "app/machines/unit_hint.hpp"

namespace graben::machines {
namespace {

std::string ends(const Range& range) { return fmt::format("{} .. {}", range.least, range.most); }

std::string allowed(const Range& range) {
  const std::string unit = range.unit[0] == '\0' ? "" : fmt::format(" {}", range.unit);
  return fmt::format("allowed: {}{}", ends(range), unit);
}

/// As it was written: 6.2, not 6.2000000000000002.
std::string value_text(const toml::node& node) {
  if (const toml::value<double>* number = node.as_floating_point()) {
    const std::string digits = fmt::format("{}", number->get());
    return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

bool is_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && array->is_homogeneous(toml::node_type::table);
}

/// FNV-1a, a byte after the other.
class Hash {
 public:
  void add(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 16777619u; }
  void add(const std::string& text) {
    for (const char c : text) {
      add(static_cast<std::uint8_t>(c));
    }
    add(std::uint8_t{0});
  }
  /// Its IEEE 754 bits, the low ones first.
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; ++i) {
      add(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }
  [[nodiscard]] std::uint32_t value() const { return hash_; }

 private:
  std::uint32_t hash_ = 2166136261u;
};

}  // namespace

TomlReader TomlReader::listing(bool has) {
  static const toml::table nothing;
  TomlReader reader(nothing);
  reader.listed_has_ = has;
  return reader;
}

std::string TomlReader::place(const toml::node& node) const {
  const toml::source_region& source = node.source();
  const bool is_other = !file_.empty() && source.path != nullptr && *source.path != file_;
  return is_other ? fmt::format("line {} of {}", source.begin.line, *source.path)
                  : fmt::format("line {}", source.begin.line);
}

bool TomlReader::has(const std::string& key) const {
  return listed_has_.value_or(root_.at_path(key).node() != nullptr);
}

/// Nothing, and an error, unless it may be left out.
const toml::node* TomlReader::find(KeyEntry entry) {
  const std::string key = entry.key;
  const bool may_lack = listed_has_.has_value() || !entry.fallback.empty();
  if (known_.insert(key).second) {
    keys_.push_back(std::move(entry));
  }
  const toml::node* node = root_.at_path(key).node();
  if (node == nullptr && !may_lack && !is_in_no_table(key)) {
    errors_.push_back(fmt::format("{}: missing", key));
  }
  return node;
}

/// What stands where one of its tables should is refused as a whole.
bool TomlReader::is_in_no_table(const std::string& key) const {
  for (std::size_t end = key.find_first_of(".["); end != std::string::npos;
       end = key.find_first_of(".[", end + 1)) {
    const toml::node* node = root_.at_path(key.substr(0, end)).node();
    if (node != nullptr && !(key[end] == '.' ? node->is_table() : is_tables(*node))) {
      return true;
    }
  }
  return false;
}

bool TomlReader::knows_keys_in(const std::string& opened) const {
  const auto next = known_.lower_bound(opened);
  return next != known_.end() && next->compare(0, opened.size(), opened) == 0;
}

void TomlReader::note(const std::string& key, std::vector<double> values) {
  for (double& value : values) {
    value += 0.0;  // -0.0 is 0.0.
  }
  values_[key] = std::move(values);
}

std::uint32_t TomlReader::hash() const {
  Hash hash;
  for (const auto& [key, values] : values_) {
    hash.add(key);
    hash.add(static_cast<double>(values.size()));
    for (const double value : values) {
      hash.add(value);
    }
  }
  return hash.value();
}

/// Of the same key, or against a number beside it in its table: judged by a value that is none.
bool TomlReader::follows_from_another(const std::string& key, const std::string& what) const {
  const std::size_t dot = key.rfind('.');
  const std::string table = dot == std::string::npos ? "" : key.substr(0, dot + 1);
  const auto says = [&](const char* words) { return what.find(words) != std::string::npos; };
  const bool compares = !table.empty() && (says("than ") || says("at most") || says("at least"));
  return std::any_of(unread_.begin(), unread_.end(), [&](const std::string& other) {
    return other == key || other.compare(0, key.size() + 1, key + "[") == 0 ||
           (compares && other.compare(0, table.size(), table) == 0);
  });
}

void TomlReader::fail(const std::string& key, const std::string& what) {
  if (listed_has_.has_value() || follows_from_another(key, what)) {
    return;
  }
  const toml::node* node = root_.at_path(key).node();
  const std::string at = node != nullptr ? fmt::format(" ({})", place(*node)) : "";
  errors_.push_back(fmt::format("{}{}: {}", key, at, what));
}

double TomlReader::checked(const toml::node& node, const std::string& key, const Range& range) {
  const auto refuse = [&](const std::string& what) {
    errors_.push_back(fmt::format("{} ({}): {} {}; {}", key, place(node), value_text(node), what,
                                  allowed(range)));
    unread_.insert(key);
    return std::clamp(0.0, range.least, range.most);
  };
  if (!node.is_number()) {
    return refuse("is not a number");
  }
  const double value = node.value<double>().value_or(std::nan(""));
  if (!std::isfinite(value)) {
    return refuse("is not finite");
  }
  if (value < range.least || value > range.most) {
    refuse("is out of range");
    errors_.back() += unit_hint(value, range.least, range.most, range.unit);
    return std::clamp(0.0, range.least, range.most);
  }
  return value;
}

double TomlReader::number(const std::string& key, const Range& range, const char* help) {
  const toml::node* node = find({key, "number", ends(range), range.unit, "", help});
  const double value =
      node != nullptr ? checked(*node, key, range) : std::clamp(0.0, range.least, range.most);
  note(key, {value});
  return value;
}

double TomlReader::number_or(double fallback, const std::string& key, const Range& range,
                             const char* help) {
  const toml::node* node =
      find({key, "number", ends(range), range.unit, fmt::format("{}", fallback), help});
  const double value = node != nullptr ? checked(*node, key, range) : fallback;
  note(key, {value});
  return value;
}

int TomlReader::integer(const std::string& key, int least, int most, const char* help) {
  const toml::node* node =
      find({key, "whole number", fmt::format("{} .. {}", least, most), "", "", help});
  if (node == nullptr) {
    return least;
  }
  return whole(*node, key, least, most);
}

int TomlReader::integer_or(int fallback, const std::string& key, int least, int most,
                           const char* help) {
  const toml::node* node = find({key, "whole number", fmt::format("{} .. {}", least, most), "",
                                 fmt::format("{}", fallback), help});
  if (node == nullptr) {
    note(key, {static_cast<double>(fallback)});
    return fallback;
  }
  return whole(*node, key, least, most);
}

int TomlReader::whole(const toml::node& node, const std::string& key, int least, int most) {
  if (!node.is_integer()) {
    fail(key,
         fmt::format("{} is not a whole number; allowed: {} .. {}", value_text(node), least, most));
    return least;
  }
  const double value =
      checked(node, key, {static_cast<double>(least), static_cast<double>(most), ""});
  note(key, {value});
  return static_cast<int>(value);
}

bool TomlReader::boolean_or(bool fallback, const std::string& key, const char* help) {
  const toml::node* node =
      find({key, "truth value", "true, false", "", fallback ? "true" : "false", help});
  if (node != nullptr && !node->is_boolean()) {
    fail(key, fmt::format("{}; allowed: true, false", value_text(*node)));
  }
  const bool value = node != nullptr ? node->value<bool>().value_or(fallback) : fallback;
  note(key, {value ? 1.0 : 0.0});
  return value;
}

std::string TomlReader::text(const std::string& key, const char* help) {
  const toml::node* node = find({key, "text", "", "", "", help});
  if (node == nullptr) {
    return "";
  }
  if (!node->is_string()) {
    fail(key, fmt::format("{} is not a text", value_text(*node)));
    return "";
  }
  const std::string value = node->value<std::string>().value_or("");
  note(key, {value.begin(), value.end()});
  return value;
}

int TomlReader::choice(const std::string& key, const std::vector<std::string>& allowed_values,
                       const char* help) {
  const toml::node* node =
      find({key, "one of", fmt::format("{}", fmt::join(allowed_values, ", ")), "", "", help});
  if (node == nullptr) {
    return 0;
  }
  const auto found = std::find(allowed_values.begin(), allowed_values.end(),
                               node->value<std::string>().value_or(""));
  if (found == allowed_values.end()) {
    fail(key, fmt::format("{}; allowed: {}", value_text(*node), fmt::join(allowed_values, ", ")));
    return 0;
  }
  note(key, {found->begin(), found->end()});
  return static_cast<int>(found - allowed_values.begin());
}

std::vector<double> TomlReader::numbers(const std::string& key, const Range& range,
                                        std::size_t count, const char* help) {
  std::vector<double> values(count, std::clamp(0.0, range.least, range.most));
  const toml::node* node =
      find({key, fmt::format("{} numbers", count), ends(range), range.unit, "", help});
  if (node == nullptr) {
    return values;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != count) {
    fail(key, fmt::format("must be an array of {} numbers; {}", count, allowed(range)));
    return values;
  }
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = checked(*array->get(i), fmt::format("{}[{}]", key, i), range);
  }
  note(key, values);
  return values;
}

Eigen::Vector2d TomlReader::point(const std::string& key, const Range& range, const char* help) {
  const std::vector<double> values = numbers(key, range, 2, help);
  return {values[0], values[1]};
}

std::vector<std::pair<double, double>> TomlReader::pairs(const std::string& key, const Range& first,
                                                         const Range& second, std::size_t least,
                                                         std::size_t most, const char* help) {
  std::vector<std::pair<double, double>> values;
  const std::string units =
      std::string(first.unit) + (first.unit[0] == '\0' ? "" : ", ") + second.unit;
  const toml::node* node = find(
      {key,
       least == most ? fmt::format("{} pairs", least) : fmt::format("{} to {} pairs", least, most),
       fmt::format("{}; {}", ends(first), ends(second)), units, "", help});
  if (node == nullptr) {
    return values;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() < least || array->size() > most) {
    fail(key, fmt::format("must be an array of {} to {} pairs", least, most));
    return values;
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::vector<std::string> names = {fmt::format("{}[{}][0]", key, i),
                                            fmt::format("{}[{}][1]", key, i)};
    const toml::array* pair = array->get(i)->as_array();
    if (pair == nullptr || pair->size() != 2) {
      fail(key, fmt::format("entry {} is not a pair", i));
      continue;
    }
    values.emplace_back(checked(*pair->get(0), names[0], first),
                        checked(*pair->get(1), names[1], second));
  }
  std::vector<double> flat;
  for (const auto& [x, y] : values) {
    flat.insert(flat.end(), {x, y});
  }
  note(key, std::move(flat));
  return values;
}

int TomlReader::table_count(const std::string& key, int least, int most, const char* help) {
  keys_.push_back({key, fmt::format("{} to {} tables", least, most), "", "", "", help});
  const toml::array* array = root_.at_path(key).as_array();
  const int count = array != nullptr && is_tables(*array) ? static_cast<int>(array->size()) : 0;
  if (count < least || count > most) {
    fail(key, fmt::format("must be {} to {} tables; there {} {}", least, most,
                          count == 1 ? "is" : "are", count));
  }
  note(key, {static_cast<double>(count)});
  return std::clamp(count, least, most);
}

void TomlReader::refuse_unknown_keys() { refuse_unknown_in(root_, ""); }

void TomlReader::refuse_unknown_in(const toml::node& node, const std::string& path) {
  if (known_.count(path) != 0) {
    return;
  }
  if (!node.is_table() && knows_keys_in(path + ".")) {
    errors_.push_back(fmt::format("{} ({}): must be a table of keys", path, place(node)));
    return;
  }
  if (!is_tables(node) && knows_keys_in(path + "[")) {
    return;  // table_count() has said so.
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      refuse_unknown_in(
          value, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()));
    }
    return;
  }
  if (is_tables(node)) {
    for (std::size_t i = 0; i < node.as_array()->size(); ++i) {
      refuse_unknown_in(*node.as_array()->get(i), fmt::format("{}[{}]", path, i));
    }
    return;
  }
  const std::vector<std::string> known(known_.begin(), known_.end());
  errors_.push_back(
      fmt::format("{} ({}): unknown key{}", path, place(node), near_word_hint(path, known)));
}

}  // namespace graben::machines
