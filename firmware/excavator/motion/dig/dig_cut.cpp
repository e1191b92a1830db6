// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/cut_force.hpp"
#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/layer_height.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// A wall that breaks off lets the oil throw the teeth down: its force counts for more.
double counts(const DigRun& run, double force) {
  return run.share < 0.0 ? force / kWallPulls : force;
}

/// How heavy the cut is now; 1: as heavy as it may be. `force`: of that on the teeth.
double heavy_of(const DigCycle& cycle, double force, const TaskState& state) {
  const TeethLine line = cut_line(cycle.program, state);
  const double borne = kBorne * force_share(cycle.plan(), line, cycle.seen, true);
  return heaviness(cycle.plan(), counts(state.dig, std::max(force, borne)) / state.dug.cuts.force,
                   cycle.seen);
}

/// The edge's height, which gives way upwards to what is too heavy.
void give_way(const DigCycle& cycle, double force, double heavy, TaskState& state) {
  DigRun& run = state.dig;
  const CutSeen& seen = cycle.seen;
  const Cut& at = state.dug.cuts.cut;
  const double change_m = heavy > 1.0     ? kGives_mps * std::min(1.0, 2.0 * (heavy - 1.0))
                          : heavy < kEasy ? -kReturns_mps
                                          : 0.0;
  run.give_m = std::clamp(run.give_m + cycle.period_s * change_m, 0.0, at.enters_m - at.height_m);
  // What the oil gives back when the force goes must not lead through the design.
  const double throws = turns(cycle.program, state) ? kSteepThrows : 1.0;
  const double gives_m = std::max(throws * cycle.plan().give_mpn * force * cycle.plan().force_n,
                                  off_foot_m(cycle.plan(), at, seen));
  const double springs_m = gives_m - kCutSpringFree_m - at.height_m;
  // Nor is soil that holds the teeth up pressed on by a plan that is farther below than this.
  const double held_up_m = seen_height_m(cycle.program, seen, state) -
                           kBehind_share * cycle.plan().bucket_m - at.height_m;
  rise(cycle,
       std::max(at.height_m + std::max({run.give_m, springs_m, held_up_m}),
                wanted_height_m(cycle.program, state)),
       run.share < 0.0 ? kFootDown_mps : kReturns_mps, state);
}

/// Along the line, slower where it is heavy and before its end.
void get_on(const DigCycle& cycle, double heavy, TaskState& state) {
  DigRun& run = state.dig;
  const double most_ps = most_rate_ps(cycle.program, state) *
                         std::clamp((kHoldsAt - heavy) / (kHoldsAt - kSlowsAt), 0.0, 1.0);
  const double acceleration_ps2 = cycle.profile.line.acceleration_mps2 / cycle.plan().way_m;
  const double brakes_ps = std::sqrt(2.0 * acceleration_ps2 * std::max(0.0, 1.0 - run.share));
  const double by_ps = acceleration_ps2 * cycle.period_s;
  run.rate_ps =
      std::clamp(std::min(most_ps, brakes_ps), run.rate_ps - 4.0 * by_ps, run.rate_ps + by_ps);
  run.share =
      std::min(1.0, run.share + std::max(0.0, run.rate_ps) * state.pace_ratio * cycle.advance_s);
  if (1.0 - run.share < 1e-4) {
    run.share = 1.0;
    run.rate_ps = 0.0;
  }
}

/// What the edge has passed since the last cycle is in the bucket.
void take(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const TeethLine line = line_over(cycle.program, state.dug.cuts.cut.strip, 0.0);
  const Eigen::Vector3d off_m = cycle.seen.teeth.position_m - line.from.position_m;
  const double share = off_m.dot(line.change.position_m) / line.change.position_m.squaredNorm();
  if (share > run.seen_share) {
    state.dug.cuts.filled_m3 +=
        pass(cycle.plan(), share, run.seen_share, seen_height_m(cycle.program, cycle.seen, state),
             state.dug.cuts);
    run.seen_share = share;
  }
}

bool ends(const DigCycle& cycle, double heavy, TaskState& state) {
  DigRun& run = state.dig;
  const CutState& cuts = state.dug.cuts;
  const double speed_mps = cycle.plan().way_m * run.rate_ps * state.pace_ratio;
  const bool held = heavy > 1.0 && speed_mps < kGetsOn_mps;
  const bool at_end = run.share >= 1.0;
  run.held_s = held || at_end ? run.held_s + cycle.period_s : 0.0;
  const bool reached = at_end && (cycle.seen.behind_m < kEndNear_m || run.held_s > kEndWait_s);
  const double held_most_s = run.share < 0.0 ? kWallHeld_s : kCutHeld_s;
  return reached || run.held_s > held_most_s ||
         cuts.loaded_m3 + cuts.filled_m3 >=
             std::max(filling_m3(cycle.plan(), cuts), cuts.cut.volume_m3);
}

}  // namespace

void CutsPhase::enter(const DigCycle& cycle, int /*step*/, TaskState& state) {
  DigRun& run = state.dig;
  const double least_m = wanted_height_m(cycle.program, state);
  if (run.eases) {
    run.height_m = std::max(least_m, seen_height_m(cycle.program, cycle.seen, state));
    run.height_mps = 0.0;
    run.eases = false;
  }
  // What it can't be pressed down to is come down to on the way.
  run.give_m = std::max(0.0, run.height_m - least_m);
  run.entered = cycle.seen.teeth;
  state.dug.loaded = true;
  run.held_s = 0.0;
}

bool CutsPhase::go_on(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const double force = force_share(cycle.plan(), cut_line(cycle.program, state), cycle.seen, false);
  const double heavy = heavy_of(cycle, force, state);
  if (!turns(cycle.program, state)) {
    run.cut_s += cycle.period_s;
    run.heavy_s += heavy * cycle.period_s;
  }
  give_way(cycle, force, heavy, state);
  get_on(cycle, heavy, state);
  take(cycle, state);
  return ends(cycle, heavy, state);
}

void CutsPhase::leave(const DigCycle& cycle, TaskState& state) {
  enter_phase<LiftPhase>(cycle, state.step, state);
  const DigRun& run = state.dig;
  next_cut(cycle.plan(),
           {run.cut_s > 0.0 ? run.heavy_s / run.cut_s : kHoldsAt, state.dug.cuts.filled_m3,
            std::max(0.0, run.share)},
           state.dug.cuts);
}

}  // namespace graben
