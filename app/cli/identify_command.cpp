#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/identify/motion_result.hpp"

namespace graben::cli {
namespace {

struct IdentifyCommand {
  std::vector<std::string> csv;
  std::vector<std::string> judge;
  std::string summary;
};

/// Before a minute's work. Leaves what is there, and nothing where nothing was.
void assert_writable(const std::string& file) {
  const bool was_there = std::filesystem::exists(file);
  if (!std::ofstream(file, std::ios::app)) {
    throw std::runtime_error(fmt::format("{}: can't be written", file));
  }
  if (!was_there) {
    std::filesystem::remove(file);
  }
}

void identify_machine(const IdentifyCommand& options) {
  const identify::MotionSplit split = identify::split_motion(
      identify::read_motion_files(options.csv), identify::read_motion_files(options.judge));
  assert_writable(options.summary);
  identify::MotionResult result;
  {
    ProgressBar bar("identify");
    identify::FitOptions fit;
    fit.progress = bar.progress();
    result = identify::identify_motion(split, fit);
  }
  std::ofstream stream(options.summary);
  stream << identify::motion_json(result);
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", options.summary));
  }
  fmt::print("{}", identify::motion_text(result));
}

}  // namespace

void add_identify(CLI::App& app, int& status) {
  auto options = std::make_shared<IdentifyCommand>();
  CLI::App* command = app.add_subcommand(
      "identify",
      "How a machine answers its commands, found from recorded motion: dead time, lags, curves of "
      "each direction, how its axes share their pumps. Judged by whole runs that were left out");
  command
      ->add_option("--csv", options->csv,
                   "Recorded motion, CSV, plain or gzip: columns run, time_s and for boom, arm, "
                   "bucket and swing command_permille_AXIS, angle_rad_AXIS, velocity_radps_AXIS")
      ->required();
  command->add_option("--judge", options->judge,
                      "The same, of runs to judge by; unless told, every fifth run of --csv is "
                      "left out");
  command->add_option("--summary", options->summary, "JSON to write")->required();
  command->callback(
      [options, &status] { status = guarded("identify", [&] { identify_machine(*options); }); });
}

}  // namespace graben::cli
