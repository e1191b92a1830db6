// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/output_file.hpp"
#include "app/export/mcap_export.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct ExportCommand {
  std::string log;
  std::string mcap;
  bool force = false;
};

/// What an export lacks of a machine that speaks on a bus of its own, or has IMUs: its frames mean
/// what a profile says, and a log has none.
std::string foreign_text(const std::map<std::uint32_t, std::size_t>& foreign) {
  constexpr std::size_t kNamed = 8;
  std::size_t all = 0;
  std::string ids;
  std::size_t named = 0;
  for (const auto& [id, count] : foreign) {
    all += count;
    if (++named <= kNamed) {
      ids += fmt::format("{}0x{:X}", ids.empty() ? "" : ", ", id);
    }
  }
  return fmt::format(
      "{} frames are no messages of our DBC (IMUs, or a bus of the machine's own), and left out; "
      "their ids: {}{}\n",
      all, ids, named > kNamed ? fmt::format(" and {} more", named - kNamed) : "");
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
  try {
    counts = app_export::export_mcap(options.log, partial);
    fs::rename(partial, options.mcap);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
  fmt::print("{}: {} messages on {} channels, {:.2f} s\n", options.mcap, counts.messages,
             counts.channels, counts.duration_s);
  if (!counts.foreign.empty()) {
    fmt::print("{}", foreign_text(counts.foreign));
  }
  if (counts.late > 0) {
    fmt::print("{} frames had a stamp before that of the frame before them, and have its stamp\n",
               counts.late);
  }
}

}  // namespace

void add_export(CLI::App& app, int& status) {
  auto options = std::make_shared<ExportCommand>();
  CLI::App* command = app.add_subcommand("export",
                                         "A log (candump -L) for other tools: MCAP, which Foxglove "
                                         "and PlotJuggler open. A channel for "
                                         "each message of the bus, in SI units; the controller's "
                                         "state in words; its faults as events");
  command->add_option("log", options->log, "candump log, plain or gzip")->required();
  command->add_option("--mcap", options->mcap, "File to write")->required();
  command->add_flag("--force", options->force, "Overwrite it");
  add_examples(*command, {"export out/dig.log --mcap out/dig.mcap"});
  command->callback(
      [options, &status] { status = guarded("export", [&] { export_log(*options); }); });
}

}  // namespace graben::cli
