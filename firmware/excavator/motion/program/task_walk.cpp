// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_program.hpp"

#include <algorithm>
#include <limits>

#include "firmware/excavator/fences/fence_margin.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

/// Most distances at one place. [-; size: both ends of the swing, and all gaps before all fences]
constexpr int kBarMost = 2 + kFenceMost * kGapMost;

/// A distance less its margin.
struct BarGap : FenceGap {
  double margin_m = 0.0;
};

/// All distances at one place, and how they shrink by the share.
struct Sample {
  double share = 0.0;
  ReachStatus status = ReachStatus::kOk;
  std::array<BarGap, kBarMost> gap;
};

class BarWalk {
 public:
  BarWalk(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
          const FenceSet& fences, const TaskStep& step);

  [[nodiscard]] BarredPlace run() const;

 private:
  /// What a gap belongs to.
  struct Bar {
    bool left_end = false;
    int fence = -1;  ///< Below 0: an end of the swing's range.
    int gap = 0;
  };

  [[nodiscard]] Sample sample(double share) const;
  [[nodiscard]] BarGap gap(const Bar& bar, double share, const DriveMotion& drives,
                           const MachineMotion& motion) const;
  [[nodiscard]] double least_between(const Sample& from, const Sample& to, unsigned bar) const;
  [[nodiscard]] double begins_between(double free, double barred, unsigned bar) const;
  [[nodiscard]] BarredPlace between(const Sample& from, const Sample& to) const;
  [[nodiscard]] BarredPlace at(double share, unsigned bar) const;
  void add_least(unsigned bar, BarredPlace& found) const;
  [[nodiscard]] BarredPlace unknown_at(double share) const;
  void add(const Bar& bar) { bar_[static_cast<unsigned>(count_++)] = bar; }

  const ExcavatorProfile& profile_;
  const SwingKinematics& kinematics_;
  const FenceSet& fences_;
  const TaskStep& step_;
  DriveVector unsure_;
  SineRamp ramp_;
  std::array<Bar, kBarMost> bar_;
  int count_ = 0;
};

bool barred(const FenceGap& gap) { return gap.distance_m < -kBarTolerance; }

BarWalk::BarWalk(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                 const FenceSet& fences, const TaskStep& step)
    : profile_(profile),
      kinematics_(kinematics),
      fences_(fences),
      step_(step),
      unsure_(unsure_drives(profile)),
      ramp_(step.straight ? step.line.ramp : step.drives.ramp) {
  if (profile.has_swing()) {
    add({true});
    add({false});
  }
  for (int fence = 0; fence < fences.count; ++fence) {
    const int count = gap_count(fences.fence[static_cast<unsigned>(fence)], profile.geometry.body);
    for (int gap = 0; gap < count; ++gap) {
      add({false, fence, gap});
    }
  }
}

BarGap BarWalk::gap(const Bar& bar, double share, const DriveMotion& drives,
                    const MachineMotion& motion) const {
  BarGap gap;
  if (bar.fence >= 0) {
    const Fence& fence = fences_.fence[static_cast<unsigned>(bar.fence)];
    static_cast<FenceGap&>(gap) = fence_gap(fence, profile_.geometry.body, motion, bar.gap,
                                            std::numeric_limits<double>::infinity());
    gap.margin_m = planned_margin_m(profile_.fence, fence, motion, gap, ramp_.most_rate_ps(share));
    gap.distance_m -= gap.margin_m;
    return gap;
  }
  const double swing_rad = swing_of(drives.value);
  gap.distance_m = bar.left_end ? profile_.swing.left_end_rad - swing_rad
                                : swing_rad - profile_.swing.right_end_rad;
  gap.closing_mps = bar.left_end ? swing_of(drives.rate) : -swing_of(drives.rate);
  return gap;
}

Sample BarWalk::sample(double share) const {
  Sample result;
  result.share = share;
  const DriveMotion drives = step_motion(kinematics_, step_, share);
  const MachineMotion motion = machine_motion(kinematics_, drives.value, drives.rate, unsure_);
  result.status = motion.status;
  for (unsigned i = 0; i < static_cast<unsigned>(count_); ++i) {
    result.gap[i] = gap(bar_[i], share, drives, motion);
  }
  return result;
}

BarredPlace BarWalk::at(double share, unsigned bar) const {
  BarredPlace found;
  found.why = bar_[bar].fence >= 0 ? ProgramRefusal::kFence : ProgramRefusal::kSwingEnd;
  found.fence = std::max(0, bar_[bar].fence);
  const DriveMotion drives = step_motion(kinematics_, step_, share);
  const DriveResult joints = kinematics_.joints_from_drive(drives.value);
  found.place = {{}, share, kinematics_.teeth_from_joints(joints.value)};
  add_least(bar, found);
  return found;
}

/// To a step of the walk.
void BarWalk::add_least(unsigned bar, BarredPlace& found) const {
  Sample least = sample(found.place.share);
  for (int i = 0; i <= kWalkSteps; ++i) {
    const double share = static_cast<double>(i) / kWalkSteps;
    if (share > found.place.share) {
      const Sample next = sample(share);
      least = next.gap[bar].distance_m < least.gap[bar].distance_m ? next : least;
    }
  }
  const BarGap& gap = least.gap[bar];
  found.point = gap.point;
  found.least_share = least.share;
  found.least_m = gap.distance_m + gap.margin_m;
  found.margin_m = gap.margin_m;
}

/// Neither of the shipped machines has such a place: no line is planned through one, and the box of
/// strokes is checked with the profile.
BarredPlace BarWalk::unknown_at(double share) const {
  BarredPlace found;
  found.why = ProgramRefusal::kBlindSpot;
  found.place = {{BlindKind::kSingular, kArm}, share, {}};
  return found;
}

/// Where a distance that shrinks at one end and grows at the other is least.
double BarWalk::least_between(const Sample& from, const Sample& to, unsigned bar) const {
  double before = from.share;
  double after = to.share;
  for (int i = 0; i < kWalkHalvings; ++i) {
    const Sample middle = sample(0.5 * (before + after));
    if (barred(middle.gap[bar])) {
      return middle.share;
    }
    (middle.gap[bar].closing_mps > 0.0 ? before : after) = middle.share;
  }
  return before;
}

double BarWalk::begins_between(double free, double barred_share, unsigned bar) const {
  for (int i = 0; i < kWalkHalvings; ++i) {
    const Sample middle = sample(0.5 * (free + barred_share));
    (barred(middle.gap[bar]) ? barred_share : free) = middle.share;
  }
  return barred_share;
}

BarredPlace BarWalk::between(const Sample& from, const Sample& to) const {
  double first = to.share;
  int found = -1;
  for (unsigned i = 0; i < static_cast<unsigned>(count_); ++i) {
    double place = to.share;
    bool passes = barred(to.gap[i]);
    const double step = to.share - from.share;
    const BarGap& here = from.gap[i];
    const BarGap& there = to.gap[i];
    if (!passes && here.closing_mps > 0.0 && there.closing_mps < 0.0 &&
        std::min(here.distance_m - step * here.closing_mps,
                 there.distance_m + step * there.closing_mps) < 0.0) {
      place = least_between(from, to, i);
      passes = barred(sample(place).gap[i]);
    }
    if (passes) {
      const double begins = begins_between(from.share, place, i);
      if (found < 0 || begins < first) {
        first = begins;
        found = static_cast<int>(i);
      }
    }
  }
  return found < 0 ? BarredPlace{} : at(first, static_cast<unsigned>(found));
}

BarredPlace BarWalk::run() const {
  Sample last = sample(0.0);
  for (unsigned i = 0; i < static_cast<unsigned>(count_); ++i) {
    if (last.status == ReachStatus::kOk && barred(last.gap[i])) {
      return at(0.0, i);
    }
  }
  for (int i = 1; i <= kWalkSteps; ++i) {
    const Sample next = sample(static_cast<double>(i) / kWalkSteps);
    if (last.status != ReachStatus::kOk || next.status != ReachStatus::kOk) {
      return unknown_at(last.status != ReachStatus::kOk ? last.share : next.share);
    }
    const BarredPlace place = between(last, next);
    if (place.why != ProgramRefusal::kNone) {
      return place;
    }
    last = next;
  }
  return {};
}

}  // namespace

DriveMotion step_motion(const SwingKinematics& kinematics, const TaskStep& step, double share) {
  if (step.straight) {
    return line_motion(kinematics, step.line.line, share);
  }
  DriveMotion motion;
  motion.blind = {};
  motion.value = step.drives.from + share * step.drives.change;
  motion.rate = step.drives.change;
  return motion;
}

BarredPlace first_barred_place(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                               const FenceSet& fences, const TaskStep& step) {
  return BarWalk(profile, kinematics, fences, step).run();
}

}  // namespace graben
