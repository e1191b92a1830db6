// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/machines/simulated/key_reference.hpp"
#include "app/reports/check/machine_check.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct CheckCommand {
  std::string profile;
  std::string bus;
  std::string out = "out";
  bool strict = false;
  bool keys = false;
};

void put_on(const std::string& bus, machines::ExcavatorMachine& machine) {
  if (!bus.empty()) {
    machines::put_on_bus(bus, machine);
  }
}

/// `bus`: the bus profile that an excavator is put on; empty: its own.
reports::MachineCheck check_of(const fs::path& file, const std::string& bus) {
  const bool is_simulated = fs::is_regular_file(machines::simulation_file(file));
  if (machines::profile_kind(file) == machines::MachineKind::kDozer) {
    if (!bus.empty()) {
      throw std::runtime_error(
          fmt::format("--bus {}: a dozer is on no bus but ours; allowed: an excavator", bus));
    }
    if (is_simulated) {
      const machines::SimulatedDozer machine = machines::load_simulated_dozer(file);
      return reports::check_machine(machine, &machine);
    }
    return reports::check_machine(machines::load_dozer(file), nullptr);
  }
  if (is_simulated) {
    machines::SimulatedExcavator machine = machines::load_simulated_excavator(file);
    put_on(bus, machine);
    return reports::check_machine(machine, &machine);
  }
  machines::ExcavatorMachine machine = machines::load_excavator(file);
  put_on(bus, machine);
  return reports::check_machine(machine, nullptr);
}

void check(const CheckCommand& options) {
  if (options.keys) {
    fmt::print("{}", machines::key_reference());
    return;
  }
  if (options.profile.empty()) {
    throw std::runtime_error("which profile? a file or a shipped name, or --keys");
  }
  const reports::MachineCheck found =
      check_of(machines::find_profile(options.profile), options.bus);
  const fs::path out(options.out);
  fs::create_directories(out);
  const fs::path page = out / "check.html";
  std::ofstream stream(page, std::ios::binary);
  stream << reports::check_page(found);
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", page.string()));
  }
  fmt::print("{}\ndrawing  {}\n", reports::check_text(found), page.string());
  if (options.strict && !found.warnings.empty()) {
    throw std::runtime_error(fmt::format("{} warnings, and --strict", found.warnings.size()));
  }
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto options = std::make_shared<CheckCommand>();
  CLI::App* command = add_command(app, "check");
  command->add_option("profile", options->profile, "Machine profile: file or shipped name");
  command->add_option("--bus", options->bus,
                      "Bus profile that the machine is put on, a file or a shipped one such as "
                      "zx200, with the stand-ins that it needs: what it then does without");
  command->add_option("--out", options->out, "Folder for check.html")->capture_default_str();
  command->add_flag("--strict", options->strict, "Warnings end with status 1 too");
  command->add_flag("--keys", options->keys,
                    "Print the reference of all keys of all profiles, in markdown, instead");
  add_examples(*command, {"check excavator_22t", "check mine.toml --strict"});
  command->callback([options, &status] { status = guarded("check", [&] { check(*options); }); });
}

}  // namespace graben::cli
