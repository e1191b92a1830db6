// SPDX-License-Identifier: Apache-2.0
/// The commands as data: what man pages and the shell's completion are made of.

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/help.hpp"
#include "app/machines/bus_file.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::cli {
namespace {

using nlohmann::ordered_json;

/// What of ours goes in the place of a file's name.
std::vector<std::string> shipped_words(const std::string& option) {
  if (option == "--profile" || option == "profile" || option == "--like" || option == "--before") {
    return machines::shipped_profile_names();
  }
  if (option == "--simulated") {
    return machines::shipped_simulation_names();
  }
  if (option == "--task") {
    return machines::shipped_task_names();
  }
  return option == "--bus" ? machines::shipped_bus_names() : std::vector<std::string>{};
}

void add_options(const CLI::App& app, ordered_json& options) {
  for (const CLI::Option* option : app.get_options()) {
    if (app.get_name().empty() && option == app.get_help_ptr()) {
      continue;
    }
    const bool is_named = option->nonpositional();
    ordered_json one;
    one["names"] = option->get_name(!is_named, is_named);
    one["argument"] = argument_text(*option);
    one["help"] = option_help(*option);
    one["words"] = option_words(*option);
    one["shipped"] = shipped_words(option->get_name());
    options.push_back(one);
  }
  for (const CLI::App* group : app.get_subcommands({})) {
    if (group->get_name().empty()) {
      add_options(*group, options);
    }
  }
}

ordered_json described(const CLI::App& app) {
  ordered_json command;
  command["name"] = app.get_name();
  command["help"] = app.get_description();
  command["options"] = ordered_json::array();
  add_options(app, command["options"]);
  command["footer"] = app.get_footer();
  command["commands"] = ordered_json::array();
  for (const CLI::App* below : app.get_subcommands({})) {
    if (!below->get_name().empty()) {
      command["commands"].push_back(described(*below));
    }
  }
  return command;
}

}  // namespace

std::string description_json(const CLI::App& app) { return described(app).dump(1) + "\n"; }

std::string description_json(const CLI::App& app, const std::map<std::string, std::string>& said) {
  std::map<std::string, ordered_json> commands;
  for (const auto& [program, text] : said) {
    const ordered_json program_said = ordered_json::parse(text);
    for (const ordered_json& command : program_said["commands"]) {
      commands[command["name"].get<std::string>()] = command;
    }
  }
  ordered_json all = described(app);
  for (ordered_json& command : all["commands"]) {
    const auto found = commands.find(command["name"].get<std::string>());
    if (found == commands.end()) {
      throw std::logic_error(fmt::format("{}: no program has it", command["name"].dump()));
    }
    command = found->second;
    commands.erase(found);
  }
  if (!commands.empty()) {
    throw std::logic_error(fmt::format("{}: not in the table", commands.begin()->first));
  }
  return all.dump(1) + "\n";
}

}  // namespace graben::cli
