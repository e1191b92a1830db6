// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/output_file.hpp"
#include "app/reports/compare/compare_report.hpp"
#include "app/runs/logged_machine.hpp"
#include "app/scope/page/scope_page.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct CompareCommand {
  std::string first;
  std::string second;
  std::string profile;
  std::string bus;
  std::string out = "out";
};

void compare(const CompareCommand& options) {
  const fs::path out(options.out);
  const fs::path report = out / "compare.html";
  assert_apart({options.first, options.second}, {report.string()});
  const runs::RunLog first = runs::read_run_log(options.first);
  const runs::RunLog second = runs::read_run_log(options.second);
  const std::vector<runs::ComparedFigure> figures = runs::compared_figures(first, second);
  reports::SetupOptions setup;
  if (!options.profile.empty()) {
    setup.profile = options.profile;
  }
  if (!options.bus.empty()) {
    setup.bus = options.bus;
  }
  const std::vector<std::string> notes = runs::compared_notes(
      first, second,
      [&](std::uint32_t hash) { return runs::machine_words(hash, options.profile, options.bus); });
  fs::create_directories(out);
  reports::write_compare_report({report, scope::scope_page()}, options.first, first, second,
                                figures, notes, setup);
  fmt::print("{}", runs::compared_table(first, second, figures));
  for (const std::string& note : notes) {
    fmt::print("note: {}\n", note);
  }
  for (const runs::RunLog* run : {&first, &second}) {
    for (const std::string& note : run->read.notes()) {
      fmt::print("note: {}\n", note);
    }
  }
  for (const runs::RunLog* run : {&first, &second}) {
    if (run->first_fault_s) {
      fmt::print("{}: fault {}, {}\n", run->name, static_cast<int>(run->first_fault),
                 runs::fault_words(run->first_fault));
    }
  }
  fmt::print("report  {}\n", report.string());
}

}  // namespace

void add_compare(CLI::App& app, int& status) {
  auto options = std::make_shared<CompareCommand>();
  CLI::App* command = add_command(app, "compare");
  command->add_option("first", options->first, "candump log, plain or gzip")->required();
  command->add_option("second", options->second, "candump log, plain or gzip")->required();
  command->add_option("--profile", options->profile,
                      "Machine profile beside the shipped ones: file or shipped name");
  command->add_option(
      "--bus", options->bus,
      "Bus profile beside the shipped ones that a run's machine was put on: a file, "
      "or a shipped name");
  command->add_option("--out", options->out, "Folder for compare.html")->capture_default_str();
  add_examples(*command, {"compare out/dig.log out/soil/dig.log"});
  command->callback(
      [options, &status] { status = guarded("compare", [&] { compare(*options); }); });
}

}  // namespace graben::cli
