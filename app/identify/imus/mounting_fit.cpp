// SPDX-License-Identifier: Apache-2.0
#include "app/identify/imus/mounting_fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/identify/imus/touch_words.hpp"
#include "app/identify/imus/touched_tip.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::identify {
namespace {

using Turns = Eigen::Vector3d;  ///< Added to each mount's turn, rad.

constexpr std::size_t kLeastTouches = 4;
/// What is known beforehand: no IMU is turned so far by accident.
constexpr double kPrior_rad = 0.2;
/// An IMU that is known to sit right does so to this.
constexpr double kKept_rad = 1e-3;
/// Twice: with the second the weights are those of the turns that were found.
constexpr int kPasses = 2;

/// The edge off its peg, in units of what touch and angles are known to.
struct TouchCost {
  const TouchedTip& tip;
  const Rest& rest;
  Eigen::Matrix2d weight;

  bool operator()(const double* turns, const double* peg_m, double* off) const {
    const Eigen::Vector2d tip_m = tip.at(rest, Turns(turns[0], turns[1], turns[2]));
    Eigen::Map<Eigen::Vector2d> to(off);
    to = weight * (tip_m - Eigen::Vector2d(peg_m[0], peg_m[1]));
    return to.allFinite();
  }
};

/// A mount is as it was told, but for its deviation.
struct PriorCost {
  Turns weight;

  template <class T>
  bool operator()(const T* turns, T* off) const {
    for (int axis = 0; axis < 3; ++axis) {
      off[axis] = weight[axis] * turns[axis];
    }
    return true;
  }
};

/// A height, or the difference of two.
struct HeightCost {
  double wanted_m;
  double deviation_m;

  template <class T>
  bool operator()(const T* peg_m, T* off) const {
    off[0] = (peg_m[1] - T(wanted_m)) / T(deviation_m);
    return true;
  }
  template <class T>
  bool operator()(const T* first_m, const T* second_m, T* off) const {
    off[0] = (second_m[1] - first_m[1] - T(wanted_m)) / T(deviation_m);
    return true;
  }
};

/// Square root of the inverse of the touch's covariance.
Eigen::Matrix2d weight_of(const TouchedTip& tip, const Rest& rest, const Turns& turns,
                          double touch_m) {
  const Eigen::Matrix<double, 2, 3> slope = tip.slope(rest, turns);
  const Turns deviation(rest.deviation_rad.data());
  const Eigen::Matrix2d covariance = touch_m * touch_m * Eigen::Matrix2d::Identity() +
                                     slope * deviation.cwiseAbs2().asDiagonal() * slope.transpose();
  const Eigen::Matrix2d inverse = covariance.inverse();
  return inverse.llt().matrixU();
}

class Fit {
 public:
  Fit(const ExcavatorProfile& profile, const MountingAsk& ask) : tip_(profile), ask_(ask) {
    for (const Peg& peg : ask.pegs) {
      peg_m_.push_back(middle_of(peg, Turns::Zero()));
    }
  }

  /// Without the touch of this number, if there is one.
  void solve(std::size_t without = std::numeric_limits<std::size_t>::max());
  [[nodiscard]] const Turns& turns() const { return turns_; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& pegs_m() const { return peg_m_; }
  /// Of the turns, with the scatter of the touches as it is, if that is more than was told.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Sum of the squares of what the touches are off, in their units.
  [[nodiscard]] double cost() const { return cost_; }
  [[nodiscard]] Eigen::Vector2d middle_of(const Peg& peg, const Turns& turns) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Rest& rest : peg.touches) {
      sum += tip_.at(rest, turns);
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, peg.touches.size()));
  }
  [[nodiscard]] const TouchedTip& tip() const { return tip_; }

 private:
  void add_touches(std::size_t without, ceres::Problem& problem);
  void add_references(ceres::Problem& problem);
  void find_covariance(ceres::Problem& problem, std::size_t used);

  TouchedTip tip_;
  const MountingAsk& ask_;
  Turns turns_ = Turns::Zero();
  std::vector<Eigen::Vector2d> peg_m_;
  std::vector<ceres::ResidualBlockId> touches_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  double cost_ = 0.0;
};

void Fit::add_touches(std::size_t without, ceres::Problem& problem) {
  using Cost = ceres::NumericDiffCostFunction<TouchCost, ceres::CENTRAL, 2, 3, 2>;
  touches_.clear();
  std::size_t at = 0;
  for (std::size_t p = 0; p < ask_.pegs.size(); ++p) {
    for (const Rest& rest : ask_.pegs[p].touches) {
      if (at++ == without) {
        continue;
      }
      touches_.push_back(problem.AddResidualBlock(
          new Cost(new TouchCost{tip_, rest, weight_of(tip_, rest, turns_, ask_.touch_m)}), nullptr,
          turns_.data(), peg_m_[p].data()));
    }
  }
}

void Fit::add_references(ceres::Problem& problem) {
  Turns known(kPrior_rad, kPrior_rad, kPrior_rad);
  if (ask_.kept) {
    known[*ask_.kept] = kKept_rad;
  }
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PriorCost, 3, 3>(new PriorCost{known.cwiseInverse()}),
      nullptr, turns_.data());
  for (std::size_t p = 0; p < ask_.pegs.size(); ++p) {
    if (ask_.pegs[p].height_m) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeightCost, 1, 2>(
                                   new HeightCost{*ask_.pegs[p].height_m, ask_.level_m}),
                               nullptr, peg_m_[p].data());
    }
  }
  if (ask_.rise_m) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<HeightCost, 1, 2, 2>(
                                 new HeightCost{*ask_.rise_m, ask_.level_m}),
                             nullptr, peg_m_[0].data(), peg_m_[1].data());
  }
}

void Fit::find_covariance(ceres::Problem& problem, std::size_t used) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(options);
  std::vector<const double*> blocks = {turns_.data()};
  if (!covariance.Compute(blocks, &problem)) {
    throw std::runtime_error("the touches say nothing of how the IMUs are turned");
  }
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> found;
  covariance.GetCovarianceBlock(turns_.data(), turns_.data(), found.data());
  const double free = 2.0 * static_cast<double>(used) - 2.0 * static_cast<double>(peg_m_.size());
  covariance_ = std::max(1.0, cost_ / std::max(1.0, free)) * found;
}

void Fit::solve(std::size_t without) {
  for (int pass = 0; pass < kPasses; ++pass) {
    ceres::Problem problem;
    add_touches(without, problem);
    add_references(problem);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    ceres::Problem::EvaluateOptions touches;
    touches.residual_blocks = touches_;
    problem.Evaluate(touches, &cost_, nullptr, nullptr, nullptr);
    cost_ *= 2.0;
    if (pass + 1 == kPasses) {
      find_covariance(problem, touches_.size());
    }
  }
}

MountingFit result_of(const ExcavatorProfile& profile, const MountingAsk& ask, const Fit& fit) {
  MountingFit result;
  result.peg_m = fit.pegs_m();
  const ExcavatorGeometry& links = profile.geometry;
  const Turns length_m(links.boom_length_m, links.arm_length_m, links.bucket_length_m);
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    result.turn_rad[axis] = profile.imu.mount[axis].turn_rad + fit.turns()[at];
    result.deviation_rad[axis] = std::sqrt(std::max(0.0, fit.covariance()(at, at)));
    result.end_m[axis] = length_m[at] * result.deviation_rad[axis];
  }
  for (std::size_t p = 0; p < ask.pegs.size(); ++p) {
    const Eigen::Vector2d before_m = fit.middle_of(ask.pegs[p], Turns::Zero());
    for (const Rest& rest : ask.pegs[p].touches) {
      result.touches.push_back({p, rest, (fit.tip().at(rest, Turns::Zero()) - before_m).norm(),
                                (fit.tip().at(rest, fit.turns()) - fit.pegs_m()[p]).norm()});
    }
  }
  return result;
}

/// One touch whose absence lets all the others be on their pegs.
void assert_no_stray(const ExcavatorProfile& profile, const MountingAsk& ask,
                     const MountingFit& result) {
  if (result.most_m() <= kMostOff_m) {
    return;
  }
  for (std::size_t at = 0; at < result.touches.size(); ++at) {
    Fit others(profile, ask);
    others.solve(at);
    double most_m = 0.0;
    double off_m = 0.0;
    for (std::size_t n = 0; n < result.touches.size(); ++n) {
      const TouchResult& touch = result.touches[n];
      const double each_m =
          (others.tip().at(touch.rest, others.turns()) - others.pegs_m()[touch.peg]).norm();
      (n == at ? off_m : most_m) = n == at ? each_m : std::max(most_m, each_m);
    }
    if (most_m <= kMostOff_m) {
      refuse_stray(result.touches[at], off_m);
    }
  }
  refuse_scattered(result);
}

void assert_found(const ExcavatorProfile& profile, const MountingAsk& ask, const Fit& fit,
                  const MountingFit& result) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shape(fit.covariance());
  if (*std::max_element(result.end_m.begin(), result.end_m.end()) > kMostEnd_m) {
    refuse_alike(profile, ask, result, shape.eigenvectors().col(2));
  }
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const double by_rad = fit.turns()[static_cast<Eigen::Index>(axis)];
    if (std::abs(by_rad) > kMostMounting_rad) {
      refuse_far(axis, by_rad);
    }
  }
}

}  // namespace

double MountingFit::rms_m() const {
  double square = 0.0;
  for (const TouchResult& touch : touches) {
    square += touch.after_m * touch.after_m;
  }
  return std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, touches.size())));
}

double MountingFit::most_m() const {
  double most_m = 0.0;
  for (const TouchResult& touch : touches) {
    most_m = std::max(most_m, touch.after_m);
  }
  return most_m;
}

MountingFit fit_mounting(const ExcavatorProfile& profile, const MountingAsk& ask) {
  assert_askable(ask, kLeastTouches);
  Fit fit(profile, ask);
  fit.solve();
  const MountingFit result = result_of(profile, ask, fit);
  assert_no_stray(profile, ask, result);
  assert_found(profile, ask, fit, result);
  return result;
}

}  // namespace graben::identify
