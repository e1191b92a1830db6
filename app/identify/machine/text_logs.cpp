// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include "app/identify/machine/other_logs.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::identify {
namespace {

constexpr std::uint32_t kMostPlainId = 0x7FF;
constexpr std::uint32_t kMostExtendedId = 0x1FFFFFFF;
constexpr CandumpLine kNoFrame{LineKind::kOther};

bool begins(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word;
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::vector<std::string_view> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    if (line.empty()) {
      return words;
    }
    words.push_back(line.substr(0, line.find_first_of(kBlank)));
    line.remove_prefix(words.back().size());
  }
}

template <class Number>
bool read(std::string_view word, int base, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number, base);
  return error == std::errc() && end == word.data() + word.size();
}

/// Bytes of a frame from a word on, as many as its length says; none where it has others.
CandumpLine frame_of(CandumpLine line, const std::vector<std::string_view>& words,
                     std::size_t length_at, int base) {
  std::uint32_t length = 0;
  const std::uint32_t most = line.extended ? kMostExtendedId : kMostPlainId;
  if (length_at >= words.size() || !read(words[length_at], base, length) || line.id > most) {
    return {};
  }
  if (length > line.data.size()) {
    return kNoFrame;
  }
  const bool is_remote = length_at + 1 < words.size() && words[length_at + 1] == "RTR";
  if (is_remote) {
    return kNoFrame;
  }
  if (words.size() < length_at + 1 + length) {
    return {};
  }
  for (std::size_t i = 0; i < length; ++i) {
    if (!read(words[length_at + 1 + i], base, line.data[i])) {
      return {};
    }
  }
  line.length = static_cast<std::uint8_t>(length);
  line.kind = LineKind::kFrame;
  return line;
}

}  // namespace

LogText::LogText(std::string_view first_line) {
  if (begins(first_line, ";$FILEVERSION") || begins(first_line, ";##")) {
    kind_ = Kind::kTrc;
  } else if (begins(first_line, "date ") || begins(first_line, "base ") ||
             begins(first_line, "// version")) {
    kind_ = Kind::kAsc;
  }
}

CandumpLine LogText::parse(std::string_view line) {
  switch (kind_) {
    case Kind::kAsc:
      return asc(line);
    case Kind::kTrc:
      return trc(line);
    case Kind::kCandump:
      break;
  }
  return parse_candump(line);
}

/// "0.015991 1  18FF2080x  Rx   d 8 00 11 ..."; what has no stamp and channel is of no frame.
CandumpLine LogText::asc(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() > 1 && words[0] == "base") {
    is_decimal_ = words[1] == "dec";
    is_relative_ = words.size() > 3 && words[3] == "relative";
    return kNoFrame;
  }
  const auto stamp = words.empty() ? std::nullopt : machines::number_in(words[0]);
  if (!stamp) {
    return kNoFrame;
  }
  last_s_ = is_relative_ ? last_s_ + *stamp : *stamp;
  constexpr std::size_t kLengthAt = 5;
  int channel = 0;
  if (words.size() < kLengthAt || !read(words[1], 10, channel) || words[4] != "d") {
    return kNoFrame;
  }
  CandumpLine line;
  line.time_s = last_s_;
  std::string_view id = words[2];
  line.extended = id.back() == 'x' || id.back() == 'X';
  id.remove_suffix(line.extended ? 1 : 0);
  const int base = is_decimal_ ? 10 : 16;
  return read(id, base, line.id) ? frame_of(line, words, kLengthAt, base) : CandumpLine{};
}

CandumpLine LogText::trc_header(std::string_view line) {
  constexpr std::string_view kVersion = ";$FILEVERSION=";
  constexpr std::string_view kColumns = ";$COLUMNS=";
  if (begins(line, kVersion)) {
    const auto version = machines::number_in(words_of(line.substr(kVersion.size()))[0]);
    version_ = version ? static_cast<int>(std::lround(10.0 * *version)) : version_;
  } else if (begins(line, kColumns)) {
    columns_.clear();
    for (const char letter : line.substr(kColumns.size())) {
      if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
        columns_ += letter;
      }
    }
  }
  return kNoFrame;
}

/// Columns by version, a letter each as version 2 has them: N number, O time in ms, T type, B bus,
/// I id, d direction, R reserved, l length, L the same as DLC, D data.
CandumpLine LogText::trc(std::string_view text) {
  if (begins(text, ";")) {
    return trc_header(text);
  }
  const std::vector<std::string_view> words = words_of(text);
  if (words.empty()) {
    return kNoFrame;
  }
  const std::string columns = version_ >= 20   ? columns_
                              : version_ >= 13 ? "NOBdIRlD"
                              : version_ >= 11 ? "NOdIlD"
                                               : "NOIlD";
  const auto at = [&](char letter) { return columns.find(letter); };
  const std::size_t length_at = std::min(at('l'), at('L'));
  const std::size_t most = std::max({at('O'), at('I'), length_at});
  if (most == std::string::npos || most >= words.size()) {
    return {};
  }
  const auto stamp_ms = machines::number_in(words[at('O')]);
  const std::string_view id = words[at('I')];
  constexpr double kMs = 1e-3;
  constexpr std::size_t kPlainDigits = 4;
  CandumpLine line;
  if (!stamp_ms) {
    return {};
  }
  const bool is_data = at('T') == std::string::npos || words[at('T')] == "DT";
  const std::string_view way = at('d') == std::string::npos ? "Rx" : words[at('d')];
  if (!is_data || (way != "Rx" && way != "Tx") || id == "FFFFFFFF") {
    return kNoFrame;
  }
  line.time_s = *stamp_ms * kMs;
  line.extended = id.size() > kPlainDigits;
  if (!read(id, 16, line.id)) {
    return {};
  }
  // The length is decimal, the bytes are not.
  std::vector<std::string_view> rest = words;
  std::uint32_t length = 0;
  if (!read(words[length_at], 10, length)) {
    return {};
  }
  return length > line.data.size() ? kNoFrame : frame_of(line, rest, length_at, 16);
}

std::string foreign_log(std::string_view begin) {
  constexpr const char* kConvert =
      "; allowed: candump, ASC, TRC or BLF, as python-can's "
      "can_logconvert makes them";
  if (begins(begin, "MDF ")) {
    return std::string("is an MDF (.mf4)") + kConvert;
  }
  if (begins(begin, "\x89MCAP")) {
    return std::string("is an MCAP") + kConvert;
  }
  if (begins(begin, "\x0A\x0D\x0D\x0A") || begins(begin, "\xD4\xC3\xB2\xA1")) {
    return std::string("is a capture of packets (pcap)") + kConvert;
  }
  return begins(begin, "SQLite format") ? std::string("is a database (SQLite)") + kConvert : "";
}

}  // namespace graben::identify
