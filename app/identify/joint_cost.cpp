// SPDX-License-Identifier: Apache-2.0
#include "app/identify/joint_cost.hpp"

#include <ceres/jet.h>

#include "app/identify/joint_motion.hpp"

namespace graben::identify {
namespace {

constexpr double kAhead_s = 1.0;
constexpr std::size_t kEvery = 4;  // Neighbouring seconds say the same.
constexpr double kTurn_s = 0.3;    // That a turn is worth as much as the velocity.

/// Its square is the soft L1 loss of `error`: quadratic when small, linear when large.
template <class T>
T pressed(const T& error) {
  using std::sqrt;
  return error * sqrt(2.0 / (1.0 + sqrt(1.0 + error * error)));
}

}  // namespace

std::vector<Ahead> rows_ahead(const MotionRun& run, double ahead_s, std::size_t every) {
  constexpr double kSame_s = 1e-6;
  std::vector<Ahead> all;
  std::size_t to = 0;
  for (std::size_t from = 0; from < run.size(); from += every) {
    while (to < run.size() && run.time_s[to] < run.time_s[from] + ahead_s - kSame_s) {
      ++to;
    }
    if (to == run.size()) {
      break;
    }
    all.push_back({from, to});
  }
  return all;
}

JointCost::JointCost(const JointRun& of, std::size_t joint, const Grid& grid, double sign,
                     double scale_radps)
    : of_(of),
      joint_(joint),
      grid_(grid),
      sign_(sign),
      scale_radps_(scale_radps),
      aheads_(rows_ahead(*of.run, kAhead_s, kEvery)) {
  set_num_residuals(static_cast<int>(of.run->size() + aheads_.size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(kParameters));
}

template <class T, class Put>
void JointCost::residuals(const T* p, const Put& put) const {
  const std::vector<double>& velocity = of_.run->velocity_radps[joint_];
  const std::vector<double>& angle = of_.run->angle_rad[joint_];
  const std::vector<JointState<T>> states = motion(of_, joint_, p, grid_);
  for (std::size_t row = 0; row < states.size(); ++row) {
    const T seen = as_measured(*of_.run, joint_, row, states);
    put(row, pressed(T((sign_ * seen - velocity[row]) / scale_radps_)));
  }
  for (std::size_t at = 0; at < aheads_.size(); ++at) {
    const auto [from, to] = aheads_[at];
    const T turned = sign_ * (states[to].turned_rad - states[from].turned_rad);
    const double went = angle[to] - angle[from];
    put(states.size() + at, pressed(T((turned - went) / (kTurn_s * scale_radps_))));
  }
}

bool JointCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  if (jacobians == nullptr || jacobians[0] == nullptr) {
    this->residuals(parameters[0],
                    [&](std::size_t at, double residual) { residuals[at] = residual; });
    return true;
  }
  using Jet = ceres::Jet<double, static_cast<int>(kParameters)>;
  std::vector<Jet> p(kParameters);
  for (std::size_t at = 0; at < kParameters; ++at) {
    p[at] = Jet(parameters[0][at], static_cast<int>(at));
  }
  this->residuals(p.data(), [&](std::size_t at, const Jet& residual) {
    residuals[at] = residual.a;
    for (std::size_t of = 0; of < kParameters; ++of) {
      jacobians[0][at * kParameters + of] = residual.v[static_cast<int>(of)];
    }
  });
  return true;
}

}  // namespace graben::identify
