// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/drive_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/learnt/tuning.hpp"
#include "firmware/drives/tuning.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {
namespace {

/// What is asked of drives whose load may hold them is no way that they must go. One that is held
/// lets its oil off without moving, and is thrown by it when the load gives way, wherever its spool
/// is by then.
FaultSet watch_moving(DriveRows drives, const DriveCommands& last, Span<const ValidDrive> seen,
                      double period_s, DriveWatchView state) {
  next_blocked(drives, seen, last.ask, period_s, state.blocked);
  std::array<double, kMostDrives> must_mps{};
  for (int i = 0; i < drives.count(); ++i) {
    const BlockedState& blocked = state.blocked[i];
    const bool held = blocked.strains || blocked.side != 0;
    must_mps[static_cast<unsigned>(i)] = held ? 0.0 : last.ask.asked_mps[i];
    if (blocked.less > 0.0) {
      state.direction[i] = {};
    }
  }
  FaultSet stops = watch_motion(drives, seen, must_mps, period_s, state.motion);
  for (int i = 0; i < drives.count(); ++i) {
    const BlockedState& blocked = state.blocked[i];
    const bool held = blocked.strains || blocked.side != 0 || blocked.less > 0.0;
    if (watch_way(drives[i], seen[i], {last.ask.asked_mps[i], held}, period_s, state.way[i])) {
      stops.add(Fault::kMotionImplausible);
    }
  }
  stops.add(watch_direction(drives, seen, period_s, state.direction));
  return stops;
}

/// Where duties were tried it is not known how long their valves take: nobody asks once they have.
FaultSet watch_rests(DriveRows drives, const DriveCommands& last, Span<const ValidDrive> seen,
                     double period_s, DriveWatchView state, CommonValid& valid) {
  FaultSet stops;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& watch = drives[i].watch;
    const RestBounds bounds = rest_bounds(drives[i]);
    RestState& rest = state.rest[i];
    const bool spool_known = watch.senses_spool && !valid.faults.has(Fault::kSpoolMissing);
    const bool centred = spool_known && std::abs(seen[i].spool_ratio) <= watch.spool_tolerance;
    if (last.active || state.tried_s > 0.0) {
      ask_of(bounds, last.ask.asked_mps[i], rest);
    } else if (valid.by_hand() && spool_known && !centred) {
      ask_of(bounds, bounds.fastest_mps, rest);  // By his levers.
    } else {
      const RestSeen now = {seen[i].stroke_m, centred, valid.by_hand(), seen[i].stroke_known};
      const RestVerdict verdict = watch_rest(bounds, now, period_s, rest);
      if (verdict == RestVerdict::kMoves && !valid.by_hand()) {
        stops.add(Fault::kUncommandedMotion);
      } else if (verdict != RestVerdict::kRests) {
        warn(Fault::kUncommandedMotion, valid);
      }
    }
  }
  return stops;
}

/// No load presses, nor has one lately: what a slow drive does then is its valve's doing.
bool is_in_air(DriveRows drives, Span<const ValidDrive> seen, double period_s, double& pressed_s) {
  bool known = true;
  pressed_s = std::max(0.0, pressed_s - period_s);
  for (int i = 0; i < drives.count(); ++i) {
    if (!has_edges(drives[i]) || !drives[i].control.has_end_stops) {
      continue;
    }
    const double highest_pa = std::max(seen[i].cap_pressure_pa, seen[i].rod_pressure_pa);
    known = known && seen[i].load_known;
    if (highest_pa > kLearntPressed * drives[i].watch.relief_pa) {
      pressed_s = kLearntInAir_s;
    }
  }
  return known && pressed_s == 0.0;
}

void learn_valves(DriveRows drives, const DriveCommands& last, Span<const ValidDrive> seen,
                  bool moving, double period_s, DriveWatchView state) {
  const LearntFrom from = is_in_air(drives, seen, period_s, state.pressed_s)
                              ? LearntFrom::kAnyMotion
                              : LearntFrom::kPlainMotion;
  for (int i = 0; i < std::min(drives.count(), state.learnt.count()); ++i) {
    const BlockedState& blocked = state.blocked[i];
    const bool free = blocked.side == 0 && blocked.less == 0.0 && !blocked.strains;
    next_learnt(drives[i], seen[i], {last.ask.asked_mps[i], last.opening[i]},
                moving && free ? from : LearntFrom::kNothing, period_s, state.learnt[i]);
  }
}

}  // namespace

FaultSet watch_drives(DriveRows drives, const BusCapabilities& bus, const DriveCommands& last,
                      Span<ValidDrive> seen, double period_s, DriveWatchView state,
                      CommonValid& valid) {
  const bool received = !valid.faults.has(Fault::kSpoolMissing);
  state.tried_s = last.sent.tried ? kTriedFor_s : std::max(0.0, state.tried_s - period_s);
  SentCommand sent = last.sent;
  sent.tried = state.tried_s > 0.0;
  FaultSet stops = watch_spools(
      drives, sent, seen,
      {received, bus.valve_echo, valid.valve_enabled, bus.echo_cycles, cycles_in(period_s)},
      state.spool, state.echo_cycles);
  for (int i = 0; i < drives.count(); ++i) {
    if (!drives[i].watch.senses_spool) {
      seen[i].spool_ratio = last.sent.duty_ratio[i];
    }
  }
  state.closing = last.moving || still_closing(state.closing, spools_centred(drives, seen),
                                               Fault::kSpoolMissing, valid);
  if (!state.closing) {
    stops.remove(Fault::kSpoolStuck);
    stops.remove(Fault::kSpoolLate);
  }
  stops.add(watch_rests(drives, last, seen, period_s, state, valid));
  // Without their strokes and spools the drives cannot be checked, and the fault is there anyway.
  const bool moving = last.moving && valid.fault == Fault::kNone;
  const bool by_model = moving && !sent.tried;
  if (by_model) {
    stops.add(watch_moving(drives, last, seen, period_s, state));
  }
  learn_valves(drives, last, seen, by_model, period_s, state);
  if (any_eases(state.blocked)) {
    // Through the linkage the others' oil lets off as well.
    std::fill(state.flow.begin(), state.flow.end(), FlowState{});
    std::fill(state.way.begin(), state.way.end(), WayState{});
  }
  if (by_model) {
    stops.add(watch_flow(drives, seen, state.learnt, valid.engine_radps, period_s, state.flow));
  } else {
    std::fill(state.blocked.begin(), state.blocked.end(), BlockedState{});
    std::fill(state.motion.begin(), state.motion.end(), MotionState{});
    std::fill(state.way.begin(), state.way.end(), WayState{});
    std::fill(state.direction.begin(), state.direction.end(), DirectionState{});
    std::fill(state.flow.begin(), state.flow.end(), FlowState{});
  }
  if (!moving) {
    std::fill(state.pressure.begin(), state.pressure.end(), PressurePair{});
  } else if (watch_pressures(drives, sent.tried ? kEmptyUnknown_pa : kEmptyChamber_pa, seen,
                             period_s, state.pressure)) {
    degrade(Fault::kPressureImplausible, valid);
  }
  return stops;
}

}  // namespace graben
