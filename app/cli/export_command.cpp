// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/output_file.hpp"
#include "app/export/mcap_export.hpp"
#include "app/machines/bus_file.hpp"
#include "app/runs/logged_machine.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct ExportCommand {
  std::string log;
  std::string mcap;
  std::string bus;
  bool force = false;
};

/// Shipped bus profiles that have most of these ids.
std::string likely_bus(const std::map<app_export::CanId, std::size_t>& foreign) {
  std::string likely;
  std::size_t most = 1;  // A single id may be anything.
  for (const std::string& name : machines::shipped_bus_names()) {
    const BusTable table = machines::load_bus(machines::find_bus(name)).table;
    std::size_t known = 0;
    for (std::size_t i = 0; i < table.message_count; ++i) {
      known += foreign.count({table.rule[i].extended, table.rule[i].id});
    }
    if (known > most) {
      most = known;
      likely = name;
    }
  }
  return likely;
}

/// What an export lacks of a machine that speaks on a bus of its own: its frames mean what a bus
/// profile says, and a log has none.
std::string foreign_text(const std::map<app_export::CanId, std::size_t>& foreign,
                         const std::string& bus) {
  constexpr std::size_t kNamed = 8;
  std::size_t all = 0;
  std::string ids;
  std::size_t named = 0;
  for (const auto& [id, count] : foreign) {
    all += count;
    if (++named <= kNamed) {
      ids += fmt::format("{}0x{:X}", ids.empty() ? "" : ", ", id.second);
    }
  }
  const std::string likely = likely_bus(foreign);
  return fmt::format(
      "left out: {} frames with ids that {}: {}{}{}\n", all,
      bus.empty() ? "our DBC does not have"
                  : fmt::format("neither our DBC nor bus profile {} has", bus),
      ids, named > kNamed ? fmt::format(" and {} more", named - kNamed) : "",
      !likely.empty() ? fmt::format("; bus profile {} has most of them: --bus {}", likely, likely)
      : bus.empty()   ? "; --bus NAME takes what a bus profile says of a machine's own bus"
                      : "");
}

/// The bus that was told, else the shipped one that the log's machine was put on; its name too.
std::optional<machines::BusFile> bus_of(const std::string& told, std::uint32_t profile_hash,
                                        std::string& name) {
  name = told;
  if (told.empty() && profile_hash != 0) {
    const std::optional<runs::LoggedMachine> machine = runs::machine_of_hash(profile_hash);
    name = machine ? machine->bus : "";
  }
  return name.empty() ? std::nullopt : std::optional(machines::load_bus(machines::find_bus(name)));
}

void export_log(const ExportCommand& options) {
  assert_apart({options.log}, {options.mcap});
  if (fs::exists(options.mcap) && !options.force) {
    throw std::runtime_error(
        fmt::format("{}: is there already; --force overwrites it", options.mcap));
  }
  assert_writable(options.mcap);
  const fs::path partial = fmt::format("{}.part-{}", options.mcap, getpid());
  app_export::ExportCounts counts;
  std::string bus;
  try {
    counts = app_export::export_mcap(options.log, partial, [&](std::uint32_t profile_hash) {
      return bus_of(options.bus, profile_hash, bus);
    });
    fs::rename(partial, options.mcap);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
  fmt::print("{}: {} messages on {} channels, {:.2f} s\n", options.mcap, counts.messages,
             counts.channels, counts.duration_s);
  if (!bus.empty()) {
    fmt::print("bus profile {}{}\n", bus, options.bus.empty() ? ", as the log says" : "");
  }
  if (!counts.foreign.empty()) {
    fmt::print("{}", foreign_text(counts.foreign, bus));
  }
  for (const std::string& note : counts.notes) {
    fmt::print("note: {}\n", note);
  }
}

}  // namespace

void add_export(CLI::App& app, int& status) {
  auto options = std::make_shared<ExportCommand>();
  CLI::App* command = add_command(app, "export");
  command->add_option("log", options->log, "candump log, plain or gzip")->required();
  command->add_option("--mcap", options->mcap, "File to write")->required();
  command->add_option("--bus", options->bus,
                      "Bus profile that says what the frames of a machine's own bus are, a file or "
                      "a shipped one such as zx200; the one that the log says unless told");
  command->add_flag("--force", options->force, "Overwrite it");
  add_examples(*command, {"export out/dig.log --mcap out/dig.mcap",
                          "export out/dig.log --mcap out/dig.mcap --bus zx200"});
  command->callback(
      [options, &status] { status = guarded("export", [&] { export_log(*options); }); });
}

}  // namespace graben::cli
