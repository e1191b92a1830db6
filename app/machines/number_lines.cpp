// SPDX-License-Identifier: Apache-2.0
#include "app/machines/number_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "app/machines/missing_file.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

constexpr std::size_t kMostErrors = 10;
constexpr std::string_view kBetween = " \t,;\r";

/// Of one line, without its comment.
class LineNumbers {
 public:
  explicit LineNumbers(std::string_view line) : rest_(line.substr(0, line.find('#'))) { skip(); }

  [[nodiscard]] bool done() const { return rest_.empty(); }
  /// The next word as a number; empty where it is one.
  [[nodiscard]] std::string next(double& number) {
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBetween));
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    rest_.remove_prefix(word.size());
    skip();
    constexpr std::size_t kShown = 30;
    const bool is_number = error == std::errc() && stop == end && std::isfinite(number);
    return is_number ? "" : fmt::format("'{}' is no finite number", word.substr(0, kShown));
  }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kBetween), rest_.size())); }

  std::string_view rest_;
};

/// What is wrong with the line; empty: nothing.
std::string take_line(std::size_t number, std::string_view line, const Columns& columns,
                      const TakeNumbers& take) {
  LineNumbers words(line);
  LineOfNumbers numbers{};
  numbers.fill(std::numeric_limits<double>::quiet_NaN());
  const std::size_t most = columns.count + columns.more;
  std::size_t count = 0;
  for (; !words.done(); ++count) {
    double value = 0.0;
    const std::string wrong = words.next(value);
    if (!wrong.empty()) {
      return fmt::format("{}; allowed: {}", wrong, columns.names);
    }
    if (count < most) {
      numbers[count] = value;
    }
  }
  if (count == 0) {
    return "";
  }
  const std::string allowed = columns.more > 0 ? fmt::format("{} .. {}", columns.count, most)
                                               : std::to_string(columns.count);
  return count >= columns.count && count <= most
             ? take(number, numbers)
             : fmt::format("{} number{}; allowed: {}, {}", count, count == 1 ? "" : "s", allowed,
                           columns.names);
}

}  // namespace

std::string file_text(const std::filesystem::path& file, const std::string& wanted) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.good() && !stream.eof()) {
    throw std::runtime_error(unread_text(file, wanted));
  }
  return text;
}

void read_number_lines(const std::filesystem::path& file, const Columns& columns,
                       const TakeNumbers& take) {
  const std::string text = file_text(file, fmt::format("lines of {}", columns.names));
  std::vector<std::string> errors;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size() && errors.size() < kMostErrors;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++number;
    if (number > columns.most_lines) {
      errors.push_back(
          fmt::format("line {}: allowed: at most {} lines", number, columns.most_lines));
      break;
    }
    const std::string wrong =
        take_line(number, std::string_view(text).substr(at, end - at), columns, take);
    if (!wrong.empty()) {
      errors.push_back(fmt::format("line {}: {}", number, wrong));
    }
    at = end + 1;
  }
  if (!errors.empty()) {
    throw ProfileError(file.string(), errors);
  }
}

}  // namespace graben::machines
