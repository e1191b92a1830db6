// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/commission_guard.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// A change of both pressures together that only an open valve makes, and its weight in the time
/// that the drive strains, against 1 of a duty: it may come through an edge that lets hardly any
/// oil.
struct ByPressure {
  double changed_pa;
  double weight;
};
/// Of a side that has moved before. [Pa, -; chosen: what friction holds lets off some MPa through
/// an edge's first leak; 2 MPa, and 3 MPa with 0.5, tried before]
constexpr ByPressure kByPressure = {6e6, 0.3};
/// Of a side that has never moved. [Pa, -; chosen: its duties rise slowly, from rest, and its
/// sensor may hang; 6 MPa with 0.3 tried before]
constexpr ByPressure kByFirstPressure = {3e6, 0.5};

int sign_of(double value) { return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0); }

double forget(double value, double period_s) {
  return value * std::max(0.0, 1.0 - period_s / kGuardForget_s);
}

/// To which side all that is under way takes the drive; 0: to both, or to none.
int way_of(const CommissionState& state) {
  return (state.since_extend_s < kGuardUnderWay_s ? 1 : 0) -
         (state.since_retract_s < kGuardUnderWay_s ? 1 : 0);
}

bool is_reached(const DriveRow& drive, const StrokeWindow& window, int side) {
  return side > 0 ? window.most_m >= drive.most_travel_m - kGuardSame_m
                  : window.least_m <= drive.least_travel_m + kGuardSame_m;
}

/// Stands where the end may be.
bool is_at_end(const DriveRow& drive, const CommissionAsk& ask, const CommissionState& state,
               int side) {
  const double left_m =
      side > 0 ? drive.most_travel_m - state.stroke_m : state.stroke_m - drive.least_travel_m;
  return is_reached(drive, ask.window, side) && left_m < kGuardEndZone_m;
}

void follow_duty(double sent_ratio, double period_s, CommissionState& state) {
  const auto since = [period_s](bool now, double& since_s) {
    since_s = now ? 0.0 : std::min(since_s + period_s, kGuardUnderWay_s);
  };
  since(sent_ratio > 0.0, state.since_extend_s);
  since(sent_ratio < 0.0, state.since_retract_s);
  const bool steady =
      sent_ratio * state.duty_ratio > 0.0 && std::abs(sent_ratio) >= std::abs(state.duty_ratio);
  state.steady_s = steady ? std::min(state.steady_s + period_s, kGuardUnderWay_s) : 0.0;
  if (!steady) {
    state.from_m = state.stroke_m;
  }
  state.duty_ratio = sent_ratio;
}

/// Ways that it must not go.
void follow_way(double step_m, bool alone, double period_s, CommissionState& state) {
  const int way = way_of(state);
  state.wrong_m = way == 0 ? 0.0 : std::max(0.0, forget(state.wrong_m, period_s) - way * step_m);
  const bool nothing =
      state.since_extend_s >= kGuardUnderWay_s && state.since_retract_s >= kGuardUnderWay_s;
  state.still_for_s = nothing ? std::min(state.still_for_s + period_s, kGuardComesToRest_s) : 0.0;
  state.free_m =
      state.still_for_s < kGuardComesToRest_s ? 0.0 : forget(state.free_m, period_s) + step_m;
  if (way != 0) {
    state.whole_m = std::max(0.0, state.whole_m - way * step_m);
  } else {
    state.whole_m = alone || state.still_for_s < kGuardComesToRest_s ? 0.0 : state.whole_m + step_m;
  }
}

void follow_pressures(const ValidDrive& seen, bool begins, double period_s,
                      CommissionState& state) {
  const double newest = begins ? 1.0 : std::min(1.0, period_s / kGuardPressure_s);
  state.cap_pa += newest * (seen.cap_pressure_pa - state.cap_pa);
  state.rod_pa += newest * (seen.rod_pressure_pa - state.rod_pa);
  if (state.duty_ratio == 0.0) {
    state.rest_cap_pa = state.cap_pa;
    state.rest_rod_pa = state.rod_pa;
  }
}

/// Its valve has opened: so much the pressures do not change by themselves.
bool have_pressures_changed(const CommissionAsk& ask, const ValidDrive& seen, double by_pa,
                            const CommissionState& state) {
  return ask.alone && seen.load_known &&
         std::abs(state.cap_pa - state.rest_cap_pa) + std::abs(state.rod_pa - state.rest_rod_pa) >
             by_pa;
}

/// The side that is fed has most of what its pump can give.
bool strains(const DriveRow& drive, const ValidDrive& seen, int side) {
  const double fed_pa = side > 0 ? seen.cap_pressure_pa : seen.rod_pressure_pa;
  return seen.load_known && drive.watch.relief_pa > 0.0 &&
         fed_pa > kGuardStrains * drive.watch.relief_pa;
}

void hold_back(bool pushed, double period_s, CommissionState& state) {
  if (!pushed) {
    state.pushed_s = 0.0;
    state.most_ratio = 1.0;
    return;
  }
  const double rise_ratio = state.pushed_s > kGuardHolds_s ? kGuardRise_ps * period_s : 0.0;
  state.most_ratio = std::min(state.most_ratio, std::abs(state.duty_ratio)) + rise_ratio;
  state.pushed_s += period_s;
}

void look_for_stillness(const DriveRow& drive, const CommissionAsk& ask, const ValidDrive& seen,
                        double period_s, CommissionState& state) {
  const int side = sign_of(state.duty_ratio);
  double& moves = side > 0 ? state.moves_extend : state.moves_retract;
  const bool goes = side * state.speed_mps > kGuardMoves_mps &&
                    side * (state.stroke_m - state.from_m) > kGuardMoved_m;
  if (goes && way_of(state) == side && state.steady_s >= kGuardUnderWay_s) {
    moves = std::min(moves, std::abs(state.duty_ratio));
  }
  const bool at_end = side != 0 && is_at_end(drive, ask, state, side);
  if (side == 0 || std::abs(state.stroke_m - state.still_m) > kGuardStill_m) {
    state.still_m = state.stroke_m;
    state.strained_s = 0.0;
    state.spent_s = 0.0;
    state.touches_s = 0.0;
    hold_back(false, period_s, state);
  } else if (at_end) {
    state.strained_s = 0.0;
    hold_back(false, period_s, state);
    state.touches_s = std::min(state.touches_s + period_s, kGuardTouch_s);
  } else {
    const double duty = std::abs(state.duty_ratio);
    const bool open = duty > std::min(kGuardSurelyOpen, moves + kGuardMoreThanMoved);
    const bool is_first = moves >= 1.0;
    const ByPressure& by = is_first ? kByFirstPressure : kByPressure;
    const bool pushed =
        strains(drive, seen, side) || have_pressures_changed(ask, seen, by.changed_pa, state);
    state.strained_s =
        open || pushed ? state.strained_s + (open ? 1.0 : by.weight) * period_s : 0.0;
    state.spent_s += std::max(0.0, duty - kGuardSurelyClosed) * period_s;
    hold_back(pushed && is_first, period_s, state);
  }
}

/// It has to be stopped now, to be stopped within its window.
bool leaves(const DriveRow& drive, const CommissionAsk& ask, const CommissionState& state,
            int side) {
  const double room_m =
      side > 0 ? ask.window.most_m - state.stroke_m : state.stroke_m - ask.window.least_m;
  const double speed_mps = side * state.speed_mps;
  if (!is_reached(drive, ask.window, side)) {
    return room_m <= std::max(0.0, speed_mps) * kGuardStops_s;
  }
  return state.touches_s >= kGuardTouch_s ||
         std::max(0.0, room_m) < (speed_mps - kGuardTouch_mps) * kGuardStops_s;
}

/// Farther than a drive that is stopped in time ever is.
bool is_outside(const StrokeWindow& window, double stroke_m) {
  return stroke_m > window.most_m + kGuardOutside_m || stroke_m < window.least_m - kGuardOutside_m;
}

Fault fault_of(const CommissionAsk& ask, bool has_window, CommissionState& state) {
  const bool far = std::abs(state.whole_m) > kGuardWhole_m;
  if (state.wrong_m > kGuardWrong_m || (far && way_of(state) != 0)) {
    return Fault::kWrongDirection;
  }
  if (std::abs(state.free_m) > kGuardWrong_m || far) {
    return Fault::kUncommandedMotion;
  }
  if (state.strained_s > kGuardUnderWay_s + kGuardStrained_s || state.spent_s > kGuardSpent_s) {
    return Fault::kStrokeStuck;
  }
  const bool outside = is_outside(ask.window, state.stroke_m);
  state.was_inside = state.was_inside || (has_window && !outside);
  const bool fast = std::abs(state.speed_mps) > ask.window.most_mps;
  return has_window && ((outside && state.was_inside) || fast) ? Fault::kCommissionBound
                                                               : Fault::kNone;
}

}  // namespace

bool is_window(const DriveRow& drive, const StrokeWindow& window) {
  return window.most_mps > 0.0 && window.least_m < window.most_m &&
         window.least_m >= drive.least_travel_m - kGuardSame_m &&
         window.most_m <= drive.most_travel_m + kGuardSame_m;
}

CommissionResult next_commission(const DriveRow& drive, const CommissionAsk& ask,
                                 const ValidDrive& seen, double period_s, CommissionState& state) {
  const bool begins = !state.begun;
  if (begins) {
    state.begun = true;
    state.stroke_m = seen.stroke_m;
    state.slow_m = seen.stroke_m;
    state.still_m = seen.stroke_m;
  }
  const double step_m = seen.stroke_m - state.stroke_m;
  state.stroke_m = seen.stroke_m;
  state.speed_mps = (seen.stroke_m - state.slow_m) / kGuardSpeed_s;
  state.slow_m += (seen.stroke_m - state.slow_m) * std::min(1.0, period_s / kGuardSpeed_s);
  follow_duty(ask.sent_ratio, period_s, state);
  follow_pressures(seen, begins, period_s, state);
  follow_way(step_m, ask.alone, period_s, state);
  look_for_stillness(drive, ask, seen, period_s, state);

  const bool has_window = is_window(drive, ask.window);
  const int side = sign_of(ask.wanted_ratio);
  if (side == 0 || side != state.held_side) {
    state.held_side = 0;
  }
  if (side != 0 && (!has_window || leaves(drive, ask, state, side))) {
    state.held_side = side;
  }
  const bool held = state.held_side != 0;
  const double most_ratio = held ? 0.0 : state.most_ratio;
  return {fault_of(ask, has_window, state), std::clamp(ask.wanted_ratio, -most_ratio, most_ratio),
          held};
}

void rest_commission(CommissionState& state) {
  const CommissionState fresh;
  const double extend = state.moves_extend;
  const double retract = state.moves_retract;
  state = fresh;
  state.moves_extend = extend;
  state.moves_retract = retract;
}

}  // namespace graben
