// SPDX-License-Identifier: Apache-2.0
#include "tests/margins/shipped_law.hpp"

#include <array>
#include <stdexcept>

#include "firmware/drives/lead/spool_lead.hpp"

namespace graben::margins {
namespace {

/// A speed of 1 m/s is this much of a duty, about that one: a spool that is led home stops there,
/// and one that is led far meets its end.
constexpr double kDutyOfSpeed_spm = 1.0;
constexpr double kDutyAtRest = 0.5;
/// Both chambers well filled.
constexpr LoadState kPressed = {8e6, 5e6};
/// What a state is moved by, and how far from linear its column may be.
constexpr double kMoved = 1e-5;
constexpr double kCurved = 1e-6;

constexpr int kTravel = 0;
constexpr int kSpeed = 2;
constexpr int kForce = 4;
constexpr int kLoad = 6;
constexpr int kError = 8;
constexpr int kFirst = 10;
constexpr int kSecond = 12;
constexpr int kAsked = 14;
constexpr int kSpool = 16;
constexpr int kSpoolSpeed = 18;
constexpr int kSeen = 4;

using State = LawInTime::State;

OilState oil_of(const State& state) {
  OilState oil;
  oil.begun = true;
  oil.weight = 1.0;
  oil.travel_m = state.segment<2>(kTravel);
  oil.speed_mps = state.segment<2>(kSpeed);
  oil.force_n = kForceUnit_n * state.segment<2>(kForce);
  oil.load_n = kForceUnit_n * state.segment<2>(kLoad);
  oil.flow_error_mps = state.segment<2>(kError);
  for (unsigned axis = 0; axis < 2; ++axis) {
    oil.asked[axis] = {state[kFirst + static_cast<int>(axis)],
                       state[kSecond + static_cast<int>(axis)]};
  }
  return oil;
}

void keep(const OilState& oil, State& state) {
  state.segment<2>(kTravel) = oil.travel_m;
  state.segment<2>(kSpeed) = oil.speed_mps;
  state.segment<2>(kForce) = oil.force_n / kForceUnit_n;
  state.segment<2>(kLoad) = oil.load_n / kForceUnit_n;
  state.segment<2>(kError) = oil.flow_error_mps;
  for (unsigned axis = 0; axis < 2; ++axis) {
    state[kFirst + static_cast<int>(axis)] = oil.asked[axis].first_mps;
    state[kSecond + static_cast<int>(axis)] = oil.asked[axis].second_mps;
  }
}

/// State after it, then duties.
Eigen::VectorXd cycle(const LawInTime& law, const State& state, const Eigen::Vector4d& seen) {
  State next = state;
  Eigen::VectorXd all(LawInTime::kStates + 2);
  all.tail<2>() = law.step(seen, next);
  all.head<LawInTime::kStates>() = next;
  return all;
}

/// What a cycle makes of one place that is moved; 0 stays 0.
Eigen::VectorXd column(const LawInTime& law, int place) {
  const auto of = [&](double by) {
    Eigen::Matrix<double, LawInTime::kStates + kSeen, 1> all;
    all.setZero();
    all[place] = by;
    return Eigen::VectorXd(cycle(law, all.head<LawInTime::kStates>(), all.tail<kSeen>()) / by);
  };
  const Eigen::VectorXd there = of(kMoved);
  if ((there - of(-2.0 * kMoved)).norm() > kCurved) {
    throw std::runtime_error("the law is not linear there");
  }
  return there;
}

}  // namespace

LawInTime::LawInTime(const ExcavatorProfile& profile, const OilGains& gains,
                     const Eigen::Vector3d& strokes_m)
    : gains_(gains), spool_time_constant_s_(profile.oil.spool_time_constant_s) {
  const KinematicState now = ExcavatorKinematics(profile.geometry).state(strokes_m);
  if (now.status != ReachStatus::kOk) {
    throw std::runtime_error("a pose is out of reach");
  }
  const std::array<LoadState, 2> load = {kPressed, kPressed};
  modes_ = oil_modes(profile.oil, profile.geometry, now, {load.data(), 2}, 0.0, 1.0);
}

Eigen::Vector2d LawInTime::step(const Eigen::Vector4d& seen, State& state) const {
  OilState oil = oil_of(state);
  OilSeen measured;
  measured.asked_mps = state.segment<2>(kAsked);
  measured.stroke_m = seen.head<2>();
  measured.force_n = kForceUnit_n * seen.tail<2>();
  measured.force_known = true;
  next_oil(gains_, modes_, measured, true, true, oil);
  const Eigen::Vector2d asked_mps = oil_correction_mps(gains_, modes_, oil, oil.travel_m);
  keep(oil, state);
  state.segment<2>(kAsked) = asked_mps;
  Eigen::Vector2d duty_mps;
  for (int axis = 0; axis < 2; ++axis) {
    LedSpool led;
    led.model = {kDutyAtRest + state[kSpool + axis], state[kSpoolSpeed + axis]};
    const double wanted = kDutyAtRest + kDutyOfSpeed_spm * asked_mps[axis];
    const double duty = trusted_lead(spool_time_constant_s_, wanted, led);
    const SpoolModel spool = spool_after(spool_time_constant_s_, duty, led.model);
    duty_mps[axis] = (duty - kDutyAtRest) / kDutyOfSpeed_spm;
    state[kSpool + axis] = spool.travel_ratio - kDutyAtRest;
    state[kSpoolSpeed + axis] = spool.speed_ps;
  }
  return duty_mps;
}

Discrete as_matrices(const LawInTime& law) {
  constexpr int kStates = LawInTime::kStates;
  Eigen::MatrixXd all(kStates + 2, kStates + kSeen);
  for (int place = 0; place < kStates + kSeen; ++place) {
    all.col(place) = column(law, place);
  }
  Discrete system;
  system.a = all.topLeftCorner(kStates, kStates);
  system.b = all.topRightCorner(kStates, kSeen);
  system.c = all.bottomLeftCorner(2, kStates);
  system.d = all.bottomRightCorner(2, kSeen);
  return system;
}

}  // namespace graben::margins
