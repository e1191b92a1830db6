// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
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
  if (counts.foreign > 0) {
    fmt::print("{} frames are no messages of ours, and left out\n", counts.foreign);
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
