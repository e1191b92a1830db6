// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/step_round.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

/// Poses that a line planned on the way is looked at in. [-; size: of this loop]
constexpr int kLooks = 4;
/// Places of a step that may end early. [-; size: of this loop]
constexpr int kEarlyPlaces = 8;

TeethPose teeth_of(const SwingKinematics& kinematics, const DriveVector& drives) {
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drives).value);
}

TeethPose begin_of(const SwingKinematics& kinematics, const TaskStep& step) {
  return step.straight ? step.line.line.from : teeth_of(kinematics, step.drives.from);
}

TeethPose end_of(const SwingKinematics& kinematics, const TaskStep& step) {
  return step.straight ? step.line.line.at(1.0)
                       : teeth_of(kinematics, step.drives.from + step.drives.change);
}

bool line_is_reached(const SwingKinematics& kinematics, const TeethLine& line) {
  bool reached = true;
  for (int n = 0; n <= kLooks; ++n) {
    const TeethPose pose = line.at(static_cast<double>(n) / kLooks);
    reached = reached && kinematics.drive_from_teeth(pose).blind.kind == BlindKind::kNone;
  }
  return reached;
}

DrivePace pace_of(const TaskStep& step) { return {step.pace_ratio, step.least_s}; }

bool is_dig(const StepRequest& step) { return step.kind == StepKind::kDig && step.straight; }

bool refuse(ProgramRefusal why, int step, int round, const BlindPlace& place,
            ProgramResult& result) {
  result.refusal = why;
  result.step = step;
  result.round = round;
  result.place = place;
  return false;
}

/// Until every end of a dig lies on the clearance; more than kRoundsMost where that many do not do.
int rounds_to_design(const SwingKinematics& kinematics, const TaskProgram& program) {
  const RoundsPlan& rounds = program.rounds;
  double most_m = 0.0;
  for (int i = 0; i < program.step_count; ++i) {
    const TaskStep& step = program.step[static_cast<unsigned>(i)];
    for (const bool begin : {true, false}) {
      if (begin ? step.from_moves : step.to_moves) {
        const TeethPose pose = begin ? begin_of(kinematics, step) : end_of(kinematics, step);
        most_m = std::max(most_m, rounds.design.height_m(pose.position_m));
      }
    }
  }
  const double deeper_m = -rounds.design.up.dot(rounds.offset_m);
  const double over_m = most_m - rounds.design.clearance_m;
  const double needed =
      deeper_m < kLeastDeeper_m ? kRoundsMost : std::ceil(over_m / deeper_m - 1e-9);
  return 1 + static_cast<int>(std::clamp(needed, 0.0, static_cast<double>(kRoundsMost)));
}

/// Which ends a round moves: those of digs, whatever step they belong to.
void mark_moved(const ProgramRequest& request, TaskProgram& program) {
  const auto last = static_cast<unsigned>(request.step_count);
  std::array<bool, kStepMost + 1> moves{};
  for (unsigned i = 0; i < last; ++i) {
    if (is_dig(request.step[i])) {
      moves[i] = moves[i + 1] = true;
    }
  }
  // The end is the beginning, and a wait's end too: once round and once more for what that changes.
  for (unsigned n = 0; n < 2 * last; ++n) {
    moves[0] = moves[last] = moves[0] || moves[last];
    const unsigned i = n % last;
    if (request.step[i].kind == StepKind::kWait) {
      moves[i] = moves[i + 1] = moves[i] || moves[i + 1];
    }
  }
  for (unsigned i = 0; i < last; ++i) {
    program.step[i].from_moves = moves[i];
    program.step[i].to_moves = moves[i + 1];
  }
}

/// One round, as far as it differs from the first; `slower` of each line is kept.
bool plan_round(const ExcavatorProfile& profile, const SwingKinematics& kinematics, int round,
                std::array<double, kStepMost>& slower, ProgramResult& result) {
  const TaskProgram& program = result.program;
  const int next_round = std::min(round + 1, program.rounds.count - 1);
  for (int i = 0; i < program.step_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    if (!program.step[k].from_moves && !program.step[k].to_moves) {
      continue;
    }
    const RoundStep in = step_in_round(profile, kinematics, program, i, round, next_round);
    if (in.blind.blind.kind != BlindKind::kNone) {
      return refuse(ProgramRefusal::kBlindSpot, i, round, in.blind, result);
    }
    if (in.step.straight) {
      const BlindPlace blind = first_blind_place(kinematics, in.step.line.line);
      if (blind.blind.kind != BlindKind::kNone) {
        return refuse(ProgramRefusal::kBlindSpot, i, round, blind, result);
      }
      const PlanPeaks peaks = plan_peaks(kinematics, drive_limits(profile), in.step.line);
      slower[k] = std::max({slower[k], peaks.speed_ratio.maxCoeff(),
                            std::sqrt(peaks.acceleration_ratio.maxCoeff())});
    }
    const BarredPlace barred = first_barred_place(profile, kinematics, program.fences, in.step);
    if (barred.why != ProgramRefusal::kNone) {
      result.by = static_cast<const BarredBy&>(barred);
      return refuse(barred.why, i, round, barred.place, result);
    }
  }
  return true;
}

/// The step `after` from places on the line of step `number`.
bool plan_early_end(const ExcavatorProfile& profile, const SwingKinematics& kinematics, int number,
                    int after, int round, ProgramResult& result) {
  const TaskProgram& program = result.program;
  const TaskStep ends = step_in_round(profile, kinematics, program, number, round, round).step;
  const TaskStep next = step_in_round(profile, kinematics, program, after, round, round).step;
  for (int place = 0; place < kEarlyPlaces; ++place) {
    const double share = static_cast<double>(place) / kEarlyPlaces;
    const TeethPose teeth = ends.line.line.at(share);
    const DriveVector drives = step_motion(kinematics, ends, share).value;
    const TaskStep step = step_from(profile, kinematics, next, teeth, drives);
    const BarredPlace barred = first_barred_place(profile, kinematics, program.fences, step);
    if (barred.why != ProgramRefusal::kNone) {
      result.by = static_cast<const BarredBy&>(barred);
      result.early_share = share;
      return refuse(barred.why, after, round, barred.place, result);
    }
  }
  return true;
}

}  // namespace

Eigen::Vector3d place_in_round_m(const RoundsPlan& rounds, const Eigen::Vector3d& at_m, int round) {
  Eigen::Vector3d place_m = at_m + round * rounds.offset_m;
  if (rounds.has_design && round > 0) {
    const double missing_m = rounds.design.clearance_m - rounds.design.height_m(place_m);
    place_m.z() += std::max(0.0, missing_m / rounds.design.up.z());
  }
  return place_m;
}

RoundStep step_in_round(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                        const TaskProgram& program, int number, int round, int next_round) {
  const TaskStep& planned = program.step[static_cast<unsigned>(number)];
  const bool last = number + 1 == program.step_count;
  RoundStep result{{}, planned};
  TaskStep& step = result.step;
  TeethPose from = begin_of(kinematics, planned);
  TeethPose to = end_of(kinematics, planned);
  if (step.from_moves) {
    from.position_m = place_in_round_m(program.rounds, from.position_m, round);
  }
  if (step.to_moves) {
    to.position_m = place_in_round_m(program.rounds, to.position_m, last ? next_round : round);
  }
  const DriveResult begins = kinematics.drive_from_teeth(from);
  const DriveResult ends = kinematics.drive_from_teeth(to);
  for (const bool end : {false, true}) {
    const DriveResult& drives = end ? ends : begins;
    if (drives.blind.kind != BlindKind::kNone) {
      result.blind = {drives.blind, end ? 1.0 : 0.0, end ? to : from};
      return result;
    }
  }
  if (step.straight) {
    step.line.line = line_between(kinematics, from, to);
    step.line.way_m = way_m(kinematics, step.line.line);
    step.line.ramp = planned.line.ramp.slowed(std::max(1.0, step.line.way_m / planned.line.way_m));
  } else if (step.kind == StepKind::kWait) {
    step.drives.from = begins.value;
  } else {
    step.drives = plan_drives(drive_limits(profile), begins.value, ends.value, pace_of(step));
  }
  return result;
}

TaskStep step_from(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskStep& step, const TeethPose& from, const DriveVector& drives) {
  TaskStep result = step;
  if (step.kind == StepKind::kWait) {
    result.drives.from = drives;
    return result;
  }
  const TeethPose to = end_of(kinematics, step);
  if (step.straight) {
    result.line.line = line_between(kinematics, from, to);
    result.line.way_m = way_m(kinematics, result.line.line);
    if (result.line.way_m > kLeastWay_m && line_is_reached(kinematics, result.line.line)) {
      result.line.ramp =
          ramp_for_speed(result.line.way_m, step.line.way_m * step.line.ramp.peak_rate_ps(),
                         profile.line.acceleration_mps2);
      return result;
    }
    result.straight = false;
    result.pace_ratio = kRoundMovePace;
  }
  const DriveVector ends = step.straight ? kinematics.drive_from_teeth(to).value
                                         : DriveVector(step.drives.from + step.drives.change);
  result.drives = plan_drives(drive_limits(profile), drives, ends, pace_of(result));
  return result;
}

bool plan_rounds(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                 const ProgramRequest& request, ProgramResult& result) {
  TaskProgram& program = result.program;
  RoundsPlan& rounds = program.rounds;
  rounds = request.rounds;
  if (!rounds.is_bounded()) {
    return true;
  }
  rounds.has_design = request.has_design;
  rounds.design = request.design;
  mark_moved(request, program);
  if (rounds.to_design) {
    rounds.count = rounds_to_design(kinematics, program);
  }
  if (rounds.count < 1 || rounds.count > kRoundsMost || !request.repeats ||
      (rounds.to_design && !rounds.has_design)) {
    return refuse(ProgramRefusal::kRounds, 0, 0, {}, result);
  }
  std::array<double, kStepMost> slower{};
  slower.fill(1.0);
  for (int round = 0; round < rounds.count; ++round) {
    if (!plan_round(profile, kinematics, round, slower, result)) {
      return false;
    }
  }
  for (unsigned i = 0; i < static_cast<unsigned>(program.step_count); ++i) {
    TaskStep& step = program.step[i];
    if (step.straight && slower[i] > 1.0) {
      step.line.ramp = step.line.ramp.slowed(slower[i]);
    }
  }
  return true;
}

bool plan_early_ends(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     ProgramResult& result) {
  const TaskProgram& program = result.program;
  const int last_round = std::max(0, program.rounds.count - 1);
  for (int i = 0; i < program.step_count; ++i) {
    const int after = program.repeats ? (i + 1) % program.step_count : i + 1;
    const bool early = program.step[static_cast<unsigned>(i)].until.kind != UntilKind::kEnd;
    for (const int round : {0, last_round}) {
      const bool looks = early && after < program.step_count;
      if (looks && !plan_early_end(profile, kinematics, i, after, round, result)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace graben
