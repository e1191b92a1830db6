#include "app/identify/joint_cost.hpp"

#include <ceres/jet.h>

#include <array>

namespace graben::identify {
namespace {

constexpr double kRobust = 0.3;

/// Its square is the soft L1 loss of `error`: quadratic when small, linear when large.
template <class T>
T pressed(const T& error) {
  using std::sqrt;
  const T part = error / kRobust;
  return error * sqrt(2.0 / (1.0 + sqrt(1.0 + part * part)));
}

}  // namespace

JointCost::JointCost(const JointRun& of, std::size_t joint, const Knots& knots, double sign,
                     double scale_radps)
    : of_(of), joint_(joint), knots_(knots), sign_(sign), scale_radps_(scale_radps) {
  set_num_residuals(static_cast<int>(of.run->size()));
  mutable_parameter_block_sizes()->push_back(static_cast<int>(kParameters));
}

bool JointCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const std::vector<double>& measured = of_.run->velocity_radps[joint_];
  if (jacobians == nullptr || jacobians[0] == nullptr) {
    const std::vector<double> velocity = velocities<double>(of_, joint_, parameters[0], knots_);
    for (std::size_t row = 0; row < velocity.size(); ++row) {
      residuals[row] = pressed((sign_ * velocity[row] - measured[row]) / scale_radps_);
    }
    return true;
  }
  using Jet = ceres::Jet<double, static_cast<int>(kParameters)>;
  std::vector<Jet> p(kParameters);
  for (std::size_t at = 0; at < kParameters; ++at) {
    p[at] = Jet(parameters[0][at], static_cast<int>(at));
  }
  const std::vector<Jet> velocity = velocities<Jet>(of_, joint_, p.data(), knots_);
  for (std::size_t row = 0; row < velocity.size(); ++row) {
    const Jet residual = pressed(Jet((sign_ * velocity[row] - measured[row]) / scale_radps_));
    residuals[row] = residual.a;
    for (std::size_t at = 0; at < kParameters; ++at) {
      jacobians[0][row * kParameters + at] = residual.v[static_cast<int>(at)];
    }
  }
  return true;
}

}  // namespace graben::identify
