// SPDX-License-Identifier: Apache-2.0
/// Wrong usage in the tool's own words: what CLI11 found, without its texts.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/cli/help.hpp"
#include "app/machines/near_word.hpp"

namespace graben::cli {
namespace {

/// The command that the line is for, and its name in full.
struct Called {
  const CLI::App* app;
  std::string name;
};

Called called(const CLI::App& app) {
  Called found{&app, app.get_name()};
  for (auto below = app.get_subcommands(); !below.empty(); below = found.app->get_subcommands()) {
    // An option group is a command without a name.
    const CLI::App* next = below.back();
    if (next->get_name().empty()) {
      break;
    }
    found = {next, found.name + " " + next->get_name()};
  }
  return found;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (!command->get_name().empty()) {
      names.push_back(command->get_name());
    }
  }
  return names;
}

void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional()) {
      names.push_back(option->get_name());
    }
  }
  for (const CLI::App* group : app.get_subcommands({})) {
    if (group->get_name().empty()) {
      add_option_names(*group, names);
    }
  }
}

std::string unknown_text(const CLI::App& app, const std::string& word) {
  if (!word.empty() && word[0] == '-') {
    std::vector<std::string> names;
    add_option_names(app, names);
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("{} is no option{}", name, machines::near_word_hint(name, names));
  }
  const std::vector<std::string> commands = command_names(app);
  if (commands.empty()) {
    return fmt::format("'{}' is one word too many", word);
  }
  if (word == "help" || word == "version") {
    return fmt::format("'{0}' is no command; did you mean '--{0}'?", word);
  }
  return fmt::format("'{}' is no command{}", word, machines::near_word_hint(word, commands));
}

/// "--a SEPARATOR --b" in our words, or all of it as it is.
std::string pair_text(const std::string& what, const char* separator, const char* ours) {
  const std::size_t at = what.find(separator);
  return at == std::string::npos
             ? what
             : what.substr(0, at) + ours + what.substr(at + std::string(separator).size());
}

std::string count_text(const CLI::App& app, const std::string& name) {
  const CLI::Option* option = app.get_option_no_throw(name);
  const int wanted = option != nullptr ? option->get_expected_min() : 1;
  const bool is_list = wanted > 1;
  return is_list ? fmt::format("{}: {} values are wanted, with commas between them", name, wanted)
                 : fmt::format("{}: one value is wanted", name);
}

/// "A,B" with room after the comma.
std::string spaced(std::string list) {
  for (std::size_t comma = list.find(','); comma != std::string::npos;
       comma = list.find(',', comma + 2)) {
    list.insert(comma + 1, " ");
  }
  return list;
}

std::string of_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::string what = error.what();
  const std::string name = what.substr(0, what.find_first_of(": "));
  const std::vector<std::string> left = app.remaining(true);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    if (!left.empty()) {
      return unknown_text(app, left.front());
    }
    if (what.find("subcommand") == std::string::npos) {
      return what.find('[') == std::string::npos
                 ? what
                 : fmt::format("{} of these: {}",
                               what.find("most") == std::string::npos ? "one" : "only one",
                               spaced(what.substr(what.find('[') + 1,
                                                  what.find(']') - what.find('[') - 1)));
    }
    return fmt::format("which command? {}", fmt::join(command_names(app), ", "));
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !left.empty()) {
    return unknown_text(app, left.front());
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    return pair_text(what, " excludes ", ": not with ");
  }
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    return pair_text(what, " requires ", ": only with ");
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const std::size_t dashes = what.find("--");
    const std::size_t end = what.find_first_of(":, ", dashes);
    return count_text(app, dashes == std::string::npos ? name : what.substr(dashes, end - dashes));
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    const std::size_t dashes = what.find("--");
    return fmt::format("{} is not a number", dashes == std::string::npos
                                                 ? what
                                                 : pair_text(what.substr(dashes), " = ", ": "));
  }
  return what;
}

std::string refusal(const std::string& name, const std::string& what) {
  return fmt::format("{}: {}\n`{} --help` says more\n", name, what, name);
}

/// Of a shell's variable that is not set a word is left without a letter, or `--out=`: nothing that
/// anybody means.
std::string empty_word(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* at = &app;
  std::string name = app.get_name();
  std::string before;
  for (const std::string& word : words) {
    const bool is_option = word.rfind("--", 0) == 0;
    if (word.empty() || (is_option && word.find('=') + 1 == word.size())) {
      const std::string of = is_option                    ? word.substr(0, word.size() - 1)
                             : before.rfind("--", 0) == 0 ? before
                                                          : "an argument";
      return refusal(name, of + ": is empty; is it a variable of the shell that is not set?");
    }
    const std::vector<std::string> commands = command_names(*at);
    if (std::find(commands.begin(), commands.end(), word) != commands.end()) {
      at = at->get_subcommand(word);
      name += " " + word;
    }
    before = word;
  }
  return "";
}

}  // namespace

std::string command_slip(const CLI::App& app, const std::vector<std::string>& words) {
  if (std::string empty = empty_word(app, words); !empty.empty()) {
    return empty;
  }
  const CLI::App* at = &app;
  std::string name = app.get_name();
  for (const std::string& word : words) {
    const std::vector<std::string> commands = command_names(*at);
    if (commands.empty() || (word.rfind('-', 0) == 0 && at->get_option_no_throw(word) != nullptr)) {
      return "";
    }
    if (std::find(commands.begin(), commands.end(), word) == commands.end()) {
      const std::string what = unknown_text(*at, word);
      const bool is_hinted = word[0] != '-' || what.find("did you mean") != std::string::npos;
      return refusal(name, what + (is_hinted ? "" : " here; options come after the command"));
    }
    at = at->get_subcommand(word);
    name += " " + word;
  }
  return "";
}

std::string usage_text(const CLI::App& app, const CLI::ParseError& error) {
  const Called at = called(app);
  return refusal(at.name, of_error(*at.app, error));
}

}  // namespace graben::cli
