// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/script.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

namespace graben::timing {
namespace {

constexpr std::array<const char*, kSetups> kSetupNames = {"22t", "12t", "dozer", "bumps",
                                                          "surface"};

[[noreturn]] void refuse(const std::string& what) { throw std::runtime_error("script: " + what); }

std::uint64_t number_of(const std::string& word) {
  std::size_t used = 0;
  std::uint64_t value = 0;
  try {
    value = std::stoull(word, &used, 0);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != word.size() || word.empty()) {
    refuse("'" + word + "' is no number");
  }
  return value;
}

Setup setup_of(const std::string& word) {
  const auto* const found = std::find(kSetupNames.begin(), kSetupNames.end(), word);
  if (found == kSetupNames.end()) {
    refuse("no machine is called '" + word + "'");
  }
  return static_cast<Setup>(found - kSetupNames.begin());
}

std::vector<double> shares_of(std::string words) {
  std::replace(words.begin(), words.end(), ',', ' ');
  std::istringstream stream(words);
  std::vector<double> shares;
  for (double share = 0.0; stream >> share;) {
    shares.push_back(share);
  }
  return shares;
}

void set(Script& script, const std::string& word) {
  const std::size_t at = word.find('=');
  const std::string key = word.substr(0, at);
  const std::string value = at == std::string::npos ? "" : word.substr(at + 1);
  if (key == "cycles") {
    script.cycles = static_cast<int>(number_of(value));
  } else if (key == "seed") {
    script.seed = number_of(value);
  } else if (key == "soil") {
    script.soil = true;
  } else if (key == "start") {
    script.start = shares_of(value);
  } else if (key == "speed") {
    script.speed_ratio = static_cast<double>(number_of(value)) / 100.0;
  } else if (key == "row") {
    script.row = static_cast<int>(number_of(value));
  } else if (key == "task") {
    script.task_number = static_cast<std::uint8_t>(number_of(value));
  } else {
    refuse("'" + word + "' is not known");
  }
}

void time_of(const std::string& word, Edit& edit) {
  const std::size_t plus = word.find('+');
  if (word.empty() || word[0] != '@') {
    refuse("'" + word + "' is no @cycle");
  }
  edit.from = static_cast<int>(number_of(word.substr(1, plus - 1)));
  edit.cycles = plus == std::string::npos ? 1 : static_cast<int>(number_of(word.substr(plus + 1)));
}

Edit edit_of(const std::string& part) {
  std::istringstream stream(part);
  std::string word;
  Edit edit;
  stream >> word >> edit.what;
  time_of(word, edit);
  std::vector<std::string> words;
  while (stream >> word) {
    words.push_back(word);
  }
  // How many words each wants, and whether the first is a message.
  const bool of_message = edit.what == "raw" || edit.what == "mute" || edit.what == "wrong" ||
                          edit.what == "as" || edit.what == "length" || edit.what == "odd" ||
                          edit.what == "good" || edit.what == "flood";
  const bool of_number =
      edit.what == "late" || edit.what == "port" || edit.what == "hold" || edit.what == "speed";
  if (!of_message && !of_number && edit.what != "refuse") {
    refuse("nothing is called '" + edit.what + "'");
  }
  std::size_t at = 0;
  const auto next = [&]() -> const std::string& {
    if (at >= words.size()) {
      refuse("'" + part + "' lacks a word");
    }
    return words[at++];
  };
  if (of_message) {
    edit.message = next();
    const std::size_t dot = edit.message.find('.');
    if (dot != std::string::npos) {
      edit.other = edit.message.substr(dot + 1);
      edit.message.resize(dot);
    }
  }
  if (edit.what == "as") {
    edit.other = next();
  } else if (of_number || (of_message && edit.what != "mute" && edit.what != "wrong")) {
    edit.number = number_of(next());
  }
  if (edit.what == "flood") {
    edit.bytes = at < words.size() ? number_of(next()) : 0U;
  }
  if (at != words.size()) {
    refuse("'" + part + "' has a word too many");
  }
  return edit;
}

}  // namespace

Script parse_script(const std::string& line) {
  std::istringstream parts(line);
  std::string part;
  std::getline(parts, part, '|');
  std::istringstream head(part);
  Script script;
  std::string word;
  if (!(head >> script.group >> word)) {
    refuse("a group and a machine are wanted in '" + line + "'");
  }
  script.setup = setup_of(word);
  while (head >> word) {
    set(script, word);
  }
  while (std::getline(parts, part, '|')) {
    script.edits.push_back(edit_of(part));
  }
  return script;
}

}  // namespace graben::timing
