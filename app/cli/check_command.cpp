// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/machines/new/origin.hpp"
#include "app/machines/simulated/key_reference.hpp"
#include "app/reports/check/machine_check.hpp"
#include "app/reports/check/stop_table.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct CheckCommand {
  std::string profile;
  std::string bus;
  std::string out = "out";
  bool strict = false;
  bool keys = false;
  bool stopping = false;
  std::optional<double> stop_within_m;

  [[nodiscard]] bool stops() const { return stopping || stop_within_m; }
};

void put_on(const std::string& bus, machines::ExcavatorMachine& machine) {
  if (!bus.empty()) {
    machines::put_on_bus(bus, machine);
  }
}

/// Adds how far the machine goes on, and warns where that is too far.
template <class Machine>
void add_stops(const CheckCommand& options, const Machine& machine, reports::MachineCheck& found) {
  if (!options.stops()) {
    return;
  }
  const std::vector<runs::Stopping> stops = runs::stopping(machine);
  found.tables.push_back(reports::stop_table(stops));
  if (options.stop_within_m) {
    const std::vector<reports::Warning> late =
        reports::stop_warnings(stops, *options.stop_within_m);
    found.warnings.insert(found.warnings.end(), late.begin(), late.end());
  }
}

reports::MachineCheck check_of(const fs::path& file, const CheckCommand& options) {
  const std::string& bus = options.bus;
  const bool is_simulated = fs::is_regular_file(machines::simulation_file(file));
  if (options.stops() && !is_simulated) {
    throw std::runtime_error(
        fmt::format("--stopping: {} is not there, and only a simulation can be stopped",
                    machines::simulation_file(file).string()));
  }
  if (machines::profile_kind(file) == machines::MachineKind::kDozer) {
    if (!bus.empty()) {
      throw std::runtime_error(
          fmt::format("--bus {}: a dozer is on no bus but ours; allowed: an excavator", bus));
    }
    if (is_simulated) {
      const machines::SimulatedDozer machine = machines::load_simulated_dozer(file);
      reports::MachineCheck found = reports::check_machine(machine, &machine);
      add_stops(options, machine, found);
      return found;
    }
    return reports::check_machine(machines::load_dozer(file), nullptr);
  }
  if (is_simulated) {
    machines::SimulatedExcavator machine = machines::load_simulated_excavator(file);
    put_on(bus, machine);
    reports::MachineCheck found = reports::check_machine(machine, &machine);
    add_stops(options, machine, found);
    return found;
  }
  machines::ExcavatorMachine machine = machines::load_excavator(file);
  put_on(bus, machine);
  return reports::check_machine(machine, nullptr);
}

/// Of a profile by new-machine: how much of it is another machine's.
void add_origin(const fs::path& file, reports::MachineCheck& found) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (const auto origin = machines::origin_of(text)) {
    found.tables.push_back({"What is not this machine's own",
                            {},
                            {},
                            fmt::format("{}; to be checked before anything moves: `grep '# as {}'`",
                                        machines::origin_text(*origin), origin->like)});
  }
}

void check(const CheckCommand& options) {
  if (options.keys) {
    fmt::print("{}", machines::key_reference());
    return;
  }
  if (options.profile.empty()) {
    throw std::runtime_error("which profile? a file or a shipped name, or --keys");
  }
  const fs::path file = machines::find_profile(options.profile);
  reports::MachineCheck found = check_of(file, options);
  add_origin(file, found);
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
  command->add_flag(
      "--stopping", options->stopping,
      "Stop the simulated machine from outside, by speed and load, and say how far it "
      "goes on");
  command
      ->add_option("--stop-within", options->stop_within_m,
                   "Distance at which a detector says stop, m: the same, and a warning where that "
                   "comes too late")
      ->check(number_between(0.0, 100.0));
  command->add_flag("--strict", options->strict, "Warnings end with status 1 too");
  command->add_flag("--keys", options->keys,
                    "Print the reference of all keys of all profiles, in markdown, instead");
  add_examples(*command, {"check excavator_22t", "check mine.toml --strict",
                          "check dozer_9t --stop-within 0.5"});
  command->callback([options, &status] { status = guarded("check", [&] { check(*options); }); });
}

}  // namespace graben::cli
