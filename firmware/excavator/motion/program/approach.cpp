// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/approach.hpp"

#include <algorithm>

#include "firmware/excavator/fences/fence_margin.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

bool inside(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
            const FenceSet& fences, const DriveVector& drives) {
  const MachineMotion machine =
      machine_motion(kinematics, drives, DriveVector::Zero(), unsure_drives(profile));
  bool all = machine.status == ReachStatus::kOk;
  for (int i = 0; all && i < fences.count; ++i) {
    const Fence& fence = fences.fence[static_cast<unsigned>(i)];
    const int count = gap_count(fence, profile.geometry.body);
    for (int k = 0; k < count; ++k) {
      const FenceGap gap = fence_gap(fence, profile.geometry.body, machine, k, kApproachFar_m);
      all = all && gap.distance_m > planned_margin_m(profile.fence, fence, machine, gap, 0.0);
    }
  }
  return all;
}

/// Where an approach comes to before it goes down to the start.
DriveVector above_start(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                        const TaskProgram& program, const DriveVector& from) {
  const auto teeth = [&](const DriveVector& drives) {
    return kinematics.teeth_from_joints(kinematics.joints_from_drive(drives).value);
  };
  const TeethPose start = teeth(program.start);
  if ((teeth(from).position_m - start.position_m).norm() < kApproachNear_m) {
    return program.start;
  }
  for (const double lift_m : {kApproachLift_m, 0.5 * kApproachLift_m}) {
    TeethPose lifted = start;
    lifted.position_m.z() += lift_m;
    DriveResult above = kinematics.drive_from_teeth(lifted);
    above.value = with_swing(above.value, swing_of(program.start));
    if (above.blind.kind == BlindKind::kNone &&
        inside(profile, kinematics, program.fences, above.value)) {
      return above.value;
    }
  }
  return program.start;
}

/// Strokes at these shares of their range; what is not told (below 0) stays.
DriveVector posed(const ExcavatorProfile& profile, DriveVector drives, double boom, double folded) {
  drives[kBoom] = boom * profile.geometry.cylinder[kBoom].stroke_m;
  for (const int axis : {kArm, kBucket}) {
    if (folded >= 0.0) {
      drives[axis] = folded * profile.geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
    }
  }
  return drives;
}

class ApproachWalk {
 public:
  ApproachWalk(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
               const FenceSet& fences, const DrivePlan& leg)
      : profile_(profile),
        kinematics_(kinematics),
        fences_(fences),
        leg_(leg),
        unsure_(unsure_drives(profile)) {}

  /// The leg's pose of that number keeps clear.
  [[nodiscard]] bool is_free(ApproachSearch& search) const {
    const double share = static_cast<double>(search.sample) / kApproachSamples;
    const DriveVector drives = leg_.from + share * leg_.change;
    const MachineMotion motion = machine_motion(kinematics_, drives, leg_.change, unsure_);
    bool free = motion.status == ReachStatus::kOk;
    for (int i = 0; free && i < fences_.count; ++i) {
      free = keeps_off(i, motion, leg_.ramp.most_rate_ps(share), search);
    }
    return free;
  }

 private:
  [[nodiscard]] bool keeps_off(int number, const MachineMotion& motion, double rate_ps,
                               ApproachSearch& search) const {
    const auto n = static_cast<unsigned>(number);
    const Fence& fence = fences_.fence[n];
    const ExcavatorBody& body = profile_.geometry.body;
    const int count = gap_count(fence, body);
    const std::uint16_t closed = search.closes[n];
    search.closes[n] = 0;
    bool free = true;
    for (int i = 0; i < count; ++i) {
      const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(i));
      const FenceGap gap = fence_gap(fence, body, motion, i, kApproachFar_m);
      double left_m =
          gap.distance_m - planned_margin_m(profile_.fence, fence, motion, gap, rate_ps);
      if (search.sample == 0) {
        set(search.leaves[n], bit, left_m < -kBarTolerance);
      } else if (!fence.is_plane() && (closed & bit) != 0 && gap.closing_mps < 0.0) {
        // It was nearest between the last pose and this one.
        left_m += gap.closing_mps / kApproachSamples;
      }
      set(search.closes[n], bit, gap.closing_mps > 0.0);
      if ((search.leaves[n] & bit) != 0) {
        free = free && gap.closing_mps <= kApproachLeaves_m;
        set(search.leaves[n], bit, left_m < -kBarTolerance);
      } else {
        free = free && left_m >= -kBarTolerance;
      }
    }
    return free;
  }

  static void set(std::uint16_t& bits, std::uint16_t bit, bool value) {
    bits = static_cast<std::uint16_t>(value ? bits | bit : bits & ~bit);
  }

  const ExcavatorProfile& profile_;
  const SwingKinematics& kinematics_;
  const FenceSet& fences_;
  const DrivePlan& leg_;
  DriveVector unsure_;
};

/// On to the next leg, or the search's end.
void end_leg(ApproachSearch& search, const ApproachPath& path) {
  search.sample = 0;
  ++search.leg;
  search.found = search.leg >= path.legs;
}

void next_way(ApproachSearch& search) {
  search.sample = 0;
  search.leg = 0;
  search.planned = false;
  ++search.way;
  search.failed = search.way >= kApproachWays;
}

}  // namespace

DrivePlan approach_leg(const ApproachPath& path, const TaskProgram& program, int leg) {
  const auto i = static_cast<unsigned>(std::clamp(leg, 0, kApproachLegs - 1));
  const bool last = leg + 1 >= std::min(path.legs, kApproachLegs);
  const DriveVector& to = last ? program.start : path.from[i + 1];
  return {path.from[i], to - path.from[i], path.ramp[i]};
}

ApproachPath approach_path(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                           const TaskProgram& program, const DriveVector& drives_now,
                           ApproachWay way) {
  DriveVector own = drives_now;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    own[i] = std::clamp(own[i], 0.0, profile.geometry.cylinder[i].stroke_m);
  }
  const double start_swing = swing_of(program.start);
  if (!profile.has_swing()) {
    own = with_swing(own, start_swing);
  }
  const DriveVector above = above_start(profile, kinematics, program, own);
  ApproachPath path;
  const auto go_by = [&path](const DriveVector& via) {
    path.from[static_cast<unsigned>(path.legs++)] = via;
  };
  go_by(own);
  switch (way) {
    case ApproachWay::kDirect:
      break;
    case ApproachWay::kSwingFirst:
      go_by(with_swing(own, start_swing));
      break;
    case ApproachWay::kOver:
    case ApproachWay::kFolded:
    case ApproachWay::kFoldedLow: {
      const double boom = way == ApproachWay::kFoldedLow ? kApproachHalfOut : kApproachNearlyOut;
      const double folded = way == ApproachWay::kOver ? -1.0 : kApproachNearlyOut;
      go_by(posed(profile, own, boom, folded));
      go_by(with_swing(posed(profile, own, boom, folded), start_swing));
      break;
    }
    case ApproachWay::kBoomFirst: {
      DriveVector boomed = own;
      boomed[kBoom] = above[kBoom];
      go_by(boomed);
      go_by(with_swing(above, swing_of(own)));
      break;
    }
    case ApproachWay::kSwingLast:
      go_by(with_swing(above, swing_of(own)));
      break;
  }
  go_by(above);
  const DriveLimits limits = drive_limits(profile);
  for (int i = 0; i < path.legs; ++i) {
    const auto k = static_cast<unsigned>(i);
    const DriveVector& to = i + 1 < path.legs ? path.from[k + 1] : program.start;
    path.ramp[k] = plan_drives(limits, path.from[k], to, {kApproachPace, 0.0}).ramp;
  }
  return path;
}

void search_approach(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     const TaskProgram& program, const DriveVector& drives_now,
                     ApproachSearch& search, ApproachPath& path) {
  search.found = search.found || program.fences.count == 0;
  if (search.found || search.failed) {
    return;
  }
  if (!search.planned) {
    path = approach_path(profile, kinematics, program, drives_now,
                         static_cast<ApproachWay>(search.way));
    search.planned = true;
    return;
  }
  for (int i = 0; i < kSamplesPerCycle && search.planned && !search.found; ++i) {
    const DrivePlan leg = approach_leg(path, program, search.leg);
    const bool goes = leg.ramp.duration_s > 0.0;
    if (goes && !ApproachWalk(profile, kinematics, program.fences, leg).is_free(search)) {
      next_way(search);
    } else if (!goes || ++search.sample > kApproachSamples) {
      end_leg(search, path);
    }
  }
}

}  // namespace graben
