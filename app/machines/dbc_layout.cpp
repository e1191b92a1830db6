// SPDX-License-Identifier: Apache-2.0
#include "app/machines/dbc_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "app/machines/missing_file.hpp"

namespace graben::machines {
namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000U;
constexpr int kMostWidth = 32;
constexpr int kMostLength = 8;
constexpr std::uint32_t kMostPlainId = 0x7FF;
constexpr std::uint32_t kMostExtendedId = 0x1FFFFFFF;
/// A longer line would be matched by too deep a recursion.
constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kLongestQuote = 80;
/// Where tools put signals of no message; its id is none.
constexpr const char* kNoMessage = "VECTOR__INDEPENDENT_SIG_MSG";

const std::regex& message_line() {
  static const std::regex line(R"(\s*BO_ (\d+) (\w+)\s*: (\d+) \w+\s*)");
  return line;
}

const std::regex& signal_line() {
  static const std::regex line(
      R"(\s*SG_ (\w+)\s*(M|m\d+M?)?\s*: (\d+)\|(\d+)@([01])([+-]) \(([^,]+),([^)]+)\) \[([^|]*)\|([^\]]*)\].*)");
  return line;
}

const std::regex& value_type_line() {
  static const std::regex line(R"(\s*SIG_VALTYPE_ (\d+) (\w+)\s*:?\s*([0-3])\s*;\s*)");
  return line;
}

[[noreturn]] void refuse_line(const std::string& why) { throw std::invalid_argument(why); }

double dbc_number(std::string token) {
  token.erase(0, std::min(token.find_first_not_of(" \t"), token.size()));
  token.erase(token.find_last_not_of(" \t") + 1);
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(token, &end);
  } catch (const std::logic_error&) {
    end = std::string::npos;
  }
  if (end != token.size() || !std::isfinite(value)) {
    refuse_line("'" + token.substr(0, kLongestQuote) + "' is no number");
  }
  return value;
}

/// As std::stoul, with words of our own.
std::uint32_t dbc_whole(const std::string& token) {
  constexpr std::size_t kMostDigits = 10;
  const std::uint64_t value = token.size() > kMostDigits ? UINT64_MAX : std::stoull(token);
  if (value > UINT32_MAX) {
    refuse_line(token.substr(0, kLongestQuote) + " is beyond 32 bits");
  }
  return static_cast<std::uint32_t>(value);
}

DbcMessage message_of(const std::smatch& words) {
  const std::uint32_t said = dbc_whole(words[1]);
  const bool extended = (said & kExtendedFlag) != 0U;
  const std::uint32_t id = said & ~kExtendedFlag;
  const std::uint32_t most = extended ? kMostExtendedId : kMostPlainId;
  if (id > most && words[2] != kNoMessage) {
    refuse_line(fmt::format("id 0x{:X}; allowed: at most 0x{:X}", id, most));
  }
  return {words[2],
          id,
          extended,
          static_cast<int>(std::min<std::uint32_t>(dbc_whole(words[3]), 64U)),
          {}};
}

DbcSignal signal_of(const std::smatch& words) {
  DbcSignal signal;
  signal.name = words[1];
  const std::uint32_t start = dbc_whole(words[3]);
  const std::uint32_t width = dbc_whole(words[4]);
  signal.supported = !words[2].matched && width >= 1 && width <= kMostWidth &&
                     start < std::uint32_t{kMostLength * 8};
  if (signal.supported) {
    signal.bits = {static_cast<std::uint8_t>(start), static_cast<std::uint8_t>(width),
                   words[5] == "0", words[6] == "-"};
  }
  signal.scale = dbc_number(words[7]);
  signal.offset = dbc_number(words[8]);
  signal.least = dbc_number(words[9]);
  signal.most = dbc_number(words[10]);
  if (signal.scale == 0.0) {
    refuse_line("scale 0; allowed: any other number");
  }
  return signal;
}

void add_message(DbcMessage message, std::vector<DbcMessage>& messages) {
  for (const DbcMessage& other : messages) {
    if (other.name == message.name) {
      refuse_line("a second message of this name");
    }
    if (other.id == message.id && other.extended == message.extended) {
      refuse_line("its id is that of message " + other.name);
    }
  }
  messages.push_back(std::move(message));
}

void add_signal(DbcSignal signal, DbcMessage& message) {
  for (const DbcSignal& other : message.signal) {
    if (other.name == signal.name) {
      refuse_line("a second signal of this name in message " + message.name);
    }
  }
  message.signal.push_back(std::move(signal));
}

/// Float and double are in no bits of ours.
void note_value_type(const std::smatch& words, std::vector<DbcMessage>& messages) {
  const std::uint32_t said = dbc_whole(words[1]);
  for (DbcMessage& message : messages) {
    for (DbcSignal& signal : message.signal) {
      const bool is_it =
          (message.id | (message.extended ? kExtendedFlag : 0U)) == said && signal.name == words[2];
      signal.supported = signal.supported && !(is_it && words[3] != "0");
    }
  }
}

void read_dbc_line(const std::string& line, std::vector<DbcMessage>& messages) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  const auto begins = [&](const char* word) {
    return line.compare(begin, std::char_traits<char>::length(word), word) == 0;
  };
  const bool is_message = begins("BO_ ");
  const bool is_signal = begins("SG_ ");
  const bool is_type = begins("SIG_VALTYPE_ ");
  if (!is_message && !is_signal && !is_type) {
    return;
  }
  if (line.size() > kLongestLine) {
    refuse_line(fmt::format("{} characters; allowed: at most {}", line.size(), kLongestLine));
  }
  std::smatch words;
  if (is_message && std::regex_match(line, words, message_line())) {
    add_message(message_of(words), messages);
  } else if (is_signal && !messages.empty() && std::regex_match(line, words, signal_line())) {
    add_signal(signal_of(words), messages.back());
  } else if (is_type && std::regex_match(line, words, value_type_line())) {
    note_value_type(words, messages);
  } else {
    refuse_line("not as a DBC has it");
  }
}

}  // namespace

std::vector<DbcMessage> read_dbc(const std::filesystem::path& file) {
  std::error_code none;
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file, none)) {
    throw std::runtime_error(unread_text(file, "the DBC that a bus profile names"));
  }
  std::vector<DbcMessage> messages;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    try {
      read_dbc_line(line, messages);
    } catch (const std::logic_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}: {}", file.string(), number, error.what(),
                                           line.substr(0, kLongestQuote)));
    }
  }
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                                [](const DbcMessage& each) { return each.name == kNoMessage; }),
                 messages.end());
  return messages;
}

}  // namespace graben::machines
