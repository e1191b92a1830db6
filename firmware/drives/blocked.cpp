#include "firmware/drives/blocked.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Of the line's pressure, on the side that is fed: straining from the one on, until under the
/// other.
constexpr double kStrains = 0.7;
constexpr double kEasesOff = 0.6;
/// Of the speed that is asked for: standing under the one, moving over the other.
constexpr double kStands = 0.2;
constexpr double kMoves = 0.5;
/// Less than this is no motion to wait for, m/s.
constexpr double kLeastAsked_mps = 0.002;
constexpr double kFilter_s = 0.1;
constexpr double kKnown_s = 0.1;
constexpr double kEase_s = 0.3;

int way_of(const DriveRow& drive, double spool_ratio, double asked_mps) {
  if (std::abs(spool_ratio) <= drive.spool_to_duty.y_first() || spool_ratio * asked_mps <= 0.0) {
    return 0;
  }
  return spool_ratio > 0.0 ? 1 : -1;
}

void follow(const ValidDrive& seen, double asked_mps, double line_pa, double period_s,
            BlockedState& state) {
  const double newest = period_s / (period_s + kFilter_s);
  const double inlet_pa = state.way > 0 ? seen.cap_pressure_pa : seen.rod_pressure_pa;
  const double speed_mps =
      period_s > 0.0 ? state.way * (seen.stroke_m - state.stroke_m) / period_s : 0.0;
  state.inlet_pa += newest * (inlet_pa - state.inlet_pa);
  state.asked_mps += newest * (std::abs(asked_mps) - state.asked_mps);
  state.speed_mps += newest * (speed_mps - state.speed_mps);
  const double share = state.strains ? kEasesOff : kStrains;
  state.strains = line_pa > 0.0 && state.inlet_pa >= share * line_pa;
  const double moves = state.side == 0 ? kStands : kMoves;
  const bool stands =
      state.asked_mps > kLeastAsked_mps && state.speed_mps < moves * state.asked_mps;
  state.since_s = state.strains && stands ? std::min(state.since_s + period_s, kKnown_s) : 0.0;
  state.side = state.since_s >= kKnown_s ? state.way : 0;
}

void ease(double period_s, BlockedState& state) {
  const double step = period_s / kEase_s;
  if (state.side != 0 && state.side != state.eased_side) {
    state.eased_side = state.side;
    state.eased = 0.0;
  }
  state.eased = std::clamp(state.eased + (state.side != 0 ? step : -step), 0.0, 1.0);
}

}  // namespace

void next_blocked(DriveRows drives, Span<const ValidDrive> seen, const BlockedAsk& ask,
                  double period_s, Span<BlockedState> state) {
  for (int i = 0; i < drives.count(); ++i) {
    BlockedState& drive = state[i];
    const int way =
        seen[i].load_known ? way_of(drives[i], seen[i].spool_ratio, ask.asked_mps[i]) : 0;
    if (way == 0 || way != drive.way) {
      BlockedState begun;
      begun.way = way;
      begun.eased_side = drive.eased_side;
      begun.eased = drive.eased;
      drive = begun;
    } else {
      follow(seen[i], ask.asked_mps[i], ask.line_pa[i], period_s, drive);
    }
    drive.stroke_m = seen[i].stroke_m;
    ease(period_s, drive);
  }
}

double eased_mps(const BlockedState& state, double wanted_mps, double corrected_mps) {
  const double most_mps = state.eased_side * std::max(0.0, state.eased_side * wanted_mps);
  const double over_mps = corrected_mps - most_mps;
  return state.eased_side * over_mps > 0.0 ? corrected_mps - state.eased * over_mps : corrected_mps;
}

bool any_blocked(Span<const BlockedState> state) {
  return std::any_of(state.begin(), state.end(),
                     [](const BlockedState& drive) { return drive.side != 0; });
}

Limit blocked_limit(Span<const BlockedState> state) {
  for (int i = 0; i < state.count(); ++i) {
    if (state[i].side != 0) {
      return {LimitKind::kBackFlow, static_cast<std::uint8_t>(i)};
    }
  }
  return {};
}

}  // namespace graben
