// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command_table.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace graben::cli {

const CommandRow* command_row(const std::string& name) {
  for (const CommandRow& row : kCommands) {
    if (name == row.name) {
      return &row;
    }
  }
  return nullptr;
}

CLI::App* add_command(CLI::App& app, const std::string& name) {
  const CommandRow* row = command_row(name);
  if (row == nullptr) {
    throw std::logic_error(name + ": not in the table of commands");
  }
  return app.add_subcommand(name, row->help);
}

}  // namespace graben::cli
