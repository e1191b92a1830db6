// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/spool_parking.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/spool_opening.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

int side_of(double velocity_mps) { return velocity_mps > 0.0 ? 1 : (velocity_mps < 0.0 ? -1 : 0); }

}  // namespace

bool park(double wanted_mps, double corrected_mps, double pace, double period_s,
          ParkingState& state) {
  state.reversals_ps *= kParkingForget_s / (kParkingForget_s + std::max(0.0, period_s));
  const int side = side_of(corrected_mps);
  const double most_mps =
      std::sqrt(pace) * std::min(kParkingPerReversal_m * state.reversals_ps, kParkingMost_mps);
  state.parked = state.side != 0 && side != state.side &&
                 side * wanted_mps <= pace * kParkingPathReverses_mps &&
                 std::abs(corrected_mps) < most_mps;
  if (!state.parked && side != state.side) {
    state.reversals_ps += 1.0 / kParkingForget_s;
    state.side = side;
  }
  return state.parked;
}

double parked_duty(const DriveRow& drive, const LearntValve& valve, int side) {
  const double edge = duty_at(drive.answer.towards(side), valve.side(side > 0).edge);
  return side * kParkingWithin * std::max(0.0, edge);
}

}  // namespace graben
