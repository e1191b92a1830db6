// SPDX-License-Identifier: Apache-2.0
#include "app/machines/dbc_layout.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <stdexcept>

namespace graben::machines {
namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000U;
constexpr int kMostWidth = 32;
constexpr int kMostLength = 8;

const std::regex& message_line() {
  static const std::regex line(R"(\s*BO_ (\d+) (\w+)\s*: (\d+) \w+\s*)");
  return line;
}

const std::regex& signal_line() {
  static const std::regex line(
      R"(\s*SG_ (\w+)\s*(M|m\d+M?)?\s*: (\d+)\|(\d+)@([01])([+-]) \(([^,]+),([^)]+)\) \[([^|]*)\|([^\]]*)\].*)");
  return line;
}

DbcMessage message_of(const std::smatch& words) {
  const auto id = static_cast<std::uint32_t>(std::stoul(words[1]));
  return {words[2], id & ~kExtendedFlag, (id & kExtendedFlag) != 0U, std::stoi(words[3]), {}};
}

DbcSignal signal_of(const std::smatch& words) {
  DbcSignal signal;
  signal.name = words[1];
  const int start = std::stoi(words[3]);
  const int width = std::stoi(words[4]);
  signal.supported =
      !words[2].matched && width >= 1 && width <= kMostWidth && start < kMostLength * 8;
  if (signal.supported) {
    signal.bits = {static_cast<std::uint8_t>(start), static_cast<std::uint8_t>(width),
                   words[5] == "0", words[6] == "-"};
  }
  signal.scale = std::stod(words[7]);
  signal.offset = std::stod(words[8]);
  signal.least = std::stod(words[9]);
  signal.most = std::stod(words[10]);
  return signal;
}

}  // namespace

std::vector<DbcMessage> read_dbc(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be read", file.string()));
  }
  std::vector<DbcMessage> messages;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::string word = begin == std::string::npos ? "" : line.substr(begin, 4);
    std::smatch words;
    try {
      if (word == "BO_ " && std::regex_match(line, words, message_line())) {
        messages.push_back(message_of(words));
      } else if (word == "SG_ " && !messages.empty() &&
                 std::regex_match(line, words, signal_line())) {
        messages.back().signal.push_back(signal_of(words));
      } else if (word == "BO_ " || word == "SG_ ") {
        throw std::invalid_argument("not as a DBC has it");
      }
    } catch (const std::logic_error&) {  // Also of a number that is none.
      throw std::runtime_error(
          fmt::format("{}:{}: not as a DBC has it: {}", file.string(), number, line));
    }
  }
  return messages;
}

}  // namespace graben::machines
