// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// Which cut comes next, by what the last one has brought. False: there is none.
bool choose_cut(const DigCycle& cycle, TaskState& state) {
  Dug& dug = state.dug;
  if (!dug.begun) {
    dug.cuts = undug(cycle.plan());
    dug.begun = true;
  }
  weigh_cut(cycle.plan(), state.dig.weighed_kg / kGround_kgpm3, dug.cuts);
  if (dug.cuts.met) {
    return false;
  }
  Cut& cut = dug.cuts.cut;
  cut.steep = steepest(cycle.kinematics, cycle.program, cut);
  if (dug.cuts.swept && dug.cuts.wall_falls) {
    begin_beyond(cycle.kinematics, cycle.program, cut);
  }
  return true;
}

/// Where the next cut, or the touch before it, begins.
TeethPose cut_begins(const DigCycle& cycle, const TaskState& state) {
  const Cut& cut = state.dug.cuts.cut;
  return first_phase(cycle.program, state) == CutPhase::kTouches
             ? first_touch_pose(cycle.kinematics, cycle.program, cut.strip)
             : cut_pose(cycle.program, cut, cut.from_share, cut.enters_m + state.dug.zero_m);
}

}  // namespace

/// To where the step leads; the last before the cut, to where the next cut begins.
void MovePhase::enter(const DigCycle& cycle, int step, TaskState& state) {
  const TaskStep& asked = cycle.program.step[static_cast<unsigned>(step)];
  const DriveVector from = drives_now(cycle, state);
  DriveVector to = asked.drives.from + asked.drives.change;
  if (cycle.after(step) == cycle.plan().step) {
    if (!choose_cut(cycle, state)) {
      state.phase = TaskPhase::kDone;
      state.stands = from;
      return;
    }
    const DriveResult drives = cycle.kinematics.drive_from_teeth(cut_begins(cycle, state));
    if (drives.blind.kind == BlindKind::kNone) {
      to = drives.value;
    }
  }
  state.dig.move =
      plan_drives(drive_limits(cycle.profile), from, to, {asked.pace_ratio, asked.least_s});
}

bool MovePhase::go_on(const DigCycle& cycle, TaskState& state) {
  const CutSeen& seen = cycle.seen;
  const StepKind kind = cycle.program.step[static_cast<unsigned>(state.step)].kind;
  if (kind == StepKind::kSwing && seen.payload_known) {
    state.dig.weighed_kg = seen.payload_kg;
  }
  state.time_s += state.pace_ratio * cycle.advance_s;
  const double end_s = state.dig.move.ramp.duration_s;
  if (state.time_s < end_s) {
    return false;
  }
  state.time_s = end_s;
  state.settle_s += cycle.period_s;
  const bool digs_next = cycle.after(state.step) == cycle.plan().step;
  state.calm_s = seen.behind_m < kMoveSettled_m ? state.calm_s + cycle.period_s : 0.0;
  const bool arrived =
      digs_next ? state.calm_s >= kCalm_s : seen.behind_m < kPassed_share * cycle.plan().bucket_m;
  return arrived || state.settle_s >= (digs_next ? kCutWaits_s : kSettleMost_s);
}

void MovePhase::leave(const DigCycle& cycle, TaskState& state) {
  const StepKind kind = cycle.program.step[static_cast<unsigned>(state.step)].kind;
  state.dug.loaded = state.dug.loaded && kind != StepKind::kDump;
  enter_step(cycle, cycle.after(state.step), state);
}

}  // namespace graben
