// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "app/identify/lines.hpp"
#include "app/identify/motion_runs.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::identify {
namespace {

constexpr double kLongestStep_s = 0.5;
constexpr double kShortestRun_s = 3.0;
constexpr double kLargestAngle_rad = 100.0;  // Swing may count turns.
constexpr double kLargestVelocity_radps = 20.0;
// An angle that is the integral of its velocity, noise and filter included.
constexpr double kLeastAgreement = 0.5;

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

  [[nodiscard]] std::size_t size() const { return at_.size(); }

 private:
  std::string where_;
  std::map<std::string, std::size_t, std::less<>> at_;
};

/// A value of a row between `least` and `most`.
double bounded(const std::vector<std::string_view>& row, const Columns& columns,
               const std::string& name, double least, double most, const std::string& where) {
  const double value = number(row[columns[name]], where, name);
  if (value < least || value > most) {
    refuse(where, fmt::format("{} is {}; {} .. {} is possible", name, value, least, most));
  }
  return value;
}

void add_row(const std::vector<std::string_view>& row, const Columns& columns,
             const std::string& where, MotionRun& run) {
  const double time_s = number(row[columns["time_s"]], where, "time_s");
  if (!run.time_s.empty()) {
    const double step_s = time_s - run.time_s.back();
    if (step_s <= 0.0 || step_s > kLongestStep_s) {
      refuse(where, fmt::format("time_s goes on by {:.3f} s within a run; up to {} s is possible",
                                step_s, kLongestStep_s));
    }
  }
  run.time_s.push_back(time_s);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const std::string name = kJointNames[joint];
    run.command[joint].push_back(
        bounded(row, columns, "command_permille_" + name, -1000.0, 1000.0, where) / 1000.0);
    run.angle_rad[joint].push_back(
        bounded(row, columns, "angle_rad_" + name, -kLargestAngle_rad, kLargestAngle_rad, where));
    run.velocity_radps[joint].push_back(bounded(row, columns, "velocity_radps_" + name,
                                                -kLargestVelocity_radps, kLargestVelocity_radps,
                                                where));
  }
}

/// Angle and velocity of one joint must be of one motion and in one unit.
void check_agreement(const std::vector<MotionRun>& runs, const std::string& path) {
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
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

}  // namespace

std::vector<MotionRun> read_motion_csv(const std::string& path) {
  Lines lines(path, "recorded motion, a CSV as graben identify --help describes it");
  std::string line;
  if (!lines.next(line)) {
    refuse(path, "is empty");
  }
  const Columns columns(line, lines.where());
  std::vector<MotionRun> runs;
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
      runs.back().name = fmt::format("{}, run {}", path, run);
    }
    add_row(row, columns, lines.where(), runs.back());
  }
  if (runs.empty()) {
    refuse(path, "has a header and no rows");
  }
  for (const MotionRun& run : runs) {
    const double lasts_s = run.time_s.back() - run.time_s.front();
    if (lasts_s < kShortestRun_s) {
      refuse(run.name,
             fmt::format("lasts {:.2f} s; at least {} s is needed", lasts_s, kShortestRun_s));
    }
  }
  check_agreement(runs, path);
  return runs;
}

std::vector<MotionRun> read_motion_files(const std::vector<std::string>& paths) {
  std::vector<MotionRun> all;
  for (const std::string& path : paths) {
    std::vector<MotionRun> runs = read_motion_csv(path);
    std::move(runs.begin(), runs.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace graben::identify
