#pragma once
/// The error of a joint's model over one run, as Ceres wants it.

#include <ceres/ceres.h>

#include "app/identify/joint_model.hpp"

namespace graben::identify {

/// Residuals: predicted less measured velocity, in parts of the joint's usual velocity, pressed
/// together beyond 0.3 of it. One parameter block of kParameters.
class JointCost : public ceres::CostFunction {
 public:
  /// `of` and `knots` must outlive it. `sign` and `scale_radps` are the joint's.
  JointCost(const JointRun& of, std::size_t joint, const Knots& knots, double sign,
            double scale_radps);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const JointRun& of_;
  std::size_t joint_;
  const Knots& knots_;
  double sign_;
  double scale_radps_;
};

}  // namespace graben::identify
