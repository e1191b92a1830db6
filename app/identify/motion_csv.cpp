// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "app/identify/lines.hpp"
#include "app/identify/motion_runs.hpp"
#include "app/identify/motion_units.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::identify {
namespace {

constexpr double kLongestStep_s = 0.5;
constexpr double kShortestRun_s = 3.0;
constexpr double kLargestAngle_rad = 100.0;  // Swing may count turns.
constexpr double kLargestVelocity_radps = 20.0;
// An angle that is the integral of its velocity, noise and filter included: twice of it is not.
constexpr double kLeastAgreement = 0.8;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", where, what));
}

double number(std::string_view cell, const std::string& where, std::string_view column) {
  const auto value = machines::number_in(cell);
  if (!value) {
    refuse(where, fmt::format("{} is \"{}\", not a number: {}", column, cell,
                              machines::not_a_number(cell)));
  }
  return *value;
}

/// Which cell is what.
class Columns {
 public:
  Columns(std::string_view header, std::string where) : where_(std::move(where)) {
    for (const std::string_view name : machines::cells_of(header)) {
      if (!at_.emplace(name, at_.size()).second) {
        refuse(where_, fmt::format("has the column {} twice", name));
      }
    }
  }

  [[nodiscard]] std::size_t operator[](const std::string& name) const {
    const auto found = at_.find(name);
    if (found == at_.end()) {
      refuse(where_, fmt::format("has no column {}", name));
    }
    return found->second;
  }

  [[nodiscard]] bool has(const std::string& name) const { return at_.count(name) > 0; }

  [[nodiscard]] std::size_t size() const { return at_.size(); }

 private:
  std::string where_;
  std::map<std::string, std::size_t, std::less<>> at_;
};

void add_row(const std::vector<std::string_view>& row, const Columns& columns,
             const std::string& where, std::size_t line, RawRun& raw) {
  MotionRun& run = raw.run;
  const auto value = [&](const std::string& name) {
    return number(row[columns[name]], where, name);
  };
  raw.line.push_back(line);
  run.time_s.push_back(value("time_s"));
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const std::string name = kJointNames[joint];
    run.command[joint].push_back(value("command_permille_" + name));
    run.angle_rad[joint].push_back(value("angle_rad_" + name));
    const std::string velocity = "velocity_radps_" + name;
    run.velocity_radps[joint].push_back(columns.has(velocity) ? value(velocity) : 0.0);
  }
}

/// Once units are known: times that go on, values between `least` and `most`.
void check_row(const RawRun& raw, std::size_t row, const std::string& path) {
  const MotionRun& run = raw.run;
  const std::string where = fmt::format("{}:{}", path, raw.line[row]);
  if (row > 0) {
    const double step_s = run.time_s[row] - run.time_s[row - 1];
    if (step_s <= 0.0 || step_s > kLongestStep_s) {
      refuse(where, fmt::format("time_s goes on by {:.3f} s within a run; up to {} s is possible",
                                step_s, kLongestStep_s));
    }
  }
  const auto check = [&](const std::string& name, double value, double most) {
    if (!(std::abs(value) <= most)) {
      refuse(where, fmt::format("{} is {}; {} .. {} is possible", name, value, -most, most));
    }
  };
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const std::string name = kJointNames[joint];
    check("command_permille_" + name, run.command[joint][row], 1000.0);
    check("angle_rad_" + name, run.angle_rad[joint][row], kLargestAngle_rad);
    check("velocity_radps_" + name, run.velocity_radps[joint][row], kLargestVelocity_radps);
  }
}

/// An angle that wraps at a full turn goes on; no joint jumps otherwise within a row.
void unwind(RawRun& raw, std::size_t joint, const std::string& path, std::size_t& wraps) {
  constexpr double kTurn_rad = 6.283185307179586;
  constexpr double kNearly = 0.8;
  std::vector<double>& angle = raw.run.angle_rad[joint];
  double added = 0.0;
  for (std::size_t row = 1; row < angle.size(); ++row) {
    angle[row] += added;
    const double step = angle[row] - angle[row - 1];
    const double step_s = raw.run.time_s[row] - raw.run.time_s[row - 1];
    const double most = kLargestVelocity_radps * step_s;
    if (std::abs(step) <= most) {
      continue;
    }
    const double wrapped = step - std::copysign(kTurn_rad, step);
    if (std::abs(step) < kNearly * kTurn_rad || std::abs(wrapped) > most) {
      refuse(fmt::format("{}:{}", path, raw.line[row]),
             fmt::format("angle_rad_{} jumps by {:.3g} rad within {:.3f} s: a number that stands "
                         "for no value?",
                         kJointNames[joint], step, step_s));
    }
    added += wrapped - step;
    angle[row] += wrapped - step;
    ++wraps;
  }
}

/// Angle and velocity of one joint must be of one motion and in one unit.
void check_agreement(const std::vector<MotionRun>& runs, const HasVelocity& has_velocity,
                     const std::string& path) {
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    if (!has_velocity[joint]) {
      continue;
    }
    double unexplained = 0.0;
    double motion = 0.0;
    for (const MotionRun& run : runs) {
      double turned = 0.0;
      std::size_t from = 0;
      for (std::size_t row = 1; row < run.size(); ++row) {
        turned += 0.5 * (run.velocity_radps[joint][row] + run.velocity_radps[joint][row - 1]) *
                  (run.time_s[row] - run.time_s[row - 1]);
        if (run.time_s[row] - run.time_s[from] >= 1.0) {
          const double went = run.angle_rad[joint][row] - run.angle_rad[joint][from];
          unexplained += (went - turned) * (went - turned);
          motion += went * went;
          from = row;
          turned = 0.0;
        }
      }
    }
    if (motion > 1e-6 && unexplained > (1.0 - kLeastAgreement) * motion) {
      refuse(path,
             fmt::format(
                 "angle_rad_{0} does not go where velocity_radps_{0} leads: another unit, sign "
                 "or joint?",
                 kJointNames[joint]));
    }
  }
}

/// Velocities that are missing, or only the angles' differences, as the angles have them.
void take_velocities(std::vector<MotionRun>& runs, const HasVelocity& has_velocity,
                     const std::string& path, std::vector<std::string>& notes) {
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const bool differenced = has_velocity[joint] && is_differenced(runs, joint);
    if (has_velocity[joint] && !differenced) {
      continue;
    }
    for (MotionRun& run : runs) {
      take_velocity_of_angle(run, joint);
    }
    if (differenced) {
      notes.push_back(
          fmt::format("{}: velocity_radps_{} is a difference of the angles: these are "
                      "fitted to, filtered as the model is",
                      path, kJointNames[joint]));
    }
  }
}

std::vector<RawRun> read_raw(const std::string& path, HasVelocity& has_velocity) {
  Lines lines(path, "recorded motion, a CSV as graben identify --help describes it");
  std::string line;
  if (!lines.next(line)) {
    refuse(path, "is empty");
  }
  const Columns columns(line, lines.where());
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    has_velocity[joint] = columns.has(fmt::format("velocity_radps_{}", kJointNames[joint]));
  }
  std::vector<RawRun> runs;
  std::string of_run;
  std::vector<std::string> seen;
  while (lines.next(line)) {
    const std::vector<std::string_view> row = machines::cells_of(line);
    if (row.empty()) {
      continue;
    }
    if (row.size() != columns.size()) {
      refuse(lines.where(), fmt::format("has {} cells, the header {}: is the file cut off?",
                                        row.size(), columns.size()));
    }
    const std::string run(row[columns["run"]]);
    if (runs.empty() || run != of_run) {
      if (std::find(seen.begin(), seen.end(), run) != seen.end()) {
        refuse(lines.where(),
               fmt::format("run {} goes on after another: two recordings in one file?", run));
      }
      seen.push_back(run);
      of_run = run;
      runs.emplace_back();
      runs.back().run.name = fmt::format("{}, run {}", path, run);
    }
    add_row(row, columns, lines.where(), lines.number(), runs.back());
  }
  if (runs.empty()) {
    refuse(path, "has a header and no rows");
  }
  return runs;
}

}  // namespace

std::vector<MotionRun> read_motion_csv(const std::string& path, std::vector<std::string>* notes) {
  HasVelocity has_velocity{};
  std::vector<RawRun> raw = read_raw(path, has_velocity);
  std::vector<std::string> said;
  take_units(raw, has_velocity, path, said);
  std::vector<MotionRun> runs;
  std::array<std::size_t, kJoints> wraps{};
  for (RawRun& each : raw) {
    for (std::size_t row = 0; row < each.run.size(); ++row) {
      check_row(each, row, path);
    }
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      unwind(each, joint, path, wraps[joint]);
    }
    MotionRun& run = each.run;
    const double lasts_s = run.time_s.back() - run.time_s.front();
    if (lasts_s < kShortestRun_s) {
      refuse(run.name,
             fmt::format("lasts {:.2f} s; at least {} s is needed", lasts_s, kShortestRun_s));
    }
    for (std::vector<double>& commands : run.command) {
      for (double& command : commands) {
        command /= 1000.0;
      }
    }
    runs.push_back(std::move(run));
  }
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    if (wraps[joint] > 0) {
      said.push_back(fmt::format("{}: angle_rad_{} wraps {} times at a full turn: counted on", path,
                                 kJointNames[joint], wraps[joint]));
    }
  }
  check_agreement(runs, has_velocity, path);
  take_velocities(runs, has_velocity, path, said);
  if (notes != nullptr) {
    std::move(said.begin(), said.end(), std::back_inserter(*notes));
  }
  return runs;
}

std::vector<MotionRun> read_motion_files(const std::vector<std::string>& paths,
                                         std::vector<std::string>* notes) {
  std::vector<MotionRun> all;
  for (const std::string& path : paths) {
    std::vector<MotionRun> runs = read_motion_csv(path, notes);
    std::move(runs.begin(), runs.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace graben::identify
