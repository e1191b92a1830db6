// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/oil_law.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/excavator/estimation/oil/oil_cycle.hpp"
#include "firmware/excavator/estimation/oil/tuning.hpp"

namespace graben {
namespace {

void advance(double newest, double asked_mps, TwoLags& lags) {
  lags.first_mps += newest * (asked_mps - lags.first_mps);
  lags.second_mps += newest * (lags.first_mps - lags.second_mps);
}

Eigen::Vector2d seconds(const std::array<TwoLags, 2>& lags) {
  return {lags[0].second_mps, lags[1].second_mps};
}

void begin(const OilSeen& seen, OilState& state) {
  state = {};
  state.begun = true;
  state.travel_m = seen.stroke_m;
  state.force_n = seen.force_known ? seen.force_n : Eigen::Vector2d(Eigen::Vector2d::Zero());
  state.load_n = -state.force_n;
}

/// Mean flow of the time that ends now.
Eigen::Vector2d next_flow_mps(double lag_s, const OilSeen& seen, OilState& state) {
  const double newest = newest_of_lag(lag_s);
  Eigen::Vector2d twice_mps = Eigen::Vector2d::Zero();
  for (int n = 0; n < seen.cycles; ++n) {
    twice_mps += seconds(state.asked);
    for (unsigned axis = 0; axis < 2; ++axis) {
      advance(newest, seen.asked_mps[axis], state.asked[axis]);
      advance(newest, seen.expected_mps[axis], state.expected[axis]);
    }
    twice_mps += seconds(state.asked);
  }
  return 0.5 / seen.cycles * twice_mps;
}

/// Speed that the flow is less by the force it meets; implicit, so that no yield rings.
Eigen::Vector2d given_way_mps(const OilModes& modes, const OilSeen& seen, const OilState& state) {
  const Eigen::Vector2d in_cycle =
      Eigen::Vector2d::Ones() +
      kCyclePeriod_s * seen.cycles * modes.stiffness_npm.cwiseProduct(seen.yield_mpsn);
  return seen.yield_mpsn.cwiseProduct(state.force_n - seen.opened_for_n).cwiseQuotient(in_cycle);
}

/// Strokes come in steps of 0.1 mm. Taken for motion, a step would shake the load and with it the
/// duties: what is within it counts the less, the smaller it is.
double counted_m(double missed_m, double step_m) {
  const double size_m = std::abs(missed_m);
  return step_m > 0.0 ? missed_m * size_m / (size_m + step_m) : missed_m;
}

}  // namespace

OilSeen oil_seen(DriveRows drives, Span<const ValidDrive> seen) {
  OilSeen oil;
  oil.force_known = true;
  oil.stroke_step_m = kOilStrokeStep_m;
  for (int axis = 0; axis < 2; ++axis) {
    oil.stroke_m[axis] = seen[axis].stroke_m;
    oil.force_n[axis] = drives[axis].extend_area_m2 * seen[axis].cap_pressure_pa -
                        drives[axis].retract_area_m2 * seen[axis].rod_pressure_pa;
    oil.force_known = oil.force_known && seen[axis].load_known;
  }
  return oil;
}

void next_oil(const OilGains& gains, const OilModes& modes, const OilSeen& seen, bool active,
              bool leads, OilState& state) {
  if (!active || !state.begun) {
    begin(seen, state);
    return;
  }
  const double time_s = kCyclePeriod_s * seen.cycles;
  const double step = kOilHandOver_ps * time_s;
  state.weight = std::clamp(state.weight + (leads ? step : -step), 0.0, 1.0);
  const Eigen::Vector2d asked_mps =
      next_flow_mps(gains.lag_s(), seen, state) - given_way_mps(modes, seen, state);
  const Eigen::Vector2d kept_mps = state.flow_error_mps;
  const Eigen::Vector2d flow = modes.inverse * seen.stands.select(-kept_mps, asked_mps);
  const Eigen::Vector2d yield_mpn = modes.stiffness_npm.cwiseInverse();
  const auto compression = [&](const Eigen::Vector2d& force_n) -> Eigen::Vector2d {
    return modes.inverse * yield_mpn.cwiseProduct(force_n);
  };
  Eigen::Vector2d travel = modes.inverse * state.travel_m;
  Eigen::Vector2d speed = modes.inverse * state.speed_mps;
  Eigen::Vector2d oil = compression(state.force_n);
  Eigen::Vector2d load = compression(state.load_n);
  Eigen::Vector2d error = modes.inverse * state.flow_error_mps;
  const Eigen::Vector2d seen_oil = compression(seen.force_n);
  for (int j = 0; j < 2; ++j) {
    const ModeTurn turn = mode_turn(modes.omega_radps[j], time_s);
    const double total = flow[j] + error[j];
    const double balance = oil[j] + load[j];
    const double beyond = speed[j] - total;
    travel[j] +=
        time_s * total + turn.travel_of_speed_s * beyond + turn.travel_of_balance * balance;
    speed[j] = total + turn.cosine * beyond + turn.speed_of_balance_ps * balance;
    oil[j] = turn.cosine * balance - turn.travel_of_speed_s * beyond - load[j];
  }
  const Eigen::Vector2d missed_m = seen.stroke_m - modes.shape * travel;
  const Eigen::Vector2d missed_travel =
      modes.inverse * Eigen::Vector2d(counted_m(missed_m[0], seen.stroke_step_m),
                                      counted_m(missed_m[1], seen.stroke_step_m));
  const auto see = [&](int j) {
    const Eigen::Vector2d missed(missed_travel[j], seen.force_known ? seen_oil[j] - oil[j] : 0.0);
    const Eigen::Matrix<double, ModeGains::kStates, 1> change =
        gains.at(modes.omega_radps[j]).observer * missed;
    travel[j] += change[0];
    speed[j] += change[1];
    oil[j] += change[2];
    load[j] += change[3];
    error[j] += change[4];
  };
  see(0);
  see(1);
  state.travel_m = modes.shape * travel;
  state.speed_mps = modes.shape * speed;
  state.force_n = modes.stiffness_npm.cwiseProduct(modes.shape * oil);
  state.load_n = modes.stiffness_npm.cwiseProduct(modes.shape * load);
  const Eigen::Vector2d error_mps =
      (modes.shape * error).cwiseMax(-kOilFlowErrorMost_mps).cwiseMin(kOilFlowErrorMost_mps);
  state.flow_error_mps = seen.stands.select(kept_mps, error_mps);
}

Eigen::Vector2d oil_correction_mps(const OilGains& gains, const OilModes& modes,
                                   const OilState& state, const Eigen::Vector2d& off_m) {
  Eigen::Vector2d first_mps;
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    first_mps[axis] = state.asked[k].first_mps - state.expected[k].first_mps;
  }
  const Eigen::Vector2d due_mps = seconds(state.expected);
  const Eigen::Vector2d travel = modes.inverse * off_m;
  const Eigen::Vector2d speed = modes.inverse * (state.speed_mps - due_mps);
  const Eigen::Vector2d balance =
      modes.inverse * (state.force_n + state.load_n).cwiseQuotient(modes.stiffness_npm);
  const Eigen::Vector2d first = modes.inverse * (first_mps + state.flow_error_mps);
  const Eigen::Vector2d second =
      modes.inverse * (seconds(state.asked) - due_mps + state.flow_error_mps);
  Eigen::Vector2d asked;
  for (int j = 0; j < 2; ++j) {
    Eigen::Matrix<double, ModeGains::kStates, 1> mode;
    mode << travel[j], speed[j], balance[j], first[j], second[j];
    asked[j] = -gains.at(modes.omega_radps[j]).feedback.dot(mode);
  }
  return modes.shape * asked - state.flow_error_mps;
}

}  // namespace graben
