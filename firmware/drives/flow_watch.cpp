// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/flow_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/oil_lengths.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// Widens the range by what a side's change of pressure moves the drive without any flow.
void give_way(double change_pa, double oil_m, bool both_ways, double& least_m, double& most_m) {
  const double soft_m = change_pa * oil_m / kFlowSoftest_pa;
  const double stiff_m = both_ways ? 0.0 : change_pa * oil_m / kFlowStiffest_pa;
  least_m += std::min(soft_m, stiff_m);
  most_m += std::max(soft_m, stiff_m);
}

void compress(const DriveRow& drive, const ValidDrive& seen, FlowState& state) {
  const double cap_change_pa = kFlowPressureShare * (seen.cap_pressure_pa - state.cap_pa);
  const double rod_change_pa = kFlowPressureShare * (seen.rod_pressure_pa - state.rod_pa);
  state.cap_pa += cap_change_pa;
  state.rod_pa += rod_change_pa;
  const OilLengths oil = oil_lengths(drive, seen.stroke_m);
  const bool extends = seen.spool_ratio > 0.0;
  const double drained_pa = extends ? seen.rod_pressure_pa : seen.cap_pressure_pa;
  if (extends || drained_pa < kFlowEmpty_pa) {
    give_way(rod_change_pa, oil.rod_m, !extends, state.least_m, state.most_m);
  }
  if (!extends || drained_pa < kFlowEmpty_pa) {
    give_way(-cap_change_pa, oil.cap_m, extends, state.least_m, state.most_m);
  }
}

/// One side's pressure is that of a living sensor.
bool lives(double shown_pa, double last_pa) {
  return shown_pa != last_pa || shown_pa <= kEmptyChamber_pa;
}

/// False: nothing can be said of this cycle.
bool may_be_used(const DriveRow& drive, const ValidDrive& seen, FlowState& state) {
  if (!has_edges(drive)) {
    return true;
  }
  const bool alive = lives(seen.cap_pressure_pa, state.cap_shown_pa) &&
                     lives(seen.rod_pressure_pa, state.rod_shown_pa);
  const bool steps = std::abs(seen.cap_pressure_pa - state.cap_shown_pa) > kFlowStep_pa ||
                     std::abs(seen.rod_pressure_pa - state.rod_shown_pa) > kFlowStep_pa;
  state.same_cycles = alive ? 0 : std::min(state.same_cycles + 1, kFlowSameCycles);
  state.cap_shown_pa = seen.cap_pressure_pa;
  state.rod_shown_pa = seen.rod_pressure_pa;
  const double drained_pa = seen.spool_ratio > 0.0 ? seen.rod_pressure_pa : seen.cap_pressure_pa;
  return state.same_cycles < kFlowSameCycles && !steps &&
         drained_pa < kFlowNearRail * drive.watch.pressure_rail_pa;
}

void tell(double late_s, double spool_ratio, double period_s, SpoolSpan& told) {
  told.for_s += period_s;
  if (told.for_s > late_s) {
    told = {spool_ratio, spool_ratio, told.low, told.high, 0.0};
  }
  told.low = std::min(told.low, spool_ratio);
  told.high = std::max(told.high, spool_ratio);
}

SpeedRange speed_at(double spool_ratio, const DriveRow& drive, const LearntValve* learnt,
                    const ValidDrive& calm, double engine_radps) {
  ValidDrive there = calm;
  there.spool_ratio = spool_ratio;
  return possible_speed(drive, learnt, there, engine_radps);
}

/// The range of all places that the spool may be at: the further it is out, the faster.
SpeedRange speed_now(const DriveRow& drive, const LearntValve* learnt, const ValidDrive& calm,
                     double engine_radps, const SpoolSpan& told) {
  if (!(drive.watch.spool_late_s > 0.0)) {
    return possible_speed(drive, learnt, calm, engine_radps);
  }
  const SpeedRange low =
      speed_at(std::min(told.low, told.last_low), drive, learnt, calm, engine_radps);
  const SpeedRange high =
      speed_at(std::max(told.high, told.last_high), drive, learnt, calm, engine_radps);
  return {std::min(low.least_mps, high.least_mps), std::max(low.most_mps, high.most_mps)};
}

/// From here on; what it was off before stays.
void begin(const ValidDrive& seen, FlowState& state) {
  state.begun = true;
  state.stroke_m = seen.stroke_m;
  state.still_m = seen.stroke_m;
  state.cap_pa = seen.cap_pressure_pa;
  state.rod_pa = seen.rod_pressure_pa;
  state.last = {};
  state.least_m = 0.0;
  state.most_m = 0.0;
  state.extend_m = 0.0;
  state.retract_m = 0.0;
}

/// What it was off before is forgotten as ever, no faster: a pressure that is away again and again
/// would hide all of it.
void lose_load(double period_s, FlowState& state) {
  const double kept = 1.0 - std::min(1.0, period_s / kFlowForget_s);
  state.begun = false;
  state.behind_m *= kept;
  state.ahead_m *= kept;
  state.extend_m = 0.0;
  state.retract_m = 0.0;
}

/// A stroke has come: what may have happened since the last one against what it says.
void compare(const ValidDrive& seen, double period_s, FlowState& state) {
  const double moved_m = seen.stroke_m - state.stroke_m;
  const double kept = 1.0 - std::min(1.0, period_s / kFlowForget_s);
  state.behind_m = kept * std::max(0.0, state.behind_m + state.least_m - moved_m);
  state.ahead_m = kept * std::max(0.0, state.ahead_m + moved_m - state.most_m);
  if (std::abs(seen.stroke_m - state.still_m) > kFlowStill_m) {
    state.still_m = seen.stroke_m;
    state.extend_m = 0.0;
    state.retract_m = 0.0;
  } else {
    state.extend_m = kept * std::max(0.0, state.extend_m + state.least_m);
    state.retract_m = kept * std::max(0.0, state.retract_m - state.most_m);
  }
  state.stroke_m = seen.stroke_m;
  state.least_m = 0.0;
  state.most_m = 0.0;
}

void follow(const DriveRow& drive, const ValidDrive& seen, const LearntValve* learnt,
            double engine_radps, double period_s, FlowState& state) {
  if (has_edges(drive)) {
    compress(drive, seen, state);
  }
  ValidDrive calm = seen;
  calm.cap_pressure_pa = state.cap_pa;
  calm.rod_pressure_pa = state.rod_pa;
  const SpeedRange now = speed_now(drive, learnt, calm, engine_radps, state.told);
  state.least_m += period_s * std::min(now.least_mps, state.last.least_mps);
  state.most_m += period_s * std::max(now.most_mps, state.last.most_mps);
  state.last = now;
  if (seen.stroke_is_new) {
    compare(seen, period_s, state);
  }
}

}  // namespace

FaultSet watch_flow(DriveRows drives, Span<const ValidDrive> seen, Span<const LearntValve> learnt,
                    double engine_radps, double period_s, Span<FlowState> state) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& bounds = drives[i].watch;
    tell(bounds.spool_late_s, seen[i].spool_ratio, period_s, state[i].told);
    if (!(bounds.unseen_m > 0.0) || !bounds.senses_spool) {
      state[i] = {};
    } else if (!seen[i].load_known && has_edges(drives[i])) {
      lose_load(period_s, state[i]);
    } else if (!may_be_used(drives[i], seen[i], state[i])) {
      state[i].begun = false;
    } else if (!state[i].begun) {
      begin(seen[i], state[i]);
    } else {
      follow(drives[i], seen[i], i < learnt.count() ? &learnt[i] : nullptr, engine_radps, period_s,
             state[i]);
    }
    if (std::max(state[i].extend_m, state[i].retract_m) > bounds.unseen_m) {
      faults.add(Fault::kStrokeStuck);
    }
    if (std::max(state[i].behind_m, state[i].ahead_m) > bounds.off_m) {
      faults.add(Fault::kMotionImplausible);
    }
  }
  return faults;
}

}  // namespace graben
