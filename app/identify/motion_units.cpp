// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_units.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/identify/machine/median.hpp"

namespace graben::identify {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kFullTurn_rad = 6.4;  // No link of an excavator turns farther.
constexpr std::size_t kSwing = 3;
constexpr double kNear = 0.15;  // About a factor, of it.
constexpr double kFastest_radps = 20.0;

double usual_step(const std::vector<RawRun>& runs) {
  std::vector<double> steps;
  for (const RawRun& raw : runs) {
    for (std::size_t row = 1; row < raw.run.size(); ++row) {
      steps.push_back(raw.run.time_s[row] - raw.run.time_s[row - 1]);
    }
  }
  return steps.empty() ? 0.0 : median(steps);
}

template <class Of>
double largest(const std::vector<RawRun>& runs, const Of& of) {
  double most = 0.0;
  for (const RawRun& raw : runs) {
    for (const double value : of(raw.run)) {
      most = std::max(most, std::abs(value));
    }
  }
  return most;
}

template <class Of>
void times(std::vector<RawRun>& runs, double factor, const Of& of) {
  for (RawRun& raw : runs) {
    for (double& value : of(raw.run)) {
      value *= factor;
    }
  }
}

double span_of(const std::vector<RawRun>& runs, std::size_t joint) {
  double least = INFINITY;
  double most = -INFINITY;
  for (const RawRun& raw : runs) {
    const auto [low, high] =
        std::minmax_element(raw.run.angle_rad[joint].begin(), raw.run.angle_rad[joint].end());
    least = std::min(least, *low);
    most = std::max(most, *high);
  }
  return most - least;
}

/// How much an angle goes for what its velocity leads to, by seconds; 0: it stands.
double angle_over_velocity(const std::vector<RawRun>& runs, std::size_t joint) {
  double both = 0.0;
  double own = 0.0;
  double way = 0.0;
  for (const RawRun& raw : runs) {
    const MotionRun& run = raw.run;
    double turned = 0.0;
    std::size_t from = 0;
    for (std::size_t row = 1; row < run.size(); ++row) {
      turned += 0.5 * (run.velocity_radps[joint][row] + run.velocity_radps[joint][row - 1]) *
                (run.time_s[row] - run.time_s[row - 1]);
      if (run.time_s[row] - run.time_s[from] >= 1.0) {
        const double went = run.angle_rad[joint][row] - run.angle_rad[joint][from];
        both += went * turned;
        own += turned * turned;
        way += went * went;
        from = row;
        turned = 0.0;
      }
    }
  }
  constexpr double kLeast = 1e-6;
  const bool agrees = own > kLeast && both * both > 0.5 * own * way;
  return agrees ? both / own : 0.0;
}

bool is_near(double value, double factor) { return std::abs(value / factor - 1.0) < kNear; }

void take_angles(std::vector<RawRun>& runs, const HasVelocity& has_velocity,
                 const std::string& path, std::vector<std::string>& notes) {
  std::array<bool, kJoints> degrees{};
  for (std::size_t joint = 0; joint < kSwing; ++joint) {
    degrees[joint] = span_of(runs, joint) > kFullTurn_rad;
  }
  const bool links = degrees[0] || degrees[1] || degrees[2];
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const double factor = has_velocity[joint] ? angle_over_velocity(runs, joint) : 0.0;
    const bool as_velocity = is_near(factor, 1.0);
    const auto velocity = [joint](auto& run) -> auto& { return run.velocity_radps[joint]; };
    const bool fast = has_velocity[joint] && largest(runs, velocity) > kFastest_radps;
    const bool in_degrees = is_near(factor, 1.0 / kDegree) || degrees[joint] ||
                            (links && factor == 0.0) || (as_velocity && links && fast);
    if (in_degrees) {
      times(
          runs, kDegree, [joint](MotionRun & run) -> auto& { return run.angle_rad[joint]; });
      notes.push_back(fmt::format("{}: angle_rad_{} is in degrees", path, kJointNames[joint]));
    }
    const bool velocity_in_degrees = is_near(factor, kDegree) || (in_degrees && as_velocity);
    if (velocity_in_degrees) {
      times(runs, kDegree, velocity);
      notes.push_back(fmt::format("{}: velocity_radps_{} is in degrees", path, kJointNames[joint]));
    }
  }
}

bool has_fractions(const std::vector<RawRun>& runs, std::size_t joint) {
  return std::any_of(runs.begin(), runs.end(), [joint](const RawRun& raw) {
    const std::vector<double>& of = raw.run.command[joint];
    return std::any_of(of.begin(), of.end(), [](double each) { return each != std::floor(each); });
  });
}

/// Ratios and per cent as per mille. No valve opens within a tenth of its command, and what is up
/// to 1 is noise only where it is in whole per mille.
void take_commands(std::vector<RawRun>& runs, const std::string& path,
                   std::vector<std::string>& notes) {
  std::array<double, kJoints> most{};
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    most[joint] = largest(
        runs, [joint](const MotionRun& run) -> const auto& { return run.command[joint]; });
  }
  const double all = *std::max_element(most.begin(), most.end());
  const auto say = [&](const std::string& whose, double of, const char* unit) {
    notes.push_back(
        fmt::format("{}: no {} is beyond {:g}: {}, not per mille", path, whose, of, unit));
  };
  double factor = 1.0;
  if (all > 0.0 && all <= 1.0) {
    say("command", all, "they are ratios");
    factor = 1e3;
  } else if (all > 1.0 && all <= 100.0) {
    say("command", all, "they are per cent");
    factor = 10.0;
  }
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const bool alone =
        factor == 1.0 && most[joint] > 0.0 && most[joint] <= 1.0 && has_fractions(runs, joint);
    if (alone) {
      say(fmt::format("command_permille_{}", kJointNames[joint]), most[joint], "it is a ratio");
    }
    times(
        runs,
        alone ? 1e3 : factor, [joint](MotionRun & run) -> auto& { return run.command[joint]; });
  }
}

}  // namespace

void take_units(std::vector<RawRun>& runs, const HasVelocity& has_velocity, const std::string& path,
                std::vector<std::string>& notes) {
  constexpr double kSlowest_s = 1.0;  // Rows of a recording.
  const double step = usual_step(runs);
  if (step > kSlowest_s && step < 1e3 * kSlowest_s) {
    times(
        runs, 1e-3, [](MotionRun & run) -> auto& { return run.time_s; });
    notes.push_back(fmt::format("{}: time_s goes on by {:g}: it is in ms", path, step));
  }
  take_commands(runs, path, notes);
  take_angles(runs, has_velocity, path, notes);
}

bool is_differenced(const std::vector<MotionRun>& runs, std::size_t joint) {
  constexpr Eigen::Index kReach = 12;  // Rows of a filter to each side,
  constexpr Eigen::Index kOwn = 2;     // and of its own output.
  constexpr Eigen::Index kAll = 2 * kReach + kOwn;
  constexpr std::size_t kMostRows = 6000;
  constexpr double kLeft = 0.1;  // Of the quick part of the velocity.
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(kAll, kAll);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kAll);
  double squares = 0.0;
  double quick = 0.0;
  std::size_t rows = 0;
  Eigen::VectorXd row_of(kAll);
  for (const MotionRun& run : runs) {
    const std::vector<double>& angle = run.angle_rad[joint];
    const std::vector<double>& velocity = run.velocity_radps[joint];
    for (std::size_t row = kReach + 1; row + kReach < run.size() && rows < kMostRows;
         ++row, ++rows) {
      const double step_s = run.time_s[row] - run.time_s[row - 1];
      for (Eigen::Index at = 0; at < 2 * kReach; ++at) {
        const auto to = static_cast<std::size_t>(static_cast<Eigen::Index>(row) - kReach + at + 1);
        row_of[at] = (angle[to] - angle[to - 1]) / step_s;
      }
      row_of[2 * kReach] = velocity[row - 1];
      row_of[2 * kReach + 1] = velocity[row - 2];
      square.selfadjointView<Eigen::Lower>().rankUpdate(row_of);
      right += row_of * velocity[row];
      squares += velocity[row] * velocity[row];
      const double second = velocity[row] - 2.0 * velocity[row - 1] + velocity[row - 2];
      quick += second * second / 6.0;
    }
  }
  if (rows < 4 * static_cast<std::size_t>(kAll) || quick <= 0.0) {
    return false;
  }
  square = square.selfadjointView<Eigen::Lower>();
  square.diagonal().array() += 1e-10 * square.trace() / static_cast<double>(kAll);
  const double left = squares - right.dot(square.ldlt().solve(right));
  return left < kLeft * kLeft * quick;
}

}  // namespace graben::identify
