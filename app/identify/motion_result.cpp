// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace graben::identify {
namespace {

constexpr std::size_t kLeaveOut = 5;  // Every fifth run.
constexpr std::size_t kLeftOutFirst = 2;
constexpr double kDegrees = 57.29577951308232;
constexpr double kOpens = 0.05;  // Of its full speed: where a curve is said to begin.
constexpr double kFar = 0.95;    // Of the command: beyond it nothing is missed.
constexpr double kBand = 1.96;   // Standard deviations on each side of a 95 % band.
constexpr double kPermille = 1e3;

bool same_motion(const MotionRun& one, const MotionRun& other) {
  // Two that stand are alike, and neither says anything.
  return one.command == other.command && one.angle_rad == other.angle_rad &&
         std::any_of(one.command.begin(), one.command.end(),
                     [](const std::vector<double>& command) {
                       return std::any_of(command.begin(), command.end(),
                                          [](double at) { return at != 0.0; });
                     });
}

double sum(const JointModel& joint, std::size_t first, std::size_t count) {
  double all = 0.0;
  for (std::size_t at = 0; at < count; ++at) {
    all += joint.value[first + at];
  }
  return all;
}

/// Of both directions: pilot and pump, while the opening grows (`way` 0) or falls (1).
double mean_lag(const JointModel& joint, std::size_t way) {
  const std::array<double, kParameters>& value = joint.value;
  return 0.5 * (value[kPilotLag + way] + value[kPilotLag + 2 + way] + value[kFlowLag + way] +
                value[kFlowLag + 2 + way]);
}

const Bends& bends(const JointModel& joint, std::size_t first) {
  return first == kForward ? joint.grid.forward : joint.grid.backward;
}

/// Command at which the curve from `first` reaches kOpens of its highest value.
double edge(const JointModel& joint, std::size_t first) {
  const Bends& knots = bends(joint, first);
  const double wanted = kOpens * sum(joint, first, kRises);
  double reached = 0.0;
  for (std::size_t at = 0; at < kRises; ++at) {
    const double rise = joint.value[first + at];
    if (reached + rise >= wanted && rise > 0.0) {
      return knots[at] + (knots[at + 1] - knots[at]) * (wanted - reached) / rise;
    }
    reached += rise;
  }
  return 1.0;
}

nlohmann::json curve_json(const JointModel& joint, std::size_t first) {
  nlohmann::json points = nlohmann::json::array();
  double variance = 0.0;
  for (std::size_t at = 0; at < kKnots; ++at) {
    if (at > 0) {
      const double deviation = joint.deviation[first + at - 1];
      variance += deviation * deviation;
    }
    const double deviation = std::sqrt(variance);
    points.push_back({{"command_ratio", bends(joint, first)[at]},
                      {"velocity_radps", sum(joint, first, at)},
                      // JSON has no infinity; null is 'the data says nothing'.
                      {"deviation_radps", std::isfinite(deviation) ? nlohmann::json(deviation)
                                                                   : nlohmann::json(nullptr)}});
  }
  return points;
}

std::string unsupported(const MotionResult& result, std::size_t joint) {
  std::string said;
  for (const bool forward : {true, false}) {
    const double most = forward ? result.driven[joint][1] : -result.driven[joint][0];
    const char* direction = forward ? "positive" : "negative";
    if (most <= 0.0) {
      said += fmt::format("{}, {} commands: none was driven\n", kJointNames[joint], direction);
    } else if (most < kFar) {
      said += fmt::format("{}, {} commands: nothing beyond {:.0f} % was driven\n",
                          kJointNames[joint], direction, 100.0 * most);
    }
  }
  return said;
}

}  // namespace

MotionSplit split_motion(std::vector<MotionRun> train, std::vector<MotionRun> judge) {
  MotionSplit split;
  if (judge.empty()) {
    if (train.size() <= kLeftOutFirst) {
      throw std::runtime_error(
          fmt::format("{} runs: at least {} are needed to leave one out, or give --judge",
                      train.size(), kLeftOutFirst + 1));
    }
    for (std::size_t at = 0; at < train.size(); ++at) {
      (at % kLeaveOut == kLeftOutFirst ? split.judge : split.train).push_back(std::move(train[at]));
    }
  } else {
    split = {std::move(train), std::move(judge)};
  }
  for (const MotionRun& judged : split.judge) {
    const auto found = std::find_if(split.train.begin(), split.train.end(),
                                    [&](const MotionRun& run) { return same_motion(run, judged); });
    if (found != split.train.end()) {
      throw std::runtime_error(
          fmt::format("{} is the same motion as {}: a model can't be judged by what it was made of",
                      judged.name, found->name));
    }
  }
  return split;
}

MotionResult identify_motion(const MotionSplit& split, const FitOptions& options) {
  MotionResult result;
  result.model = fit_motion(split.train, options);
  result.trained = judge(result.model, split.train);
  result.judged = judge(result.model, split.judge);
  result.trained_runs = split.train.size();
  result.judged_runs = split.judge.size();
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    for (const MotionRun& run : split.train) {
      const auto [least, most] =
          std::minmax_element(run.command[joint].begin(), run.command[joint].end());
      result.driven[joint][0] = std::min(result.driven[joint][0], *least);
      result.driven[joint][1] = std::max(result.driven[joint][1], *most);
    }
  }
  return result;
}

std::string motion_json(const MotionResult& result) {
  nlohmann::ordered_json json;
  json["judged_runs"] = result.judged_runs;
  json["trained_runs"] = result.trained_runs;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const JointModel& model = result.model[joint];
    nlohmann::ordered_json& axis = json["axes"][kJointNames[joint]];
    const Score& score = result.judged[joint];
    if (score.moved) {
      axis["velocity_r2"] = score.velocity_r2;
    } else {
      axis["velocity_r2"] = nullptr;
    }
    axis["angle_1s_rms_rad"] = score.angle_1s_rms_rad;
    axis["velocity_rms_unexplained_radps"] = score.velocity_rms_radps;
    axis["positive_command_turns"] = model.sign;
    axis["dead_time_s"] = model.value[kDeadTime];
    axis["lag_opening_s"] = mean_lag(model, 0);
    axis["lag_closing_s"] = mean_lag(model, 1);
    axis["positive"] = curve_json(model, kForward);
    axis["negative"] = curve_json(model, kBackward);
  }
  return json.dump(2) + "\n";
}

std::string motion_text(const MotionResult& result) {
  std::string text = fmt::format(
      "{} runs, judged by {} others\n"
      "axis     velocity R2  angle 1 s ahead  dead time        lag opens, closes  edge +, -\n",
      result.trained_runs, result.judged_runs);
  std::string missing;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const JointModel& model = result.model[joint];
    const Score& score = result.judged[joint];
    if (result.trained[joint].moved) {
      text += fmt::format(
          "{:<8} {:>11}  {:>11.2f} deg  {:>3.0f} +- {:<3.0f} ms  {:>9.0f}, {:<3.0f} ms  "
          "{:.0f}, {:.0f} of 1000\n",
          kJointNames[joint], score.moved ? fmt::format("{:.3f}", score.velocity_r2) : "stood",
          kDegrees * score.angle_1s_rms_rad, 1e3 * model.value[kDeadTime],
          kBand * 1e3 * model.deviation[kDeadTime], 1e3 * mean_lag(model, 0),
          1e3 * mean_lag(model, 1), kPermille * edge(model, kForward),
          kPermille * edge(model, kBackward));
      missing += unsupported(result, joint);
    } else {
      missing += fmt::format("{}: stood throughout, nothing is known of it\n", kJointNames[joint]);
    }
  }
  return text + missing;
}

}  // namespace graben::identify
