// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reads a TOML document key by key and collects everything that is wrong with it, instead of
/// stopping at the first error.

#include <toml++/toml.h>
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/machines/provenance.hpp"

namespace graben::machines {

/// Allowed values of a number, ends included, and its unit for messages.
struct Range {
  double least;
  double most;
  const char* unit;
};

/// A key as the reader asks for it: a line of the reference.
struct KeyEntry {
  std::string key;      ///< Path as in TOML, with indices: "pump[0].displacement".
  std::string type;     ///< "number", "whole number", "2 numbers", "one of" ...
  std::string allowed;  ///< Range or choices.
  std::string unit;
  std::string fallback;  ///< Value where the key is not given; empty where it has to be.
  std::string help;      ///< Its meaning.
};

/// Every getter returns a harmless value and records an error (key path, value, unit, allowed
/// range, line) when the key is missing, of the wrong type or out of range. `help` is the key's
/// meaning in the reference of all keys.
class TomlReader {
 public:
  /// A value that is not from `file` says in its error which file it is from.
  explicit TomlReader(const toml::table& root, std::string file = {})
      : root_(root), file_(std::move(file)) {}
  /// Reads nothing: every getter returns its harmless value, records no error, and only says what
  /// it asks for. `has` is the answer for each optional key.
  [[nodiscard]] static TomlReader listing(bool has);

  [[nodiscard]] bool lists() const { return listed_has_.has_value(); }

  /// True if an optional key is there.
  [[nodiscard]] bool has(const std::string& key) const;
  double number(const std::string& key, const Range& range, const char* help);
  /// The same of a key that may be left out.
  double number_or(double fallback, const std::string& key, const Range& range, const char* help);
  int integer(const std::string& key, int least, int most, const char* help);
  int integer_or(int fallback, const std::string& key, int least, int most, const char* help);
  bool boolean_or(bool fallback, const std::string& key, const char* help);
  std::string text(const std::string& key, const char* help);
  /// One of `allowed`, by its index.
  int choice(const std::string& key, const std::vector<std::string>& allowed, const char* help);
  /// Exactly `count` numbers.
  std::vector<double> numbers(const std::string& key, const Range& range, std::size_t count,
                              const char* help);
  Eigen::Vector2d point(const std::string& key, const Range& range, const char* help);
  /// `least` to `most` pairs.
  std::vector<std::pair<double, double>> pairs(const std::string& key, const Range& first,
                                               const Range& second, std::size_t least,
                                               std::size_t most, const char* help);
  /// Number of tables in an array of tables; an error, and the nearer end, unless it is `least` to
  /// `most`.
  int table_count(const std::string& key, int least, int most, const char* help);

  /// What section [provenance] says of the other keys, in the order of the file; an error for a
  /// path that leads to no value. Texts are in the hash as well.
  std::vector<Provenance> provenance();

  /// Records an error that concerns a key as a whole; none where it is judged by a value beside it
  /// that was out of range itself.
  void fail(const std::string& key, const std::string& what);
  /// FNV-1a of every key that was asked for and its value, in the keys' order: the same for each
  /// way to write a value, and whatever the order, the layout and the comments are.
  [[nodiscard]] std::uint32_t hash() const;
  /// Records every key that no getter has asked for, and what stands in a table's place.
  void refuse_unknown_keys();

  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
  /// Values were read, and none is wrong: what needs several of them can be checked.
  [[nodiscard]] bool is_sound() const { return errors_.empty() && !listed_has_; }
  /// What was asked for, in that order, each key once.
  [[nodiscard]] const std::vector<KeyEntry>& keys() const { return keys_; }

 private:
  const toml::node* find(KeyEntry entry);
  [[nodiscard]] bool is_in_no_table(const std::string& key) const;
  /// Of a path that ends in . or [.
  [[nodiscard]] bool knows_keys_in(const std::string& opened) const;
  int whole(const toml::node& node, const std::string& key, int least, int most);
  void note(const std::string& key, std::vector<double> values);
  double checked(const toml::node& node, const std::string& key, const Range& range);
  Provenance provenance_of(const std::string& key, const toml::node& told);
  [[nodiscard]] bool follows_from_another(const std::string& key, const std::string& what) const;
  void refuse_unknown_in(const toml::node& node, const std::string& path);

  /// Its line, and the file unless it is the one that is read.
  [[nodiscard]] std::string place(const toml::node& node) const;

  const toml::table& root_;
  std::string file_;
  std::optional<bool> listed_has_;  ///< Where it only lists.
  std::set<std::string> known_;
  std::vector<KeyEntry> keys_;
  std::map<std::string, std::vector<double>> values_;
  std::set<std::string> unread_;  ///< Keys whose value a harmless one stands in for.
  std::vector<std::string> errors_;
};

}  // namespace graben::machines
