// SPDX-License-Identifier: Apache-2.0
#include "app/machines/step_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/machines/excavator_sections.hpp"
#include "app/machines/fence_tables.hpp"
#include "app/machines/task_text.hpp"
#include "firmware/excavator/motion/dig/step_round.hpp"

namespace graben::machines {
namespace {

constexpr Range kStepPlace{-30.0, 30.0, "m"};
/// A drive move without a pace of its own leaves half of the limits to the others on the pump.
constexpr double kUsualPace = 0.5;
/// What an edge passes on a shorter level way says little of the fill.
constexpr double kLevelWay_m = 0.3;

enum class PathForm { kLine = 0, kDrives = 1 };

bool is_straight(TomlReader& reader, const std::string& at, StepKind kind) {
  const std::string key = at + ".path";
  if (!reader.has(key)) {
    return kind == StepKind::kDig || kind == StepKind::kLift;
  }
  return static_cast<PathForm>(reader.choice(
             key, {"line", "drives"},
             "way of the step: line of the teeth or move of the drives; dig and lift: line")) ==
         PathForm::kLine;
}

void read_line_pace(TomlReader& reader, const std::string& at, double usual_mps,
                    StepRequest& step) {
  const bool timed = reader.has(at + ".duration");
  const bool paced = reader.has(at + ".speed");
  if (timed) {
    step.duration_s = reader.number(at + ".duration", {0.1, 600.0, "s"},
                                    "duration of the step; on a line instead of speed");
  }
  if (paced) {
    step.speed_mps = reader.number(at + ".speed", {0.01, 3.0, "m/s"},
                                   "speed of the teeth on a line at most; else task.speed of the "
                                   "machine's profile");
  }
  if (timed && paced) {
    reader.fail(at, "has a speed and a duration; allowed: one of them");
    step.speed_mps = 0.0;
  } else if (!timed && !paced) {
    step.speed_mps = usual_mps;
  }
}

void read_drive_pace(TomlReader& reader, const std::string& at, StepRequest& step) {
  step.pace_ratio = reader.number_or(kUsualPace, at + ".pace", {0.01, 1.0, ""},
                                     "share of the drives' limits on a move");
  step.duration_s = reader.number_or(0.0, at + ".duration", {0.1, 600.0, "s"},
                                     "duration of the step; on a line instead of speed");
}

StepUntil until_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& through_m) {
  return {UntilKind::kPlane, 0.0, normal, normal.dot(through_m)};
}

/// Exactly one of its keys.
StepUntil read_until(TomlReader& reader, const std::string& at, double ground_m) {
  std::vector<StepUntil> found;
  if (reader.has(at + ".full")) {
    found.push_back(
        {UntilKind::kFull, reader.number(at + ".full", {0.2, 1.2, ""},
                                         "share of bucket.capacity that the edge has "
                                         "passed, as loose soil; of one dig of a task")});
  }
  if (reader.has(at + ".force")) {
    found.push_back({UntilKind::kForce, reader.number(at + ".force", {1e3, 1e6, "N"},
                                                      "of the ground on the teeth, for 0.2 s")});
  }
  if (reader.has(at + ".depth")) {
    const double depth_m =
        reader.number(at + ".depth", {0.02, 8.0, "m"}, "of the teeth under `ground`");
    found.push_back(until_plane(-Eigen::Vector3d::UnitZ(), {0.0, 0.0, ground_m - depth_m}));
  }
  if (reader.has(at + ".plane.normal") || reader.has(at + ".plane.through")) {
    const Eigen::Vector3d normal =
        read_direction(reader, at + ".plane.normal", 3,
                       "of a plane that the teeth come to, towards where they go: x, y, z");
    const std::vector<double> through =
        reader.numbers(at + ".plane.through", kStepPlace, 3, "a point of that plane: x, y, z");
    found.push_back(until_plane(normal, {through[0], through[1], through[2]}));
  }
  if (found.size() != 1) {
    reader.fail(
        at, fmt::format("{} of its keys; allowed: one of full, force, depth, plane", found.size()));
  }
  return found.empty() ? StepUntil{} : found.front();
}

/// What the machine can't tell, or a step can't be ended by.
void check_until(TomlReader& reader, const std::string& at, const ExcavatorProfile& profile,
                 const TeethPose& from, const StepRequest& step) {
  const ExcavatorBody& body = profile.geometry.body;
  if (!step.straight) {
    reader.fail(at, "ends a line of the teeth; this step is a move of the drives");
  }
  if (step.until.kind == UntilKind::kForce && !profile.oil.known()) {
    reader.fail(at + ".force", "needs the tip force, and with it [oil] in the machine's profile");
  }
  if (step.until.kind == UntilKind::kFull) {
    const double way_m = (step.to.position_m - from.position_m).head<2>().norm();
    if (!body.known() || !(body.capacity_m3 > 0.0)) {
      reader.fail(at + ".full", "needs bucket.width and bucket.capacity in the machine's profile");
    } else if (step.kind != StepKind::kDig || way_m < kLevelWay_m) {
      reader.fail(at + ".full",
                  fmt::format("of a dig of {:.3f} m level way; allowed: of a dig of at "
                              "least {} m",
                              way_m, kLevelWay_m));
    }
  }
}

StepRequest read_step(TomlReader& reader, const std::string& at, const ExcavatorProfile& profile,
                      const TeethPose& from, double ground_m) {
  constexpr std::array<StepKind, 6> kKinds = {StepKind::kDig,         StepKind::kLift,
                                              StepKind::kSwing,       StepKind::kDump,
                                              StepKind::kReturnToDig, StepKind::kWait};
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const StepKind kind : kKinds) {
    names.emplace_back(step_name(kind));
  }
  StepRequest step;
  step.kind = kKinds[static_cast<unsigned>(reader.choice(
      at + ".do", names,
      "kind of step; wait: until the operator asks for the task anew, no other key"))];
  if (step.kind == StepKind::kWait) {
    step.straight = false;
    step.to = from;
    return step;
  }
  step.to = read_teeth(reader, at + ".to");
  step.straight = is_straight(reader, at, step.kind);
  const bool lists_all = reader.lists() && reader.has(at);
  if (!step.straight || lists_all) {
    read_drive_pace(reader, at, step);
  }
  if (step.straight) {
    step.duration_s = 0.0;
    read_line_pace(reader, at, profile.dig_speed_mps, step);
  }
  if (reader.has(at + ".until")) {
    step.until = read_until(reader, at + ".until", ground_m);
    check_until(reader, at + ".until", profile, from, step);
  }
  return step;
}

}  // namespace

void read_steps(TomlReader& reader, const ExcavatorProfile& profile, ProgramRequest& request) {
  request.start = read_teeth(reader, "start");
  request.repeats =
      reader.boolean_or(false, "repeat", "starts again at its end, which has to be its start");
  request.ground_m = reader.number_or(0.0, "ground", kStepPlace,
                                      "height of the ground as it is before, for until");
  request.step_count = reader.table_count("step", 1, kStepMost, "steps, a table each");
  TeethPose from = request.start;
  int fills = 0;
  for (int i = 0; i < request.step_count; ++i) {
    const std::string at = fmt::format("step[{}]", i);
    StepRequest& step = request.step[static_cast<unsigned>(i)];
    step = read_step(reader, at, profile, from, request.ground_m);
    fills += step.until.kind == UntilKind::kFull ? 1 : 0;
    if (step.until.kind == UntilKind::kFull && fills > 1) {
      reader.fail(at + ".until.full", "is the second one; allowed: of one dig of a task");
    }
    from = step.to;
  }
}

void read_rounds(TomlReader& reader, ProgramRequest& request) {
  if (!reader.has("rounds")) {
    return;
  }
  RoundsPlan& rounds = request.rounds;
  const bool counts = reader.has("rounds.count");
  if (counts) {
    rounds.count = reader.integer("rounds.count", 1, kRoundsMost, "how often all steps are done");
  }
  rounds.to_design = reader.boolean_or(false, "rounds.until_design",
                                       "instead of a count: until every dig lies on the design");
  if (counts == rounds.to_design && !reader.lists()) {
    reader.fail("rounds", "needs one of count and until_design = true");
  }
  const bool deeper = reader.has("rounds.deeper");
  if (deeper) {
    const double deeper_m = reader.number("rounds.deeper", {0.001, 2.0, "m"},
                                          "each round than the last, against the design's normal");
    if (!request.has_design) {
      reader.fail("rounds.deeper", "needs a design; without one there is rounds.offset");
    }
    rounds.offset_m = -deeper_m * request.design.up;
  }
  if (reader.has("rounds.offset")) {
    const std::vector<double> offset =
        reader.numbers("rounds.offset", {-2.0, 2.0, "m"}, 3,
                       "from round to round, of what digs begin and end at: x, y, z; or deeper");
    rounds.offset_m = {offset[0], offset[1], offset[2]};
    if (deeper) {
      reader.fail("rounds.offset", "beside rounds.deeper; allowed: one of them");
    }
  }
  if (!request.repeats) {
    reader.fail("rounds", "of a task that does not repeat; allowed: with repeat = true");
  }
}

void refuse_unmet_planes(TomlReader& reader, const ProgramRequest& request,
                         const TaskProgram& program) {
  for (int i = 0; i < request.step_count; ++i) {
    const TaskStep& step = program.step[static_cast<unsigned>(i)];
    if (step.until.kind != UntilKind::kPlane) {
      continue;
    }
    const auto left_m = [&](double share, int round, bool moves) {
      const Eigen::Vector3d at_m = step.line.line.at(share).position_m;
      return step.until.offset_m -
             step.until.normal.dot(moves ? place_in_round_m(program.rounds, at_m, round) : at_m);
    };
    const int last = std::max(0, program.rounds.count - 1);
    const double begins_m = left_m(0.0, 0, step.from_moves);
    const double ends_m = std::min(left_m(1.0, 0, step.to_moves), left_m(1.0, last, step.to_moves));
    const std::string at = fmt::format("step[{}].until", i);
    if (begins_m <= 0.0) {
      reader.fail(at, fmt::format("the step begins {:.0f} mm beyond the plane; allowed: before it",
                                  -1e3 * begins_m));
    } else if (ends_m > 0.0) {
      reader.fail(at,
                  fmt::format("the step's end is still {:.0f} mm before the plane", 1e3 * ends_m));
    }
  }
}

}  // namespace graben::machines
