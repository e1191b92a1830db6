// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/oil_gains.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/excavator/estimation/oil/oil_cycle.hpp"
#include "firmware/excavator/estimation/oil/tuning.hpp"

namespace graben {
namespace {

/// Doublings of the steps that the Riccati equation is taken. [-; size: 1024 steps, 10 s]
constexpr int kDoublings = 10;

using Vector5 = Eigen::Matrix<double, ModeGains::kStates, 1>;
using Matrix5 = Eigen::Matrix<double, ModeGains::kStates, ModeGains::kStates>;

/// Gauss-Jordan with the largest pivot of a column; Eigen's own for this size can use the heap.
Matrix5 inverted(Matrix5 m) {
  Matrix5 inverse = Matrix5::Identity();
  for (int column = 0; column < ModeGains::kStates; ++column) {
    int pivot = column;
    for (int row = column + 1; row < ModeGains::kStates; ++row) {
      pivot = std::abs(m(row, column)) > std::abs(m(pivot, column)) ? row : pivot;
    }
    m.row(column).swap(m.row(pivot));
    inverse.row(column).swap(inverse.row(pivot));
    const double by = m(column, column);
    inverse.row(column) /= by;
    m.row(column) /= by;
    for (int row = 0; row < ModeGains::kStates; ++row) {
      const double share = row == column ? 0.0 : m(row, column);
      inverse.row(row) -= share * inverse.row(column);
      m.row(row) -= share * m.row(column);
    }
  }
  return inverse;
}

/// X = A' X A - A' X B (R + B' X B)^-1 B' X A + Q, with G = B R^-1 B', by doubling.
Matrix5 riccati(Matrix5 a, Matrix5 g, Matrix5 q) {
  for (int n = 0; n < kDoublings; ++n) {
    const Matrix5 turned = inverted(Matrix5::Identity() + g * q);
    const Matrix5 ahead = a * turned;
    const Matrix5 next_q = q + a.transpose() * q * turned * a;
    const Matrix5 next_g = g + ahead * g * a.transpose();
    a = ahead * a;
    q = 0.5 * (next_q + next_q.transpose());
    g = 0.5 * (next_g + next_g.transpose());
  }
  return q;
}

/// Of travel, speed, balance, first and second lag.
Vector5 feedback_of(const OilDesign& design, double omega_radps) {
  const ModeTurn turn = mode_turn(omega_radps, kCyclePeriod_s);
  const double newest = newest_of_lag(design.lag_s);
  Vector5 flow = Vector5::Zero();  // Mean of the second lag in a cycle.
  flow[3] = 0.5 * newest * (1.0 - newest);
  flow[4] = 0.5 * (2.0 - newest);
  const double flow_of_command = 0.5 * newest * newest;
  Matrix5 step = Matrix5::Zero();
  step.row(0) << 1.0, turn.travel_of_speed_s, turn.travel_of_balance, 0.0, 0.0;
  step.row(1) << 0.0, turn.cosine, turn.speed_of_balance_ps, 0.0, 0.0;
  step.row(2) << 0.0, -turn.travel_of_speed_s, turn.cosine, 0.0, 0.0;
  Vector5 of_flow = Vector5::Zero();
  of_flow.head<3>() << kCyclePeriod_s - turn.travel_of_speed_s, 1.0 - turn.cosine,
      turn.travel_of_speed_s;
  step += of_flow * flow.transpose();
  step(3, 3) = 1.0 - newest;
  step(4, 3) = newest * (1.0 - newest);
  step(4, 4) = 1.0 - newest;
  Vector5 of_command = flow_of_command * of_flow;
  of_command[3] = newest;
  of_command[4] = newest * newest;

  Matrix5 weight = Matrix5::Zero();
  weight(0, 0) = 1.0;
  weight(1, 1) = design.speed_s * design.speed_s;
  weight(2, 2) = design.balance * design.balance;
  const double command_weight = 1.0 / (design.travel_ps * design.travel_ps);
  const Matrix5 cost = riccati(step, of_command * of_command.transpose() / command_weight, weight);
  const Vector5 priced = cost * of_command;
  return step.transpose() * priced / (command_weight + of_command.dot(priced));
}

Eigen::Matrix2d inverse_of(const Eigen::Matrix2d& m) {
  Eigen::Matrix2d inverse;
  inverse << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return inverse / (m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0));
}

/// Of travel, speed, compression, load, flow error.
Eigen::Matrix<double, ModeGains::kStates, 2> observer_of(const OilDesign& design,
                                                         double omega_radps) {
  const ModeTurn turn = mode_turn(omega_radps, kCyclePeriod_s);
  const double late_s = turn.travel_of_speed_s;
  Matrix5 step = Matrix5::Identity();
  step.row(0) << 1.0, late_s, turn.travel_of_balance, turn.travel_of_balance,
      kCyclePeriod_s - late_s;
  step.row(1) << 0.0, turn.cosine, turn.speed_of_balance_ps, turn.speed_of_balance_ps,
      1.0 - turn.cosine;
  step.row(2) << 0.0, -late_s, turn.cosine, turn.cosine - 1.0, late_s;
  Vector5 drift;
  drift << kOilTravelDrift_m2, kOilSpeedDrift_m2ps2, kOilSpeedDrift_m2ps2,
      kCyclePeriod_s * design.load_m2ps, kCyclePeriod_s * design.flow_m2ps3;
  Eigen::Matrix<double, 2, ModeGains::kStates> seen;
  seen << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  const Eigen::Matrix2d noise = Eigen::Vector2d(design.travel_noise_m * design.travel_noise_m,
                                                design.pressure_noise_m * design.pressure_noise_m)
                                    .asDiagonal();
  // Of what is expected before a measurement.
  const Matrix5 spread =
      riccati(step.transpose(), seen.transpose() * inverse_of(noise) * seen, drift.asDiagonal());
  return spread * seen.transpose() * inverse_of(seen * spread * seen.transpose() + noise);
}

}  // namespace

ModeGains mode_gains(const OilDesign& design, double omega_radps) {
  return {feedback_of(design, omega_radps), observer_of(design, omega_radps)};
}

OilGains::OilGains(const OilDesign& design) : lag_s_(design.lag_s) {
  for (int n = 0; n < kKnots; ++n) {
    const double root = kOilLeastRoot + (kOilMostRoot - kOilLeastRoot) * n / (kKnots - 1);
    knot_[static_cast<unsigned>(n)] = mode_gains(design, root * root);
  }
}

ModeGains OilGains::at(double omega_radps) const {
  const double root = std::clamp(std::sqrt(omega_radps), kOilLeastRoot, kOilMostRoot);
  const double place = (kKnots - 1) * (root - kOilLeastRoot) / (kOilMostRoot - kOilLeastRoot);
  const int low = std::clamp(static_cast<int>(place), 0, kKnots - 2);
  const double share = place - low;
  const ModeGains& below = knot_[static_cast<unsigned>(low)];
  const ModeGains& above = knot_[static_cast<unsigned>(low + 1)];
  return {(1.0 - share) * below.feedback + share * above.feedback,
          (1.0 - share) * below.observer + share * above.observer};
}

}  // namespace graben
