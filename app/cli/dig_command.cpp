#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/dig_report.hpp"
#include "app/cli/dig_run.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/progress_bar.hpp"

namespace graben::cli {
namespace {

/// Where the run starts unless told: above the path's far upper corner, as a bucket comes down.
constexpr double kStartAbove_m = 0.6;
constexpr double kStartBack_m = 0.8;

struct Options {
  std::string profile = "excavator_22t";
  std::string out = "out";
  std::string summary;
  std::vector<double> start_strokes_m;
  std::vector<double> start_pose;
  bool random_start = false;
  std::uint64_t seed = 1;
  double speed = 1.0;
  double loops = 1.0;
};

Eigen::Vector3d strokes_at(const ExcavatorKinematics& kinematics, const TipPose& pose) {
  const StrokeResult strokes = kinematics.strokes_from_pose(pose);
  if (strokes.status != ReachStatus::kOk) {
    throw std::runtime_error(
        fmt::format("start pose x {} m, y {} m, attitude {} rad is outside the work space",
                    pose.x_m, pose.y_m, pose.attitude_rad));
  }
  return strokes.strokes_m;
}

Eigen::Vector3d random_strokes(const ExcavatorGeometry& geometry, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::Vector3d strokes_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    // Written out, because the standard leaves open what uniform_real_distribution draws.
    const double share = static_cast<double>(random() >> 11) * 0x1p-53;
    strokes_m[i] = share * geometry.cylinder[i].stroke_m;
  }
  return strokes_m;
}

Eigen::Vector3d start_strokes(const Options& options, const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  if (options.random_start) {
    return random_strokes(profile.geometry, options.seed);
  }
  if (!options.start_strokes_m.empty()) {
    const Eigen::Vector3d strokes_m(options.start_strokes_m[0], options.start_strokes_m[1],
                                    options.start_strokes_m[2]);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const double most_m = profile.geometry.cylinder[i].stroke_m;
      if (!(strokes_m[i] >= 0.0 && strokes_m[i] <= most_m)) {
        throw std::runtime_error(fmt::format(
            "--start-strokes: entry {} is {} m; allowed: 0 .. {} m", i + 1, strokes_m[i], most_m));
      }
    }
    return strokes_m;
  }
  if (!options.start_pose.empty()) {
    return strokes_at(kinematics,
                      {options.start_pose[0], options.start_pose[1], options.start_pose[2]});
  }
  const DigPath& path = profile.dig_path;
  return strokes_at(kinematics, {path.x_max_m - kStartBack_m, path.y_max_m + kStartAbove_m,
                                 path.attitude_at_x_max_rad});
}

const char* end_text(DigEnd end) {
  switch (end) {
    case DigEnd::kDone:
      return "done";
    case DigEnd::kPathNotReached:
      return "the path was not reached in time";
    case DigEnd::kLoopNotClosed:
      return "the loop was not closed in time";
    case DigEnd::kFault:
      return "the controller stopped with a fault";
  }
  return "unknown";
}

/// CLI::Range lets "nan" pass.
CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        const bool inside =
            CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? std::string()
                      : fmt::format("{} is not a number from {} to {}", text, least, most);
      },
      fmt::format("{} .. {}", least, most));
}

/// An unsigned option takes "-1" for its largest value.
CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const bool digits = !text.empty() && text.size() <= 18 &&
                            text.find_first_not_of("0123456789") == std::string::npos;
        return digits ? std::string() : fmt::format("{} is not a whole number from 0", text);
      },
      "0 ..");
}

void dig(const Options& options) {
  const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile(options.profile));
  DigOptions run_options;
  run_options.start_strokes_m = start_strokes(options, machine.profile);
  run_options.speed_override_ratio = options.speed;
  run_options.loops = options.loops;
  const std::filesystem::path out(options.out);
  std::filesystem::create_directories(out);
  run_options.log_file = out / "dig.log";

  DigResult result;
  {
    ProgressBar bar("dig");
    result = run_dig(machine, run_options,
                     [&](double share, const std::string& where) { bar.show(share, where); });
  }
  const DigSummary summary = summarise(result);
  const std::filesystem::path report = out / "dig.html";
  write_dig_report(
      report, machine, result, summary,
      fmt::format("{} | start strokes {:.3f}, {:.3f}, {:.3f} m | speed {:.0f} %", machine.name,
                  run_options.start_strokes_m[0], run_options.start_strokes_m[1],
                  run_options.start_strokes_m[2], options.speed * 100.0));
  if (!options.summary.empty()) {
    write_dig_summary(options.summary, summary);
  }
  fmt::print("{}log     {}\nreport  {}\n", dig_table(summary), run_options.log_file.string(),
             report.string());
  if (result.end != DigEnd::kDone) {
    throw std::runtime_error(
        fmt::format("{} (fault code {})", end_text(result.end), static_cast<int>(result.fault)));
  }
}

}  // namespace

void add_dig(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "dig", "Dig round Kim's path on the simulated machine, over a CAN bus in memory");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for dig.log and dig.html")
      ->capture_default_str();
  command->add_option("--summary", options->summary, "Write the figures as JSON to this file");
  command->add_option("--seed", options->seed, "Of --random-start, a whole number from 0")
      ->check(whole_number())
      ->capture_default_str();
  auto* start = command->add_option_group("start", "Where the bucket starts");
  start->add_option("--start-strokes", options->start_strokes_m, "Boom,arm,bucket in m")
      ->delimiter(',')
      ->expected(3);
  start->add_option("--start", options->start_pose, "Tip x,y in m and attitude in rad")
      ->delimiter(',')
      ->expected(3);
  start->add_flag("--random-start", options->random_start,
                  "Any pose of the work space, drawn from the seed");
  start->require_option(0, 1);
  command->add_option("--speed", options->speed, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
  command->add_option("--loops", options->loops, "Times round the path, 0.1 .. 100")
      ->check(number_between(0.1, 100.0))
      ->capture_default_str();
  command->callback([options, &status] { status = guarded("dig", [&] { dig(*options); }); });
}

}  // namespace graben::cli
