// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/candump_line.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace graben::identify {
namespace {

/// How can-utils mark what is a report of the bus controller, CAN_ERR_FLAG, and above it what no
/// line has.
constexpr std::uint32_t kErrorFlag = 0x20000000U;
constexpr std::uint32_t kBeyond = 0x40000000U;
constexpr std::uint32_t kMostPlainId = 0x7FF;
constexpr std::size_t kExtendedDigits = 8;
constexpr std::size_t kPlainDigits = 3;
constexpr std::size_t kMostPlaces = 9;
constexpr std::size_t kMostSecondDigits = 12;

/// Takes a line apart from its begin on.
class Rest {
 public:
  explicit Rest(std::string_view text) : text_(text) {}

  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] std::string_view text() const { return text_; }

  bool take(char letter) {
    const bool is_it = !text_.empty() && text_.front() == letter;
    text_.remove_prefix(is_it ? 1 : 0);
    return is_it;
  }
  /// As many of these as there are.
  template <class Is>
  std::string_view take_while(Is is) {
    const auto end = std::find_if_not(text_.begin(), text_.end(), is);
    const auto count = static_cast<std::size_t>(end - text_.begin());
    const std::string_view taken = text_.substr(0, count);
    text_.remove_prefix(count);
    return taken;
  }

 private:
  std::string_view text_;
};

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
bool is_hex(char letter) {
  return is_digit(letter) || (letter >= 'A' && letter <= 'F') || (letter >= 'a' && letter <= 'f');
}
bool is_blank(char letter) { return letter == ' '; }
bool is_word(char letter) { return static_cast<unsigned char>(letter) > ' '; }
bool is_mark(char letter) { return letter == ' ' || (letter >= 'A' && letter <= 'Z'); }

template <class Number>
Number number_of(std::string_view digits, int base) {
  Number number{};
  std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  return number;
}

/// "(1700000000.123456)": six places and ten digits before them are a whole number that a double
/// has exactly.
bool take_time(Rest& rest, double& time_s) {
  if (!rest.take('(')) {
    return false;
  }
  const std::string_view seconds = rest.take_while(is_digit);
  const bool has_point = rest.take('.');
  const std::string_view places = rest.take_while(is_digit);
  if (seconds.empty() || seconds.size() > kMostSecondDigits || !has_point || places.empty() ||
      places.size() > kMostPlaces || !rest.take(')')) {
    return false;
  }
  double scale = 1.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    scale *= 10.0;
  }
  const auto whole = static_cast<double>(number_of<std::int64_t>(seconds, 10));
  const auto fraction = static_cast<double>(number_of<std::int64_t>(places, 10));
  time_s = places.size() == 6 ? (whole * scale + fraction) / scale : whole + fraction / scale;
  return true;
}

/// Pairs of digits into the data, up to `most`; how many there were, all of them.
std::size_t take_bytes(Rest& rest, CandumpLine& line) {
  const std::string_view digits = rest.take_while(is_hex);
  const std::size_t bytes = digits.size() / 2;
  for (std::size_t i = 0; i < std::min(bytes, line.data.size()); ++i) {
    line.data[i] = number_of<std::uint8_t>(digits.substr(2 * i, 2), 16);
  }
  line.length = static_cast<std::uint8_t>(std::min(bytes, line.data.size()));
  return digits.size() % 2 == 0 && bytes <= line.data.size() ? bytes : SIZE_MAX;
}

/// A raw length of nine and more, of a frame of eight bytes, and letters that say which way it
/// went.
bool ends(Rest& rest, std::size_t length) {
  const std::string_view text = rest.text();
  constexpr std::size_t kMark = 2;
  if (text.size() >= kMark && text[0] == '_' && length == 8 && is_hex(text[1]) && text[1] > '8') {
    rest.take('_');
    rest.take(text[1]);
  }
  if (!rest.empty() && !rest.take(' ')) {
    return false;
  }
  rest.take_while(is_mark);
  return rest.empty();
}

LineKind whole(bool is_whole, LineKind kind) { return is_whole ? kind : LineKind::kBroken; }

/// "81:00:00000000#AABB", after an id with '#'.
LineKind take_xl(Rest& rest) {
  for (const std::size_t digits : {std::size_t{2}, std::size_t{2}, std::size_t{8}}) {
    const bool is_number = rest.take_while(is_hex).size() == digits;
    if (!is_number || !rest.take(digits == 2 ? ':' : '#')) {
      return LineKind::kBroken;
    }
  }
  rest.take_while([](char letter) { return is_hex(letter) || letter == '.'; });
  return whole(ends(rest, 0), LineKind::kOther);
}

bool is_id(std::string_view digits, std::uint32_t id) {
  return (digits.size() == kExtendedDigits && id < kBeyond) ||
         (digits.size() == kPlainDigits && id <= kMostPlainId);
}

/// What follows "id#".
LineKind take_data(Rest& rest, std::string_view digits, CandumpLine& line) {
  constexpr std::size_t kXlMark = 2;
  if (digits.size() >= kPlainDigits && digits.size() <= kPlainDigits + 2 &&
      rest.text().size() > kXlMark && rest.text()[kXlMark] == ':') {
    return take_xl(rest);
  }
  if (!is_id(digits, line.id)) {
    return LineKind::kBroken;
  }
  if (rest.take('#')) {
    const bool has_flags = !rest.take_while(is_hex).empty();
    return whole(has_flags && ends(rest, 0), LineKind::kOther);
  }
  if (rest.take('R')) {
    const std::string_view said = rest.text().substr(0, 1);
    const bool has_length = !said.empty() && said[0] >= '0' && said[0] <= '8';
    rest.take(has_length ? said[0] : '\0');
    return whole(ends(rest, has_length ? static_cast<std::size_t>(said[0] - '0') : 0),
                 LineKind::kOther);
  }
  const std::size_t bytes = take_bytes(rest, line);
  const bool is_error = line.extended && (line.id & kErrorFlag) != 0U;
  return whole(bytes <= line.data.size() && ends(rest, bytes),
               is_error ? LineKind::kOther : LineKind::kFrame);
}

bool is_byte(std::string_view text) {
  const std::string_view word = text.substr(0, text.find(' '));
  return word.size() == 2 && is_hex(word[0]) && is_hex(word[1]);
}

/// "[2]  AA BB", after an id and blanks: as candump writes to a terminal.
LineKind take_terminal(Rest& rest, std::string_view digits, CandumpLine& line) {
  rest.take_while(is_blank);
  const bool opens = rest.take('[');
  const std::string_view said = rest.take_while(is_digit);
  const bool closes = rest.take(']');
  if (!is_id(digits, line.id) || !opens || said.empty() || said.size() > 4 || !closes) {
    return LineKind::kBroken;
  }
  const auto length = number_of<std::size_t>(said, 10);
  std::size_t bytes = 0;
  rest.take_while(is_blank);
  for (; is_byte(rest.text()); rest.take_while(is_blank)) {
    const std::string_view byte = rest.take_while(is_hex);
    if (bytes < line.data.size()) {
      line.data[bytes] = number_of<std::uint8_t>(byte, 16);
    }
    ++bytes;
  }
  const bool is_remote = rest.text() == "remote request";
  const bool is_text = !rest.empty() && rest.text().front() == '\'';
  const bool is_report = line.extended && (line.id & kErrorFlag) != 0U;
  if (is_remote || (is_report && bytes == length)) {
    return LineKind::kOther;
  }
  if (bytes != length || (!rest.empty() && !is_text)) {
    return LineKind::kBroken;
  }
  line.length = static_cast<std::uint8_t>(std::min(bytes, line.data.size()));
  return bytes <= line.data.size() ? LineKind::kFrame : LineKind::kOther;
}

constexpr std::string_view kDropped = "DROPCOUNT: dropped ";

CandumpLine lost_frames(Rest rest) {
  CandumpLine line;
  const std::string_view count = rest.take_while(is_digit);
  if (!count.empty() && count.size() <= kMostPlaces && rest.take(' ')) {
    line.kind = LineKind::kLost;
    line.lost = number_of<std::uint64_t>(count, 10);
  }
  return line;
}

}  // namespace

CandumpLine parse_candump(std::string_view text) {
  if (text.substr(0, kDropped.size()) == kDropped) {
    return lost_frames(Rest(text.substr(kDropped.size())));
  }
  CandumpLine line;
  Rest rest(text);
  rest.take_while(is_blank);
  if (!take_time(rest, line.time_s) || rest.take_while(is_blank).empty()) {
    return {};
  }
  const bool has_name = !rest.take_while(is_word).empty();
  if (!has_name || rest.take_while(is_blank).empty()) {
    return {};
  }
  const std::string_view digits = rest.take_while(is_hex);
  line.extended = digits.size() == kExtendedDigits;
  line.id = digits.size() <= kExtendedDigits ? number_of<std::uint32_t>(digits, 16) : kBeyond;
  const bool is_logged = rest.take('#');
  line.kind = is_logged ? take_data(rest, digits, line) : take_terminal(rest, digits, line);
  return line;
}

}  // namespace graben::identify
