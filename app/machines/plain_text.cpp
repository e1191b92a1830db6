// SPDX-License-Identifier: Apache-2.0
#include "app/machines/plain_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "app/machines/missing_file.hpp"

namespace graben::machines {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlank = " \t\r\n";
constexpr std::size_t kShown = 30;

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  text.remove_suffix(text.size() - std::min(text.find_last_not_of(kBlank) + 1, text.size()));
  return text;
}

/// A spreadsheet quotes what it takes for text.
std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  const bool quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

/// The next place of the separator that is in no quotes.
std::size_t end_of_cell(std::string_view line, std::size_t from, char separator) {
  bool quoted = false;
  std::size_t at = from;
  while (at < line.size() && (quoted || line[at] != separator)) {
    quoted = quoted != (line[at] == '"');
    ++at;
  }
  return at;
}

/// A character of UTF-8 at the text's begin, and its length; length 0: it is none.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;
};

Character character_at(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::size_t length = byte(0) >= 0xF0U ? 4 : byte(0) >= 0xE0U ? 3 : byte(0) >= 0xC2U ? 2 : 0;
  if (length == 0 || length > text.size()) {
    return {};
  }
  std::uint32_t code = byte(0) & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {};
    }
    code = code << 6U | (byte(i) & 0x3FU);
  }
  return {code, length};
}

/// What word processors put in the place of what a keyboard has.
const char* name_of(std::uint32_t code) {
  if (code == 0x2018 || code == 0x2019 || (code >= 0x201C && code <= 0x201E)) {
    return "a typographic quote";
  }
  if (code == 0x2212 || (code >= 0x2010 && code <= 0x2015)) {
    return "a typographic minus";
  }
  return code == 0xA0 || code == 0x202F || code == 0x2009 ? "a blank that does not break"
                                                          : "no letter of ASCII";
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

void drop_byte_order_mark(std::string& text) {
  if (text.compare(0, kMark.size(), kMark) == 0) {
    text.erase(0, kMark.size());
  }
}

bool is_utf16(std::string_view text) {
  if (text.size() < 2) {
    return false;
  }
  const std::string_view mark = text.substr(0, 2);
  const auto is_letter = [](char byte) { return byte >= '\t' && byte < '\x7F'; };
  return mark == "\xFF\xFE" || mark == "\xFE\xFF" || (text[0] == '\0' && is_letter(text[1])) ||
         (is_letter(text[0]) && text[1] == '\0');
}

std::string plain_text(const std::filesystem::path& file, const std::string& wanted) {
  std::string text = file_text(file, wanted);
  if (is_utf16(text)) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), kUtf16));
  }
  drop_byte_order_mark(text);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  line = line.substr(0, line.find_last_not_of("\r\n") + 1);
  const auto has = [&](char separator) { return end_of_cell(line, 0, separator) < line.size(); };
  const char separator = has(';') ? ';' : has('\t') ? '\t' : has(',') ? ',' : ' ';
  if (separator == ' ') {
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
      cells.push_back(unquoted(line.substr(0, end_of_cell(line, 0, ' '))));
      line.remove_prefix(end_of_cell(line, 0, ' '));
    }
    return cells;
  }
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = end_of_cell(line, at, separator);
    cells.push_back(unquoted(line.substr(at, end - at)));
    at = end + 1;
  }
  while (!cells.empty() && cells.back().empty()) {
    cells.pop_back();
  }
  return cells;
}

std::optional<double> number_in(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && (is_digit(word[1]) || word[1] == '.');
  word.remove_prefix(plus ? 1 : 0);
  double number = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  const bool is_number = error == std::errc() && stop == end && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

std::string strange_character(std::string_view text) {
  const auto at = std::find_if(text.begin(), text.end(), [](char letter) {
    return static_cast<std::uint8_t>(letter) >= 0x80U;
  });
  if (at == text.end()) {
    return "";
  }
  const std::string_view rest = text.substr(static_cast<std::size_t>(at - text.begin()));
  const Character character = character_at(rest);
  if (character.length == 0) {
    return fmt::format("the byte 0x{:02X}, as Latin-1 has it; allowed: UTF-8",
                       static_cast<std::uint8_t>(rest.front()));
  }
  return fmt::format("'{}' (U+{:04X}), {}", rest.substr(0, character.length), character.code,
                     name_of(character.code));
}

std::string not_a_number(std::string_view word) {
  const std::string shown(word.substr(0, kShown));
  if (const std::string strange = strange_character(word); !strange.empty()) {
    const bool is_utf8 = strange[0] == '\'';
    return is_utf8 ? fmt::format("'{}' has {}", shown, strange)
                   : fmt::format("a number has {}", strange);
  }
  const std::size_t comma = word.find(',');
  if (comma != std::string_view::npos && comma + 1 < word.size() && is_digit(word[comma + 1])) {
    return fmt::format("'{}' has a decimal comma; a number has a decimal point", shown);
  }
  if (word.find_first_of(kBlank) != std::string_view::npos) {
    return fmt::format(
        "'{}' are two words between commas, semicolons or tabs, as a decimal comma "
        "or mixed separators make them",
        shown);
  }
  return word.empty() ? "an empty cell" : fmt::format("'{}' is no finite number", shown);
}

}  // namespace graben::machines
