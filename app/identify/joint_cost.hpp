// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The error of a joint's model over one run, as Ceres wants it.

#include <ceres/ceres.h>

#include <vector>

#include "app/identify/joint_model.hpp"

namespace graben::identify {

/// Rows of a run that lie a second apart.
struct Ahead {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// All pairs of rows that lie `ahead_s` apart, of every `every`th row to start from.
[[nodiscard]] std::vector<Ahead> rows_ahead(const MotionRun& run, double ahead_s,
                                            std::size_t every);

/// Residuals: predicted less measured velocity, in parts of the joint's usual velocity, then
/// predicted less measured turn within a second, in the part of it that the same velocity would
/// turn in kTurn_s; both pressed together beyond one. One parameter block of kParameters.
class JointCost : public ceres::CostFunction {
 public:
  /// `of` and `grid` must outlive it. `sign` and `scale_radps` are the joint's.
  JointCost(const JointRun& of, std::size_t joint, const Grid& grid, double sign,
            double scale_radps);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  template <class T, class Put>
  void residuals(const T* p, const Put& put) const;

  const JointRun& of_;
  std::size_t joint_;
  const Grid& grid_;
  double sign_;
  double scale_radps_;
  std::vector<Ahead> aheads_;
};

}  // namespace graben::identify
