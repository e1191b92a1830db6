// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/on_oil.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/tuning.hpp"

namespace graben {
namespace {

/// Travels of boom and arm that lead the teeth back to the path with the bucket as it is: what the
/// bucket's cylinder gives way to its load is theirs too, it is slower. Damped least squares: where
/// the teeth are in line with both pins, one direction is nobody's. On a slow path the field leads
/// back from nearer on, or it would be left faster than it is followed.
Eigen::Vector2d off_path_m(const RoundedRectangle& path, const KinematicState& now,
                           double speed_override_ratio) {
  const Eigen::Vector2d tip_m(now.tip.x_m, now.tip.y_m);
  Eigen::Vector2d off_m = tip_m - path.closest(tip_m).position_m;
  const double far_m = kOilFarOff_m * std::sqrt(speed_override_ratio);
  off_m /= 1.0 + off_m.squaredNorm() / (far_m * far_m);
  const Eigen::Matrix2d jacobian = now.jacobian.topLeftCorner<2, 2>();
  const Eigen::Vector2d pull = jacobian.transpose() * off_m;
  const Eigen::Matrix2d squared = jacobian.transpose() * jacobian;
  const double boom = squared(0, 0) + kOilInLine * kOilInLine;
  const double arm = squared(1, 1) + kOilInLine * kOilInLine;
  const double both = squared(0, 1);
  return Eigen::Vector2d(arm * pull.x() - both * pull.y(), boom * pull.y() - both * pull.x()) /
         (boom * arm - both * both);
}

/// By what boom and arm are `off_m` beyond where they should be.
void correct(const ExcavatorModel& machine, const OilGains& gains, const EstimationState& estimates,
             double lambda, double speed_override_ratio, const Eigen::Vector2d& off_m,
             Motion& motion) {
  const double weight = estimates.oil.weight;
  if (!is_on_oil(machine.profile) || weight == 0.0) {
    return;
  }
  const Eigen::Vector2d correction_mps =
      oil_correction_mps(gains, estimates.modes, estimates.oil, off_m);
  // The oil swings as fast on a slow path; the operator's word still bounds what is asked of it.
  // Its fourth root: the square root leaves 10 mm at a tenth of the speed, all of it errs more in
  // soil.
  const double authority = std::sqrt(std::sqrt(speed_override_ratio));
  const double known_most_mps = kOilKnownFlow_mps * speed_override_ratio;
  for (int axis = 0; axis < 2; ++axis) {
    // What the valve is known to let through beside the command is undone whole, up to a bound.
    const double known_mps =
        std::clamp(estimates.oil.flow_error_mps[axis], -known_most_mps, known_most_mps);
    const double all_mps = authority * correction_mps[axis] - (1.0 - authority) * known_mps;
    const double on_oil_mps =
        corrected_by(machine.drives[axis], estimates.servo.drive[static_cast<unsigned>(axis)],
                     motion.wanted_mps[axis], all_mps, lambda);
    motion.corrected_mps[axis] += weight * (on_oil_mps - motion.corrected_mps[axis]);
  }
}

}  // namespace

void correct_off_path(const ExcavatorModel& machine, const MotionSources& sources,
                      const EstimationState& estimates, double lambda, double speed_override_ratio,
                      Motion& motion) {
  const KinematicState& now = estimates.pose;
  if (now.status == ReachStatus::kOk && !motion.wanted_mps.isZero(0.0)) {
    correct(machine, sources.oil, estimates, lambda, speed_override_ratio,
            off_path_m(sources.field.path(), now, speed_override_ratio) + estimates.oil.travel_m -
                now.strokes_m.head<2>(),
            motion);
  }
}

void correct_off_plan(const ExcavatorModel& machine, const MotionSources& sources,
                      const EstimationState& estimates, double lambda, double speed_override_ratio,
                      Motion& motion) {
  if (motion.task.holds) {
    const DriveVector due_m = motion.task.planned_m - estimates.servo.under_way_m();
    correct(machine, sources.oil, estimates, lambda, speed_override_ratio,
            estimates.oil.travel_m - due_m.head<2>(), motion);
  }
}

}  // namespace graben
