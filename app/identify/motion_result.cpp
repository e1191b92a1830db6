// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "app/identify/motion_delay.hpp"
#include "app/identify/motion_start.hpp"

namespace graben::identify {
namespace {

constexpr std::size_t kLeaveOut = 5;  // Every fifth run.
constexpr std::size_t kLeftOutFirst = 2;
constexpr double kDegrees = 57.29577951308232;
constexpr double kOpens = 0.05;  // Of its full speed: where a curve is said to begin.
constexpr double kFar = 0.95;    // Of the command: beyond it nothing is missed.
constexpr double kBand = 1.96;   // Standard deviations on each side of a 95 % band.
constexpr double kPermille = 1e3;
constexpr double kLeastR2 = 1e9;  // Of a model that there is none of.

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

constexpr double kDrivenAtAll = 0.02;

/// How far a direction was driven.
double driven(const MotionResult& result, std::size_t joint, bool forward) {
  return forward ? result.driven[joint][1] : -result.driven[joint][0];
}

nlohmann::json number_or_null(double value) {
  // JSON has no infinity; null is 'the data says nothing'.
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json curve_json(const MotionResult& result, std::size_t of, bool forward) {
  const JointModel& joint = result.model[of];
  const std::size_t first = forward ? kForward : kBackward;
  const double most = driven(result, of, forward);
  if (most < kDrivenAtAll) {
    return nullptr;
  }
  nlohmann::json points = nlohmann::json::array();
  double variance = 0.0;
  for (std::size_t at = 0; at < kKnots; ++at) {
    if (at > 0) {
      const double deviation = joint.deviation[first + at - 1];
      variance += deviation * deviation;
    }
    // A piece that begins beyond what was driven was not.
    const bool there = at == 0 || bends(joint, first)[at - 1] < most;
    points.push_back({{"command_ratio", bends(joint, first)[at]},
                      {"velocity_radps", sum(joint, first, at)},
                      {"deviation_radps", there ? number_or_null(std::sqrt(variance)) : nullptr}});
  }
  return points;
}

/// Parameters by name, in their order: each a number, or as many as there are.
struct Group {
  const char* name;
  std::size_t first;
  std::size_t count;
};
constexpr std::array<Group, 17> kGroups = {Group{"dead_time_s", kDeadTime, 1},
                                           Group{"pilot_lag_s", kPilotLag, 4},
                                           Group{"rises_positive_radps", kForward, kRises},
                                           Group{"rises_negative_radps", kBackward, kRises},
                                           Group{"flow_lag_s", kFlowLag, 4},
                                           Group{"mode_rate_radps", kModeRate, 1},
                                           Group{"damping_driving_ps", kDampingDriving, 1},
                                           Group{"damping_braking_ps", kDampingBraking, 1},
                                           Group{"inertia_by_pose", kInertia, kCosines},
                                           Group{"load_positive_by_pose", kLoadForward, kPose},
                                           Group{"load_negative_by_pose", kLoadBackward, kPose},
                                           Group{"linkage_ratio", kLinkageRatio, kLinkage - 1},
                                           Group{"shared_with_others", kShare, 4 * kOthers},
                                           Group{"rock_rate_radps", kRockRate, 1},
                                           Group{"rock_damping", kRockDamping, 1},
                                           Group{"rock_by_joints", kRockForce, kOthers + 1},
                                           Group{"sensor_lag_s", kSensorLag, 1}};

/// Every parameter; a deviation only where a value is free and the data says something of it.
nlohmann::ordered_json fitted_json(const MotionResult& result, std::size_t joint) {
  const JointModel& model = result.model[joint];
  nlohmann::ordered_json json;
  for (const Group& group : kGroups) {
    nlohmann::json values = nlohmann::json::array();
    nlohmann::json deviations = nlohmann::json::array();
    nlohmann::json bounds = nlohmann::json::array();
    for (std::size_t at = group.first; at < group.first + group.count; ++at) {
      const bool bound = at_bound(model, at, result.usual_radps[joint]);
      values.push_back(model.value[at]);
      deviations.push_back(bound ? nlohmann::json(nullptr) : number_or_null(model.deviation[at]));
      bounds.push_back(bound);
    }
    const bool one = group.count == 1;
    json[group.name] = {{"value", one ? values[0] : values},
                        {"deviation", one ? deviations[0] : deviations},
                        {"at_bound", one ? bounds[0] : bounds}};
  }
  return json;
}

nlohmann::ordered_json delay_json(const MotionResult& result, std::size_t joint, bool forward) {
  const double most = driven(result, joint, forward);
  if (most < kDrivenAtAll) {
    return nullptr;
  }
  const TotalDelay delay = total_delay(result.model[joint], forward ? most : -most);
  return {{"to_50_s", number_or_null(delay.half_s)}, {"to_90_s", number_or_null(delay.most_s)}};
}

/// A joint that no command drove has a start's values, which are not its own.
bool was_driven(const MotionResult& result, std::size_t joint) {
  return std::max(driven(result, joint, true), driven(result, joint, false)) >= kDrivenAtAll;
}

/// "95 +- 4 ms", or why it has no band.
std::string dead_time_text(const MotionResult& result, std::size_t joint) {
  if (!was_driven(result, joint)) {
    return "-";
  }
  const JointModel& model = result.model[joint];
  if (!std::isfinite(model.deviation[kDeadTime])) {
    return "not known";
  }
  const double value_ms = 1e3 * model.value[kDeadTime];
  return at_bound(model, kDeadTime, result.usual_radps[joint])
             ? fmt::format("{:.0f} ms, at bound", value_ms)
             : fmt::format("{:.0f} +- {:.0f} ms", value_ms,
                           kBand * 1e3 * model.deviation[kDeadTime]);
}

std::string lags_text(const MotionResult& result, std::size_t joint) {
  const JointModel& model = result.model[joint];
  return was_driven(result, joint) ? fmt::format("{:>6.0f}, {:<3.0f} ms", 1e3 * mean_lag(model, 0),
                                                 1e3 * mean_lag(model, 1))
                                   : std::string("     -");
}

std::string edge_text(const MotionResult& result, std::size_t joint, bool forward) {
  return driven(result, joint, forward) < kDrivenAtAll
             ? std::string("-")
             : fmt::format("{:.0f}",
                           kPermille * edge(result.model[joint], forward ? kForward : kBackward));
}

std::string r2_text(bool known, double r2) {
  return known ? fmt::format("{:.3f}", r2) : std::string("-");
}

/// Total delay of the direction that was driven farther.
std::string delay_text(const MotionResult& result, std::size_t joint) {
  const bool forward = driven(result, joint, true) >= driven(result, joint, false);
  const double most = driven(result, joint, forward);
  const TotalDelay delay = total_delay(result.model[joint], forward ? most : -most);
  return std::isfinite(delay.most_s)
             ? fmt::format("{:.0f}, {:.0f} ms", 1e3 * delay.half_s, 1e3 * delay.most_s)
             : std::string("-");
}

std::string unsupported(const MotionResult& result, std::size_t joint) {
  std::string said;
  for (const bool forward : {true, false}) {
    const double most = forward ? result.driven[joint][1] : -result.driven[joint][0];
    const char* direction = forward ? "positive" : "negative";
    if (most < kDrivenAtAll) {
      said += fmt::format("{}, {} commands: none was driven\n", kJointNames[joint], direction);
    } else if (most < kFar) {
      said += fmt::format("{}, {} commands: nothing beyond {:.0f} % was driven\n",
                          kJointNames[joint], direction, 100.0 * most);
    }
  }
  if (result.trained[joint].moved && was_driven(result, joint) &&
      !std::isfinite(result.model[joint].deviation[kDeadTime])) {
    said += fmt::format("{}: its motion says nothing of its dead time\n", kJointNames[joint]);
  }
  constexpr double kMuch = 0.1;
  if (result.unasked[joint] > kMuch) {
    said += fmt::format(
        "{}: {:.0f} % of its way it went with no command for a second: commands of one direction "
        "cut off, of another source, or it sinks\n",
        kJointNames[joint], 100.0 * result.unasked[joint]);
  }
  const Rivals& rivals = result.rivals[joint];
  const std::string chosen = result.chosen(joint);
  if (chosen != "physical") {
    said += fmt::format(
        "{}: the {} explains more than the physical model (R2 {:.3f}, {:.3f}): its velocity is "
        "best "
        "taken from there, and the figures of the physical one doubted\n",
        kJointNames[joint], chosen == "curve" ? "curve with dead time and lag" : "ridge regression",
        chosen == "curve" ? rivals.curve.judged_r2 : rivals.ridge.judged_r2,
        result.judged[joint].velocity_r2);
  }
  return said;
}

}  // namespace

const char* MotionResult::chosen(std::size_t joint) const {
  const Rivals& of = rivals[joint];
  const double curve = of.curve.known ? of.curve.judged_r2 : -kLeastR2;
  const double ridge = of.ridge.known ? of.ridge.judged_r2 : -kLeastR2;
  if (!judged[joint].moved || judged[joint].velocity_r2 >= std::max(curve, ridge) - kLoses) {
    return "physical";
  }
  return curve > ridge ? "curve" : "ridge";
}

double MotionResult::chosen_r2(std::size_t joint) const {
  const std::string by = chosen(joint);
  return by == "physical"
             ? judged[joint].velocity_r2
             : (by == "curve" ? rivals[joint].curve.judged_r2 : rivals[joint].ridge.judged_r2);
}

bool MotionResult::useless() const {
  bool moved = false;
  bool useful = false;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    moved = moved || judged[joint].moved;
    useful = useful || (judged[joint].moved && chosen_r2(joint) > kUselessR2);
  }
  return moved && !useful;
}

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
  result.rivals = fit_rivals(split.train, split.judge);
  result.trained_runs = split.train.size();
  result.judged_runs = split.judge.size();
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    result.usual_radps[joint] = usual_velocity(split.train, joint);
    result.unasked[joint] = unasked_share(split.train, joint);
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
  json["notes"] = result.notes;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const JointModel& model = result.model[joint];
    const Rivals& rivals = result.rivals[joint];
    nlohmann::ordered_json& axis = json["axes"][kJointNames[joint]];
    const Score& score = result.judged[joint];
    axis["velocity_r2"] = score.moved ? nlohmann::json(result.chosen_r2(joint)) : nullptr;
    axis["model"] = result.chosen(joint);
    axis["physical_r2"] = score.moved ? nlohmann::json(score.velocity_r2) : nullptr;
    axis["curve_r2"] = rivals.curve.known ? nlohmann::json(rivals.curve.judged_r2) : nullptr;
    axis["ridge_r2"] = rivals.ridge.known ? nlohmann::json(rivals.ridge.judged_r2) : nullptr;
    axis["angle_1s_rms_rad"] = score.angle_1s_rms_rad;
    axis["velocity_rms_unexplained_radps"] = score.velocity_rms_radps;
    axis["way_without_command_share"] = result.unasked[joint];
    if (!result.trained[joint].moved) {
      continue;  // Nothing is known of it.
    }
    axis["positive_command_turns"] = model.sign;
    if (!was_driven(result, joint)) {
      axis["driven"] = false;
      continue;
    }
    axis["dead_time_s"] = model.value[kDeadTime];
    axis["dead_time_deviation_s"] = at_bound(model, kDeadTime, result.usual_radps[joint])
                                        ? nlohmann::json(nullptr)
                                        : number_or_null(model.deviation[kDeadTime]);
    axis["lag_opening_s"] = mean_lag(model, 0);
    axis["lag_closing_s"] = mean_lag(model, 1);
    axis["delay_positive"] = delay_json(result, joint, true);
    axis["delay_negative"] = delay_json(result, joint, false);
    axis["positive"] = curve_json(result, joint, true);
    axis["negative"] = curve_json(result, joint, false);
    axis["fitted"] = fitted_json(result, joint);
  }
  return json.dump(2) + "\n";
}

std::string motion_text(const MotionResult& result) {
  std::string text;
  for (const std::string& note : result.notes) {
    text += fmt::format("note: {}\n", note);
  }
  text += fmt::format(
      "{} runs, judged by {} others\n"
      "axis    R2: model  curve  ridge  1 s ahead  dead time       to 50, 90 %   lag opens, closes "
      " "
      "edge +, -\n",
      result.trained_runs, result.judged_runs);
  std::string missing;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const Score& score = result.judged[joint];
    const Rivals& rivals = result.rivals[joint];
    if (result.trained[joint].moved) {
      text += fmt::format("{:<7} {:>9}  {:>5}  {:>5}  {:>5.2f} deg  {:<15} {:<13} {:<15} {}, {}\n",
                          kJointNames[joint],
                          score.moved ? fmt::format("{:.3f}", score.velocity_r2) : "stood",
                          r2_text(rivals.curve.known && score.moved, rivals.curve.judged_r2),
                          r2_text(rivals.ridge.known && score.moved, rivals.ridge.judged_r2),
                          kDegrees * score.angle_1s_rms_rad, dead_time_text(result, joint),
                          delay_text(result, joint), lags_text(result, joint),
                          edge_text(result, joint, true), edge_text(result, joint, false));
      missing += unsupported(result, joint);
    } else {
      missing += fmt::format("{}: stood throughout, nothing is known of it\n", kJointNames[joint]);
    }
  }
  return text + missing;
}

}  // namespace graben::identify
