// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/commission_guard.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Of the speed: three strokes of noise are little in it, and it is soon there.
constexpr double kSpeed_s = 0.08;
/// How far the drive may go wrong. With what it then still goes it is within 50 mm.
constexpr double kWrong_m = 0.03;
/// The same for as long as the duties go on, however slowly.
constexpr double kWhole_m = 0.045;
/// What creeps is forgotten: slower than kWrong_m in this time it may go on for ever.
constexpr double kForget_s = 5.0;
/// Noise, and what the oil gives.
constexpr double kStill_m = 0.0005;
/// No edge is later than this.
constexpr double kSurelyOpen = 0.65;
/// Beyond a duty that has moved the drive, for another load.
constexpr double kMoreThanMoved = 0.1;
constexpr double kMoves_mps = 0.01;
/// And farther than a linkage rocks on its oil.
constexpr double kMoved_m = 0.015;
constexpr double kStrained_s = 0.4;
constexpr double kPressure_s = 0.1;
/// Both pressures together, for certain by the valve: what friction holds lets off some MPa through
/// the first leak of an edge without moving. It counts for less than a duty: it comes through an
/// edge that lets hardly any oil.
struct ByPressure {
  double changed_pa;
  double weight;
};
constexpr ByPressure kByPressure = {6e6, 0.3};
/// Of a side that has never moved: its duties rise slowly, from rest.
constexpr ByPressure kByFirstPressure = {3e6, 0.5};
/// Meanwhile the duty is held for so long, then rises slowly: friction wants more than an edge.
constexpr double kHolds_s = 1.0;
constexpr double kRises_ratio_ps = 0.03;
/// Duty beyond this, times time, is bounded where nothing moves.
constexpr double kSurelyClosed = 0.1;
constexpr double kSpent_s = 2.0;
/// Of the relief's pressure: hardly any oil flows.
constexpr double kStrains = 0.8;
/// Of a window's ends, and of the cylinder's: more than a frame resolves.
constexpr double kSame_m = 0.001;

int sign_of(double value) { return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0); }

double forget(double value, double period_s) {
  return value * std::max(0.0, 1.0 - period_s / kForget_s);
}

/// To which side all that is under way takes the drive; 0: to both, or to none.
int way_of(const CommissionState& state) {
  return (state.since_extend_s < kUnderWay_s ? 1 : 0) -
         (state.since_retract_s < kUnderWay_s ? 1 : 0);
}

bool is_reached(const DriveRow& drive, const StrokeWindow& window, int side) {
  return side > 0 ? window.most_m >= drive.most_travel_m - kSame_m
                  : window.least_m <= drive.least_travel_m + kSame_m;
}

/// Stands where the end may be.
bool is_at_end(const DriveRow& drive, const CommissionAsk& ask, const CommissionState& state,
               int side) {
  const double left_m =
      side > 0 ? drive.most_travel_m - state.stroke_m : state.stroke_m - drive.least_travel_m;
  return is_reached(drive, ask.window, side) && left_m < kEndZone_m;
}

void follow_duty(double sent_ratio, double period_s, CommissionState& state) {
  const auto since = [period_s](bool now, double& since_s) {
    since_s = now ? 0.0 : std::min(since_s + period_s, kUnderWay_s);
  };
  since(sent_ratio > 0.0, state.since_extend_s);
  since(sent_ratio < 0.0, state.since_retract_s);
  const bool steady =
      sent_ratio * state.duty_ratio > 0.0 && std::abs(sent_ratio) >= std::abs(state.duty_ratio);
  state.steady_s = steady ? std::min(state.steady_s + period_s, kUnderWay_s) : 0.0;
  if (!steady) {
    state.from_m = state.stroke_m;
  }
  state.duty_ratio = sent_ratio;
}

/// Ways that it must not go.
void follow_way(double step_m, bool alone, double period_s, CommissionState& state) {
  const int way = way_of(state);
  state.wrong_m = way == 0 ? 0.0 : std::max(0.0, forget(state.wrong_m, period_s) - way * step_m);
  const bool nothing = state.since_extend_s >= kUnderWay_s && state.since_retract_s >= kUnderWay_s;
  state.still_for_s = nothing ? std::min(state.still_for_s + period_s, kComesToRest_s) : 0.0;
  state.free_m = state.still_for_s < kComesToRest_s ? 0.0 : forget(state.free_m, period_s) + step_m;
  if (way != 0) {
    state.whole_m = std::max(0.0, state.whole_m - way * step_m);
  } else {
    state.whole_m = alone || state.still_for_s < kComesToRest_s ? 0.0 : state.whole_m + step_m;
  }
}

void follow_pressures(const ValidDrive& seen, bool begins, double period_s,
                      CommissionState& state) {
  const double newest = begins ? 1.0 : std::min(1.0, period_s / kPressure_s);
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
         fed_pa > kStrains * drive.watch.relief_pa;
}

void hold_back(bool pushed, double period_s, CommissionState& state) {
  if (!pushed) {
    state.pushed_s = 0.0;
    state.most_ratio = 1.0;
    return;
  }
  const double rise_ratio = state.pushed_s > kHolds_s ? kRises_ratio_ps * period_s : 0.0;
  state.most_ratio = std::min(state.most_ratio, std::abs(state.duty_ratio)) + rise_ratio;
  state.pushed_s += period_s;
}

void look_for_stillness(const DriveRow& drive, const CommissionAsk& ask, const ValidDrive& seen,
                        double period_s, CommissionState& state) {
  const int side = sign_of(state.duty_ratio);
  double& moves = side > 0 ? state.moves_extend : state.moves_retract;
  const bool goes =
      side * state.speed_mps > kMoves_mps && side * (state.stroke_m - state.from_m) > kMoved_m;
  if (goes && way_of(state) == side && state.steady_s >= kUnderWay_s) {
    moves = std::min(moves, std::abs(state.duty_ratio));
  }
  const bool at_end = side != 0 && is_at_end(drive, ask, state, side);
  if (side == 0 || std::abs(state.stroke_m - state.still_m) > kStill_m) {
    state.still_m = state.stroke_m;
    state.strained_s = 0.0;
    state.spent_s = 0.0;
    state.touches_s = 0.0;
    hold_back(false, period_s, state);
  } else if (at_end) {
    state.strained_s = 0.0;
    hold_back(false, period_s, state);
    state.touches_s = std::min(state.touches_s + period_s, kTouch_s);
  } else {
    const double duty = std::abs(state.duty_ratio);
    const bool open = duty > std::min(kSurelyOpen, moves + kMoreThanMoved);
    const bool is_first = moves >= 1.0;
    const ByPressure& by = is_first ? kByFirstPressure : kByPressure;
    const bool pushed =
        strains(drive, seen, side) || have_pressures_changed(ask, seen, by.changed_pa, state);
    state.strained_s =
        open || pushed ? state.strained_s + (open ? 1.0 : by.weight) * period_s : 0.0;
    state.spent_s += std::max(0.0, duty - kSurelyClosed) * period_s;
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
    return room_m <= std::max(0.0, speed_mps) * kStops_s;
  }
  return state.touches_s >= kTouch_s || std::max(0.0, room_m) < (speed_mps - kTouch_mps) * kStops_s;
}

/// Farther than a drive that is stopped in time ever is.
bool is_outside(const StrokeWindow& window, double stroke_m) {
  return stroke_m > window.most_m + kOutside_m || stroke_m < window.least_m - kOutside_m;
}

Fault fault_of(const CommissionAsk& ask, bool has_window, CommissionState& state) {
  const bool far = std::abs(state.whole_m) > kWhole_m;
  if (state.wrong_m > kWrong_m || (far && way_of(state) != 0)) {
    return Fault::kWrongDirection;
  }
  if (std::abs(state.free_m) > kWrong_m || far) {
    return Fault::kUncommandedMotion;
  }
  if (state.strained_s > kUnderWay_s + kStrained_s || state.spent_s > kSpent_s) {
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
         window.least_m >= drive.least_travel_m - kSame_m &&
         window.most_m <= drive.most_travel_m + kSame_m;
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
  state.speed_mps = (seen.stroke_m - state.slow_m) / kSpeed_s;
  state.slow_m += (seen.stroke_m - state.slow_m) * std::min(1.0, period_s / kSpeed_s);
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
