// SPDX-License-Identifier: Apache-2.0
#include "app/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/machines/near_word.hpp"
#include "app/machines/simulated/soil_kinds.hpp"
#include "app/runs/found_text.hpp"

namespace graben::cli {

void add_scenario_options(CLI::App& command, runs::DigScenario& scenario) {
  machines::Scenario& tried = scenario.scenario;
  auto* in_the_way = command.add_option_group("in the way", "What the bucket meets");
  add_soil_option(
      *in_the_way,
      [&tried](const std::string& name) {
        tried.soil = name == kKimSoil;
        tried.ground = tried.soil ? std::string() : name;
      },
      "Soil below the profile's ground line: kim, the paper's field of force, which --soil alone "
      "is, or ground that the bucket cuts, with --errors all of a strength drawn within 40 %");
  CLI::Option* air = in_the_way->add_flag(
      "--air", tried.air, "The profile's manoeuvre in the air, with a loaded bucket, instead");
  in_the_way->require_option(0, 1);
  command
      .add_flag("--obstacle", tried.obstacle,
                "A rock on the digging path that holds for a while and then comes loose")
      ->excludes(air);
  command.add_flag("--stiff-oil", tried.stiff_oil, "Oil as stiff as the paper's");
  command
      .add_option("--dead-time", tried.dead_time_s,
                  "Of every spool, s, 0 .. 0.5; the profile's unless told")
      ->check(number_between(0.0, 0.5));
  command
      .add_option(
          "--errors", scenario.errors,
          "What the controller does not know, drawn from the seed: sensors' bias and "
          "noise, its parameters, kim (both of these), all (and the machine as it is found)")
      ->check(error_name())
      ->capture_default_str();
  command
      .add_option(
          "--law", scenario.law,
          "Feedback of the controller: servo, oil (where the profile has [oil]), kim (none); "
          "the profile's unless told")
      ->check(one_of({machines::kLawNames.begin(), machines::kLawNames.end()}));
  add_swash_option(command, scenario.swash_ratio);
  add_sensor_option(command, tried.imus, tried.seconds);
  add_mounting_option(command, tried.imu_mounting_rad);
  command
      .add_option("--without", tried.without,
                  "Sensors that the machine has not: spool, swash, pressure; what stands in is in "
                  "graben check")
      ->delimiter(',')
      ->check(one_of({machines::kSensorNames.begin(), machines::kSensorNames.end()}));
  command.add_option(
      "--bus", tried.bus,
      "Bus profile of the machine, a file or a shipped one (zx200, slopes, encoders, "
      "inclinometers, aux_valves, valve_driver, retrofit), with the stand-ins that "
      "it needs and, where it does not command them, pumps at full displacement; the profile's own "
      "unless told");
  command.add_flag("--fixed-lambda", scenario.fixed_lambda,
                   "For comparison: lambda stays 1, whatever the machine can do");
}

CLI::Option& add_soil_option(CLI::App& command, const std::function<void(const std::string&)>& take,
                             const std::string& help) {
  std::vector<std::string> names = {kKimSoil};
  names.insert(names.end(), machines::kSoilNames.begin(), machines::kSoilNames.end());
  return *command.add_option_function<std::string>("--soil", take, help)
              ->expected(0, 1)
              ->default_str(kKimSoil)
              ->check(one_of(names));
}

void add_simulated_options(CLI::App& command, machines::SimulatedChoice& choice) {
  command.add_option("--simulated", choice.name,
                     "Simulated excavator in the place of the profile's own: NAME.sim.toml, or "
                     "the NAME of a shipped one");
  command
      .add_option("--hidden", choice.hidden,
                  "Seed of a machine that nobody has described, a whole number from 0: the "
                  "simulated one with edges, lags, areas, oil, masses and zeros of its own")
      ->check(whole_number());
}

void add_sensor_option(CLI::App& command, bool& imus, bool& seconds) {
  command
      .add_option_function<std::string>(
          "--sensors",
          [&imus, &seconds](const std::string& name) {
            imus = name == "imu";
            seconds = name == "second";
          },
          "What measures the joints: the profile's sensors; imu: an IMU in the middle of each link "
          "unless the profile has its own; second: a second sensor on every joint beside the "
          "profile's, unless that has its own")
      ->check(one_of({"profile", "imu", "second"}))
      ->default_str("profile");
}

void add_mounting_option(CLI::App& command, double& mounting_rad) {
  command
      .add_option("--imu-mounting", mounting_rad,
                  "Each IMU of a link is turned by up to so much against the profile, rad, 0 .. "
                  "0.2, drawn from the seed; the controller is not told (measure-up finds it)")
      ->check(number_between(0.0, 0.2))
      ->capture_default_str();
}

void add_swash_option(CLI::App& command, std::optional<double>& swash_ratio) {
  command
      .add_option("--swash", swash_ratio,
                  "Constant swash of the pumps, 0.05 .. 1, instead of what the profile says")
      ->check(number_between(0.05, 1.0));
}

void add_found_option(CLI::App& command, machines::Found& found) {
  command
      .add_option_function<std::string>(
          "--found",
          [&found](const std::string& text) {
            try {
              found = runs::found_of(text);
            } catch (const std::runtime_error& error) {
              throw CLI::ValidationError("--found", error.what());
            }
          },
          fmt::format("What the machine is, whatever is drawn; the controller is not told: {}",
                      runs::found_keys()))
      ->type_name("KEY=VALUE[,...]");
}

void add_speed_options(CLI::App& command, runs::GradeScenario& scenario) {
  command
      .add_option("--speed-mode", scenario.speed_mode,
                  "bounded by what the blade's flow allows, or, for comparison, constant: the "
                  "wanted speed, whatever the blade needs")
      ->check(one_of({"bounded", "constant"}))
      ->capture_default_str();
  command
      .add_option("--speed", scenario.speed_mps,
                  "Wanted travel speed, m/s, 0.05 .. 3; the profile's unless told")
      ->check(number_between(0.05, 3.0));
}

void add_engine_option(CLI::App& command, runs::GradeScenario& scenario) {
  command
      .add_option("--engine-rpm", scenario.engine_rpm,
                  "Of a dozer's engine, 900 .. 2200; the profile's unless told")
      ->check(number_between(900.0, 2200.0));
}

void add_ground_options(CLI::App& command, runs::GradeScenario& scenario) {
  command
      .add_option("--soil", scenario.soil,
                  "Ground that resists the blade, with --errors all of a strength drawn within 40 "
                  "%; without, nothing does, as in the paper")
      ->check(soil_name());
  command
      .add_option(
          "--pass-depth", scenario.pass_depth_m,
          "What the first pass cuts at most, m, 0.02 .. 10; the profile's unless told, in a "
          "soil no more than 0.08. The next ones go as deep as the force allows")
      ->check(number_between(0.02, 10.0));
}

void add_lateness_options(CLI::App& command, runs::GradeScenario& scenario) {
  command
      .add_option("--dead-time", scenario.dead_time_s,
                  "From a duty to the blade's first movement, s, 0 .. 0.3; the controller knows it")
      ->check(number_between(0.0, 0.3));
  command
      .add_option("--pose-latency", scenario.pose_latency_s,
                  "Age of a pose when it comes in, s, 0 .. 0.2; the controller knows it")
      ->check(number_between(0.0, 0.2));
}

void add_error_option(CLI::App& command, runs::GradeScenario& scenario) {
  command
      .add_option("--errors", scenario.errors,
                  "What the controller does not know, drawn from the seed: all (mass, ground, "
                  "efficiencies, sensors' bias and noise) or none")
      ->check(one_of({"none", "all"}))
      ->capture_default_str();
}

void add_task_options(CLI::App& command, runs::TaskScenario& scenario) {
  command.add_option("--task", scenario.task, "Task file, or the name of one of ours")
      ->capture_default_str();
  command
      .add_option("--errors", scenario.errors,
                  "What the controller does not know: none, stroke-bias, sensors, parameters, kim "
                  "(sensors and parameters), all (and the machine as it is found)")
      ->check(error_name())
      ->capture_default_str();
  command
      .add_option("--soil", scenario.soil,
                  "Ground at the height of the tracks that the bucket cuts: sand, loam, clay, "
                  "stones; with --errors all of a strength drawn within 40 %. No ground unless "
                  "told")
      ->check(soil_name());
  add_found_option(command, scenario.found);
  command
      .add_option("--start", scenario.start,
                  "Teeth x,y,z in m and attitude in rad that the machine stands at; where the "
                  "task begins unless told")
      ->delimiter(',')
      ->expected(4);
  add_override_option(command, scenario.speed_override_ratio);
  add_swash_option(command, scenario.swash_ratio);
  add_sensor_option(command, scenario.imus, scenario.seconds);
  command
      .add_option("--duration", scenario.duration_s,
                  "Of the first straight step, s; longer where a drive's limit asks for it")
      ->check(number_between(0.1, 3600.0));
  command
      .add_option(
          "--rounds", scenario.rounds,
          "Of a task that repeats and does not say itself how often, 1 .. 1000; once unless "
          "told")
      ->check(whole_number_between(1, 1000));
  command
      .add_option("--word-after", scenario.word_after_s,
                  "At a wait the operator asks for the task anew after so long, s; 3 unless told")
      ->check(number_between(0.0, 3600.0));
}

void add_profile_option(CLI::App& command, std::string& profile) {
  command.add_option("--profile", profile, "Machine profile: file or shipped name")
      ->capture_default_str();
}

void add_summary_option(CLI::App& command, std::string& summary) {
  command.add_option("--summary", summary, "Write the figures as JSON to this file");
}

void add_fault_option(CLI::App& command, std::vector<std::string>& faults,
                      const std::string& more) {
  command.add_option("--fault", faults,
                     "A fault of the machine, NAME@SECONDS or NAME=VALUE@SECONDS, as "
                     "boom-stroke:drift=0.01@5; more of them by naming it again. It stays, and an "
                     "11-bit frame 7F0 says when it begins. An unknown name lists those there are" +
                         more);
}

void add_seconds_option(CLI::App& command, std::optional<double>& most_s,
                        const std::string& usual) {
  command
      .add_option("--seconds", most_s,
                  "Give it up after this simulated time, 1 .. 1e6 s; unless told " + usual)
      ->check(number_between(1.0, 1e6));
}

void add_override_option(CLI::App& command, double& speed_override_ratio) {
  command.add_option("--speed", speed_override_ratio, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
}

namespace {
constexpr const char* kSlow = "slow";
}  // namespace

void add_unknown_drives_option(CLI::App& command, std::string& how) {
  command
      .add_option(
          "--unknown-drives", how,
          fmt::format("slow: where the profile is from `graben identify` and the task needs "
                      "drives that were not commissioned, at {:.0f} % of the speed; "
                      "refused unless told",
                      100.0 * machines::kUnknownSpeed))
      ->check(one_of({kSlow}));
}

namespace {

machines::UnknownTask told(const std::string& how) {
  return how == kSlow ? machines::UnknownTask::kSlow : machines::UnknownTask::kRefused;
}

std::string printed(const std::string& notice) {
  if (!notice.empty()) {
    fmt::print("{}\n", notice);
  }
  return notice;
}

}  // namespace

std::string demand_known(machines::ExcavatorMachine& machine, const machines::NeededDrives& needed,
                         const std::string& how) {
  return printed(machines::demand_known(machine, needed, told(how)));
}

std::string demand_known(machines::DozerMachine& machine, const std::string& how) {
  return printed(machines::demand_known(machine, told(how)));
}

void add_figure_option(CLI::App& command, std::vector<std::string>& figures,
                       const std::vector<std::string>& names) {
  command
      .add_option("--figure", figures,
                  "Draws figures of the paper with this run, as SVG beside the report")
      ->delimiter(',')
      ->type_name("NAME[,...]")
      ->check(one_of(names));
}

CLI::Validator error_name() { return one_of({runs::kErrorNames.begin(), runs::kErrorNames.end()}); }

CLI::Validator soil_name() {
  return one_of({machines::kSoilNames.begin(), machines::kSoilNames.end()});
}

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

CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const bool digits = !text.empty() && text.size() <= 18 &&
                            text.find_first_not_of("0123456789") == std::string::npos;
        return digits ? std::string() : fmt::format("{} is not a whole number from 0", text);
      },
      "");
}

CLI::Validator whole_number_between(int least, int most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        int value = 0;
        // Neither 0x1 nor 010, which is 8 to some.
        const bool plain = text.find_first_not_of("0123456789") == std::string::npos &&
                           (text.size() == 1 || text[0] != '0');
        const bool inside =
            plain && CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? std::string()
                      : fmt::format("{} is not a whole number from {} to {}", text, least, most);
      },
      fmt::format("{} .. {}", least, most));
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::Validator(
      [words](const std::string& text) {
        return std::find(words.begin(), words.end(), text) != words.end()
                   ? std::string()
                   : fmt::format("'{}' is none of {}{}", text, fmt::join(words, ", "),
                                 machines::near_word_hint(text, words));
      },
      fmt::format("{}", fmt::join(words, ", ")));
}

void assert_radians(const std::string& what, double angle_rad) {
  constexpr double kTurn_rad = 6.283185307179587;
  if (!(std::abs(angle_rad) <= kTurn_rad)) {
    throw std::runtime_error(
        std::isfinite(angle_rad)
            ? fmt::format("{}: {} rad is more than a turn; in degrees? then it is {:.4g} rad", what,
                          angle_rad, angle_rad * kTurn_rad / 360.0)
            : fmt::format("{} must be finite", what));
  }
}

}  // namespace graben::cli
