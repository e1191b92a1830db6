// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The least-squares problem of valve_fit.hpp: its values, its residuals, and what it leaves open.

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/identify/machine/valve_costs.hpp"
#include "app/identify/machine/valve_fit.hpp"

namespace graben::identify {

inline constexpr std::size_t kSides = 2 * kDriveCount;
// Among all values: sides one after the other, then zeros, pumps, regulators.
inline constexpr std::size_t kZerosAt = kSides * kSideSize;
inline constexpr std::size_t kPumpsAt = kZerosAt + kDriveCount * kZeroSize;
inline constexpr std::size_t kRegulatorAt = kPumpsAt + kPumpCount;
inline constexpr std::size_t kAll = kRegulatorAt + kRegulatorSize;
using Square = Eigen::Matrix<double, kAll, kAll>;
using Row = Eigen::Matrix<double, kAll, 1>;

/// The model is not the machine (hoses, a soft edge of another shape): what is left open is so much
/// more than the points say, and no travel is known better than that. By hidden machines.
inline constexpr double kModel = 1.5;
/// A value is known where what is left open is less than this share of what was open before.
inline constexpr double kLearnt = 0.5;

inline std::size_t side_of(int axis, bool extends) {
  return 2 * static_cast<std::size_t>(axis) + (extends ? 0 : 1);
}

struct Blocks {
  std::array<std::array<double, kSideSize>, kSides> side{};
  std::array<std::array<double, kZeroSize>, kDriveCount> zero{};
  std::array<std::array<double, 1>, kPumpCount> pump{};
  std::array<double, kRegulatorSize> regulator{};  ///< Only with negative flow.
};

class ValveProblem {
 public:
  ValveProblem(const std::vector<PreparedPoint>& points, const ValvePriors& priors,
               const MachineEstimate& machine, const DriveModel& model);

  void solve();
  /// What was found, into `machine`.
  void tell(const DriveModel& model, MachineEstimate& machine) const;

 private:
  static ceres::NumericDiffOptions steps() {
    ceres::NumericDiffOptions options;
    options.relative_step_size = 1e-5;
    return options;
  }
  void bound(double* block, std::size_t at, double least, double most) {
    if (problem_.HasParameterBlock(block)) {
      problem_.SetParameterLowerBound(block, static_cast<int>(at), least);
      problem_.SetParameterUpperBound(block, static_cast<int>(at), most);
    }
  }
  template <std::size_t size>
  void prior(std::array<double, size>& block, std::size_t at, double mean, double deviation) {
    constexpr int kSize = static_cast<int>(size);
    problem_.AddResidualBlock(
        new ceres::NumericDiffCostFunction<PriorCost, ceres::CENTRAL, 1, kSize>(
            new PriorCost{at, mean, deviation}),
        nullptr, block.data());
  }
  void start(const MachineEstimate& machine);
  void start_at_edges();
  void add_priors(const MachineEstimate& machine);
  void find_covariance();
  void weigh();
  [[nodiscard]] double deviation(std::size_t at) const {
    return std::sqrt(
        std::max(0.0, covariance_(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(at))));
  }
  [[nodiscard]] Estimate found(double value, std::size_t at, double before) const {
    const double left = deviation(at);
    return {value, kModel * left, left < kLearnt * before};
  }
  void tell_side(const DriveModel& model, std::size_t side, SideEstimate& to) const;
  void tell_regulators(const DriveModel& model, MachineEstimate& machine) const;

  const std::vector<PreparedPoint>& points_;
  ValvePriors priors_;
  std::size_t drives_;
  bool falls_;
  Blocks blocks_;
  std::vector<PointSpread> spread_;
  ceres::Problem problem_;
  Square covariance_ = Square::Zero();
};

}  // namespace graben::identify
