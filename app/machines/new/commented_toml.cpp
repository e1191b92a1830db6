// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/commented_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace graben::machines {
namespace {

/// Seven digits are finer than anything that is measured, and hide what a unit's change left
/// behind.
std::string number_text(double value) {
  std::string text = fmt::format("{:.7g}", value);
  const bool is_whole = text.find_first_of(".e") == std::string::npos;
  return is_whole ? text + ".0" : text;
}

std::string row_text(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) {
    texts.push_back(number_text(number));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string text_of(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> texts;
    for (const toml::node& entry : *array) {
      texts.push_back(text_of(entry));
    }
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  if (const toml::value<double>* number = node.as_floating_point()) {
    return number_text(number->get());
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

std::string text_of(const CommentedValue& value, bool is_array) {
  if (!value.rows.empty()) {
    std::vector<std::string> texts;
    for (const std::vector<double>& row : value.rows) {
      texts.push_back(row_text(row));
    }
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  return is_array ? row_text(value.numbers) : number_text(value.numbers.front());
}

bool is_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && array->is_homogeneous(toml::node_type::table);
}

class Writer {
 public:
  Writer(const std::vector<KeyEntry>& keys, const CommentedValues& told,
         const std::string& otherwise)
      : keys_(keys), told_(told), otherwise_(otherwise) {}

  /// `header` as in a section's brackets, `path` with the indices of arrays.
  void table(const toml::table& table, const std::string& header, const std::string& path) {
    const std::vector<Child> children = in_order(table);
    for (const Child& child : children) {
      if (!child.node->is_table() && !is_tables(*child.node)) {
        value(child.key, join(path, child.key), *child.node);
      }
    }
    for (const Child& child : children) {
      const std::string below = join(header, written(child.key));
      if (const toml::table* section = child.node->as_table()) {
        text_ += fmt::format("\n[{}]\n", below);
        this->table(*section, below, join(path, child.key));
      } else if (is_tables(*child.node)) {
        const toml::array& array = *child.node->as_array();
        for (std::size_t i = 0; i < array.size(); ++i) {
          text_ += fmt::format("\n[[{}]]\n", below);
          this->table(*array.get(i)->as_table(), below,
                      fmt::format("{}[{}]", join(path, child.key), i));
        }
      }
    }
  }

  [[nodiscard]] std::string text() const { return text_; }

 private:
  struct Child {
    std::string key;
    const toml::node* node;
  };

  static std::string join(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  /// As a section's or a line's name.
  static std::string written(const std::string& key) {
    const bool is_bare = key.find_first_of(".\" ") == std::string::npos;
    return is_bare ? key : "\"" + key + "\"";
  }

  static std::vector<Child> in_order(const toml::table& table) {
    std::vector<Child> children;
    for (const auto& [key, node] : table) {
      children.push_back({std::string(key.str()), &node});
    }
    std::stable_sort(children.begin(), children.end(), [](const Child& a, const Child& b) {
      return a.node->source().begin < b.node->source().begin;
    });
    return children;
  }

  void value(const std::string& key, const std::string& path, const toml::node& node) {
    const auto entry = std::find_if(keys_.begin(), keys_.end(),
                                    [&](const KeyEntry& other) { return other.key == path; });
    if (entry != keys_.end()) {
      text_ += "# " + entry->help;
      const bool has_range = !entry->allowed.empty();
      if (has_range) {
        text_ +=
            fmt::format("; {}{}{}", entry->allowed, entry->unit.empty() ? "" : " ", entry->unit);
      }
      text_ += "\n";
    }
    const auto told = told_.find(path);
    const bool is_told = told != told_.end();
    text_ += fmt::format("{} = {}  # {}\n", written(key),
                         is_told ? text_of(told->second, node.is_array()) : text_of(node),
                         is_told ? told->second.from : otherwise_);
  }

  const std::vector<KeyEntry>& keys_;
  const CommentedValues& told_;
  const std::string& otherwise_;
  std::string text_;
};

}  // namespace

std::string commented_toml(const toml::table& root, const std::vector<KeyEntry>& keys,
                           const CommentedValues& told, const std::string& otherwise) {
  Writer writer(keys, told, otherwise);
  writer.table(root, "", "");
  return writer.text();
}

}  // namespace graben::machines
