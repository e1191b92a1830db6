// SPDX-License-Identifier: Apache-2.0
#include "app/machines/dbc_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/machines/missing_file.hpp"
#include "app/machines/plain_text.hpp"

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

// Blanks stand where a tool or a hand likes them, to align columns too.
const std::regex& message_line() {
  static const std::regex line(R"(\s*BO_\s+(\d+)\s+(\w+)\s*:\s*(\d+)(\s.*)?)");
  return line;
}

const std::regex& signal_line() {
  static const std::regex line(
      R"re(\s*SG_\s+(\w+)\s*(M|m\d+M?)?\s*:\s*(\d+)\s*\|\s*(\d+)\s*@\s*([01])\s*([+-])\s*\(([^,]+),([^)]+)\)\s*\[([^|]*)\|([^\]]*)\]\s*(?:"([^"]*)")?.*)re");
  return line;
}

/// What can still be told of a line that is none of these: its name.
const std::regex& named_line() {
  static const std::regex line(R"(\s*(?:BO_\s+\d+|SG_)\s+(\w+).*)");
  return line;
}

const std::regex& value_type_line() {
  static const std::regex line(R"(\s*SIG_VALTYPE_\s+(\d+)\s+(\w+)\s*:?\s*([0-3])\s*;\s*)");
  return line;
}

[[noreturn]] void refuse_line(const std::string& why) { throw std::invalid_argument(why); }

double dbc_number(std::string_view token) {
  token.remove_prefix(std::min(token.find_first_not_of(" \t"), token.size()));
  token = token.substr(0, token.find_last_not_of(" \t") + 1);
  const auto value = number_in(token);
  if (!value) {
    refuse_line(not_a_number(token));
  }
  return *value;
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
  DbcMessage message;
  message.name = words[2];
  message.id = id;
  message.extended = extended;
  message.length = static_cast<int>(std::min<std::uint32_t>(dbc_whole(words[3]), 64U));
  return message;
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
  signal.scale = dbc_number(words[7].str());
  signal.offset = dbc_number(words[8].str());
  signal.least = dbc_number(words[9].str());
  signal.most = dbc_number(words[10].str());
  signal.unit = words[11];
  if (signal.scale == 0.0) {
    refuse_line("scale 0; allowed: any other number");
  }
  return signal;
}

/// Reads what it can, and keeps with each message and signal what is wrong with it.
class DbcReader {
 public:
  explicit DbcReader(std::string file) : file_(std::move(file)) {}

  void take(std::string_view line) {
    ++number_;
    if (in_text_) {
      in_text_ = !ends_text(line);
      return;
    }
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    const std::string_view word = line.substr(begin, line.find_first_of(" \t:", begin) - begin);
    if (word == "BO_" || word == "SG_" || word == "SIG_VALTYPE_") {
      take_layout(std::string(line), word == "BO_", word == "SG_");
    } else if (word == "CM_" || word == "BA_" || word == "BA_DEF_" || word == "BA_DEF_DEF_") {
      // A text may go over lines, and one of them may begin as a message does.
      in_text_ = !ends_text(line);
    }
  }

  std::vector<DbcMessage> messages() {
    messages_.erase(std::remove_if(messages_.begin(), messages_.end(),
                                   [](const DbcMessage& each) { return each.name == kNoMessage; }),
                    messages_.end());
    return std::move(messages_);
  }

 private:
  /// True if the line leaves no text open: of the one that it begins in, if `in_text_`.
  [[nodiscard]] bool ends_text(std::string_view line) const {
    bool open = in_text_;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\\') {
        ++i;
      } else if (line[i] == '"') {
        open = !open;
      }
    }
    // A quote within a text is sometimes not marked as one.
    const std::string_view end = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    const bool is_end = end.size() > 1 && end.substr(end.size() - 2) == "\";";
    return !open || is_end;
  }

  void take_layout(const std::string& line, bool is_message, bool is_signal) {
    std::smatch words;
    try {
      if (line.size() > kLongestLine) {
        refuse_line(fmt::format("{} characters; allowed: at most {}", line.size(), kLongestLine));
      }
      if (is_message && std::regex_match(line, words, message_line())) {
        add_message(message_of(words));
      } else if (is_signal && std::regex_match(line, words, signal_line())) {
        add_signal(signal_of(words));
      } else if (std::regex_match(line, words, value_type_line())) {
        note_value_type(words);
      } else {
        refuse_line("not as a DBC has it");
      }
    } catch (const std::logic_error& error) {
      note_wrong(line, is_message, is_signal, error.what());
    }
  }

  [[nodiscard]] std::string at_line(const std::string& why) const {
    return fmt::format("{}:{}: {}", file_, number_, why);
  }

  void note_wrong(const std::string& line, bool is_message, bool is_signal, const char* why) {
    const std::string text = at_line(fmt::format("{}: {}", why, line.substr(0, kLongestQuote)));
    const std::string begin = line.substr(0, kLongestQuote);
    std::smatch words;
    if (!std::regex_match(begin, words, named_line())) {
      return;
    }
    if (is_message) {
      DbcMessage message;
      message.name = words[1];
      message.wrong = text;
      add_message(std::move(message));
    } else if (is_signal) {
      DbcSignal signal;
      signal.name = words[1];
      signal.wrong = text;
      add_signal(std::move(signal));
    }
  }

  void add_message(DbcMessage message) {
    for (DbcMessage& other : messages_) {
      if (other.name == message.name) {
        message.wrong = at_line("a second message of this name, " + message.name);
        other.wrong = message.wrong;
      }
    }
    messages_.push_back(std::move(message));
  }

  void add_signal(DbcSignal signal) {
    if (messages_.empty()) {
      return;
    }
    DbcMessage& message = messages_.back();
    for (DbcSignal& other : message.signal) {
      if (other.name == signal.name) {
        signal.wrong = at_line(fmt::format("a second signal of this name in message {}: {}",
                                           message.name, signal.name));
        other.wrong = signal.wrong;
      }
    }
    message.signal.push_back(std::move(signal));
  }

  /// Float and double are in no bits of ours.
  void note_value_type(const std::smatch& words) {
    const std::uint32_t said = dbc_whole(words[1]);
    for (DbcMessage& message : messages_) {
      for (DbcSignal& signal : message.signal) {
        const bool is_it = (message.id | (message.extended ? kExtendedFlag : 0U)) == said &&
                           signal.name == words[2];
        signal.supported = signal.supported && !(is_it && words[3] != "0");
      }
    }
  }

  std::string file_;
  std::vector<DbcMessage> messages_;
  int number_ = 0;
  bool in_text_ = false;
};

}  // namespace

std::vector<DbcMessage> read_dbc(const std::filesystem::path& file) {
  constexpr const char* kWanted = "the DBC that a bus profile names";
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) {
    throw std::runtime_error(unread_text(file, kWanted));
  }
  const std::string text = plain_text(file, kWanted);
  DbcReader reader(file.string());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    reader.take(line.substr(0, line.find_last_not_of('\r') + 1));
    at = end + 1;
  }
  return reader.messages();
}

}  // namespace graben::machines
