// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/spool_parking.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/spool_opening.hpp"

namespace graben {
namespace {

constexpr double kForget_s = 3.0;
constexpr double kMostOfOneReversal_m = 0.04;
constexpr double kMost_mps = 0.04;
constexpr double kPathReverses_mps = 0.003;
/// Of the dead band.
constexpr double kWithin = 0.7;

int side_of(double velocity_mps) { return velocity_mps > 0.0 ? 1 : (velocity_mps < 0.0 ? -1 : 0); }

}  // namespace

bool park(double wanted_mps, double corrected_mps, double period_s, ParkingState& state) {
  state.reversals_ps *= kForget_s / (kForget_s + std::max(0.0, period_s));
  const int side = side_of(corrected_mps);
  const double most_mps = std::min(kMostOfOneReversal_m * state.reversals_ps, kMost_mps);
  state.parked = state.side != 0 && side != state.side && side * wanted_mps <= kPathReverses_mps &&
                 std::abs(corrected_mps) < most_mps;
  if (!state.parked && side != state.side) {
    state.reversals_ps += 1.0 / kForget_s;
    state.side = side;
  }
  return state.parked;
}

double parked_duty(const DriveRow& drive, const LearntValve& valve, int side) {
  const double edge = duty_at(drive.answer.towards(side), valve.side(side > 0).edge);
  return side * kWithin * std::max(0.0, edge);
}

}  // namespace graben
