#pragma once
/// Reads a TOML document key by key and collects everything that is wrong with it, instead of
/// stopping at the first error.

#include <toml++/toml.h>
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace graben::machines {

/// Allowed values of a number, ends included, and its unit for messages.
struct Range {
  double least;
  double most;
  const char* unit;
};

/// A key path is written as in TOML with indices: "pump[0].displacement". Every getter returns a
/// harmless value and records an error (key path, value, unit, allowed range, line) when the key is
/// missing, of the wrong type or out of range.
class TomlReader {
 public:
  explicit TomlReader(const toml::table& root) : root_(root) {}

  /// Whether an optional key is there.
  [[nodiscard]] bool has(const std::string& key) const;
  double number(const std::string& key, const Range& range);
  int integer(const std::string& key, int least, int most);
  bool boolean(const std::string& key);
  /// One of `allowed`, by its index.
  int choice(const std::string& key, const std::vector<std::string>& allowed);
  /// Exactly `count` numbers, or any number from `count` on if `count_most` says so.
  std::vector<double> numbers(const std::string& key, const Range& range, std::size_t count);
  Eigen::Vector2d point(const std::string& key, const Range& range);
  /// `least` to `most` pairs.
  std::vector<std::pair<double, double>> pairs(const std::string& key, const Range& first,
                                               const Range& second, std::size_t least,
                                               std::size_t most);
  /// Number of tables in an array of tables; an error, and the nearer end, unless it is `least` to
  /// `most`.
  int table_count(const std::string& key, int least, int most);

  /// Records an error that concerns a key as a whole.
  void fail(const std::string& key, const std::string& what);
  /// FNV-1a of every key that was asked for and its value, in the keys' order: the same for each
  /// way to write a value, and whatever the order, the layout and the comments are.
  [[nodiscard]] std::uint32_t hash() const;
  /// Records every key that no getter has asked for.
  void refuse_unknown_keys();

  [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }

 private:
  const toml::node* find(const std::string& key);
  void note(const std::string& key, std::vector<double> values);
  double checked(const toml::node& node, const std::string& key, const Range& range);
  void refuse_unknown_in(const toml::node& node, const std::string& path);

  const toml::table& root_;
  std::set<std::string> known_;
  std::map<std::string, std::vector<double>> values_;
  std::vector<std::string> errors_;
};

}  // namespace graben::machines
