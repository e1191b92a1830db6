// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/identify/verdict/verdict.hpp"
#include "app/reports/verdict/verdict_report.hpp"

namespace graben::cli {
namespace {

struct VerdictCommand {
  std::string log;
  std::string dbc;
  std::string source;
  std::string html;
  std::string summary;
  double reach_m = 0.0;
};

/// "0x82" or "130"; below 0: none was told.
int address_of(const std::string& text) {
  if (text.empty()) {
    return -1;
  }
  const bool hex = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  const char* begin = text.data() + (hex ? 2 : 0);
  const char* end = text.data() + text.size();
  int address = -1;
  const auto read = std::from_chars(begin, end, address, hex ? 16 : 10);
  if (read.ec != std::errc{} || read.ptr != end || address < 0 || address > 255) {
    throw std::runtime_error(
        fmt::format("--source {}; allowed: an address of J1939, 0 .. 255 or 0x00 .. 0xFF", text));
  }
  return address;
}

identify::SignalLog read_log(const VerdictCommand& options) {
  if (!identify::is_bus_log(options.log)) {
    if (!options.dbc.empty()) {
      throw std::runtime_error(fmt::format(
          "{}: is a table, which no --dbc reads; allowed: a log of frames", options.log));
    }
    return identify::read_csv_log(options.log);
  }
  identify::BusAsk ask{options.dbc, address_of(options.source)};
  try {
    return identify::read_bus_log(options.log, ask);
  } catch (const identify::UnknownBus& error) {
    if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) {
      throw;
    }
    fmt::print(stderr, "{}\nDBC file or bus profile: ", error.what());
    if (!std::getline(std::cin, ask.dbc) || ask.dbc.empty()) {
      throw;
    }
    return identify::read_bus_log(options.log, ask);
  }
}

void run(const VerdictCommand& options) {
  assert_apart({options.log, options.dbc}, {options.html, options.summary});
  for (const std::string& file : {options.html, options.summary}) {
    if (!file.empty()) {
      assert_writable(file);
    }
  }
  identify::VerdictAsk ask;
  ask.reach_m = options.reach_m;
  identify::Verdict verdict;
  {
    ProgressBar bar("verdict");
    bar.show(0.0, "reads");
    ask.progress = [&bar](double share, const std::string& where) { bar.show(share, where); };
    verdict = identify::judge_log(read_log(options), ask);
  }
  if (!options.html.empty()) {
    write_whole(options.html, reports::verdict_page(verdict));
  }
  if (!options.summary.empty()) {
    write_whole(options.summary, identify::verdict_json(verdict));
  }
  fmt::print("{}", identify::verdict_text(verdict));
  if (!options.html.empty()) {
    fmt::print("page     {}\n", options.html);
  }
}

}  // namespace

void add_verdict(CLI::App& app, int& status) {
  auto options = std::make_shared<VerdictCommand>();
  CLI::App* command = add_command(app, "verdict");
  command
      ->add_option("LOG", options->log,
                   "A table (CSV, plain or gzip) with a header, or a log of frames (candump, ASC, "
                   "TRC, BLF)")
      ->required();
  command->add_option(
      "--dbc", options->dbc,
      "How frames of another bus than ours are read: a DBC, whose signals' names say "
      "what they are, or a bus profile, file or shipped name");
  command->add_option(
      "--source", options->source,
      "Source address of the machine that counts, as 0x82, where several send the same");
  command->add_option("--html", options->html, "The verdict as one HTML page");
  command
      ->add_option("--reach", options->reach_m,
                   "Boom, arm and bucket in a line, m, 0.5 .. 30, for the tip's error; as a 22 t "
                   "excavator has it unless told")
      ->check(number_between(0.5, 30.0));
  command->add_option("--summary", options->summary, "Figures as JSON");
  add_examples(*command, {"verdict out/dig.log --html out/verdict.html", "verdict monday.csv",
                          "verdict drive.blf --dbc machine.dbc"});
  command->callback([options, &status] { status = guarded("verdict", [&] { run(*options); }); });
}

}  // namespace graben::cli
