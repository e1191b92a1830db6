// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"

namespace graben {
namespace {

/// Farther off the path the oil's law gives way to the field, which then leads back.
constexpr double kFarOff_m = 0.15;
/// Of the weight, from which on the oil's law decides.
constexpr double kLeads = 0.5;
/// Of what is measured in a cycle at rest.
constexpr double kWeighs = 0.02;
/// Way of the teeth over a stroke below which a direction is left alone.
constexpr double kInLine = 0.1;

bool on_oil(const ExcavatorProfile& profile) {
  return profile.control.law == ControlLaw::kOil && profile.oil.known();
}

/// Time constant of the side to which a spool is to go, that is led through; 0 of one that is too
/// slow for it.
double led_through_s(const SpoolAnswers& answer, double wanted_ratio, double travel_ratio) {
  const bool extends = wanted_ratio != 0.0 ? wanted_ratio > 0.0 : travel_ratio > 0.0;
  const double constant_s = answer.side(extends).spool_time_constant_s;
  return constant_s <= kLedSpoolMost_s ? constant_s : 0.0;
}

/// Travels of boom and arm that lead the teeth back to the path with the bucket as it is: what the
/// bucket's cylinder gives way to its load is theirs too, it is slower. Damped least squares: where
/// the teeth are in line with both pins, one direction is nobody's.
Eigen::Vector2d off_path_m(const RoundedRectangle& path, const KinematicState& now) {
  const Eigen::Vector2d tip_m(now.tip.x_m, now.tip.y_m);
  Eigen::Vector2d off_m = tip_m - path.closest(tip_m).position_m;
  off_m /= 1.0 + off_m.squaredNorm() / (kFarOff_m * kFarOff_m);
  const Eigen::Matrix2d jacobian = now.jacobian.topLeftCorner<2, 2>();
  const Eigen::Vector2d pull = jacobian.transpose() * off_m;
  const Eigen::Matrix2d squared = jacobian.transpose() * jacobian;
  const double boom = squared(0, 0) + kInLine * kInLine;
  const double arm = squared(1, 1) + kInLine * kInLine;
  const double both = squared(0, 1);
  return Eigen::Vector2d(arm * pull.x() - both * pull.y(), boom * pull.y() - both * pull.x()) /
         (boom * arm - both * both);
}

}  // namespace

bool ExcavatorController::leads_on_oil(const ExcavatorValid& valid) const {
  const TaskProgram* program = running(valid);
  return are_quick(drives()) &&
         (valid.task == Task::kDig || (program != nullptr && cuts(*program, memory_.task.state)));
}

void ExcavatorController::estimate_oil(const ExcavatorValid& valid, const KinematicState& now,
                                       EcuMode mode) {
  if (!on_oil(profile_)) {
    return;
  }
  OilSeen seen = oil_seen(drives(), valid.drive);
  for (int axis = 0; axis < 2; ++axis) {
    seen.asked_mps[axis] = memory_.last.asked_mps[static_cast<unsigned>(axis)];
    seen.expected_mps[axis] = memory_.expected_mps[axis];
    seen.stands[axis] = stands_open(memory_.watch.drives.learnt[static_cast<unsigned>(axis)]);
  }
  HeldLoad& held = memory_.held;
  seen.yield_mpsn = held.yield_mpsn;
  seen.opened_for_n = held.leads ? held.force_n : filtered_force_n(drives(), memory_.load);
  const bool reached = now.status == ReachStatus::kOk;
  if (reached) {
    weigh(seen, now, mode);
    memory_.modes =
        oil_modes(profile_.oil, profile_.geometry, now, memory_.load, memory_.payload_kg);
  }
  const bool leads = reached && seen.force_known && leads_on_oil(valid);
  next_oil(setup_.oil, memory_.modes, seen, mode == EcuMode::kActive && reached, leads,
           memory_.oil);
  if (reached) {
    next_held_load(memory_.oil, seen.expected_mps,
                   stroke_inertia_kg(profile_.oil, profile_.geometry, now, memory_.payload_kg),
                   held);
  }
}

void ExcavatorController::weigh(const OilSeen& seen, const KinematicState& now, EcuMode mode) {
  if (mode == EcuMode::kActive || !seen.force_known) {
    return;
  }
  const double measured_kg = payload_kg(profile_.oil, profile_.geometry, now, seen.force_n[kBoom]);
  memory_.payload_kg += kWeighs * (measured_kg - memory_.payload_kg);
}

void ExcavatorController::correct_off_path(const ExcavatorValid& valid, const KinematicState& now,
                                           Motion& motion) const {
  if (now.status == ReachStatus::kOk && !motion.wanted_mps.isZero(0.0)) {
    correct_on_oil(
        valid.speed_override_ratio,
        off_path_m(setup_.field.path(), now) + memory_.oil.travel_m - now.strokes_m.head<2>(),
        motion);
  }
}

void ExcavatorController::correct_off_plan(double speed_override_ratio, Motion& motion) const {
  if (motion.task.holds) {
    const DriveVector due_m = motion.task.planned_m - memory_.servo.under_way_m();
    correct_on_oil(speed_override_ratio, memory_.oil.travel_m - due_m.head<2>(), motion);
  }
}

void ExcavatorController::correct_on_oil(double speed_override_ratio, const Eigen::Vector2d& off_m,
                                         Motion& motion) const {
  const double weight = memory_.oil.weight;
  if (!on_oil(profile_) || weight == 0.0) {
    return;
  }
  const Eigen::Vector2d correction_mps =
      oil_correction_mps(setup_.oil, memory_.modes, memory_.oil, off_m);
  // The oil swings as fast on a slow path; the operator's word still bounds what is asked of it.
  const double authority = std::sqrt(speed_override_ratio);
  for (int axis = 0; axis < 2; ++axis) {
    const double on_oil_mps = corrected_by(
        drives()[axis], memory_.servo.drive[static_cast<unsigned>(axis)], motion.wanted_mps[axis],
        authority * correction_mps[axis], memory_.lambda.value());
    motion.corrected_mps[axis] += weight * (on_oil_mps - motion.corrected_mps[axis]);
  }
}

void ExcavatorController::park_spools(const ExcavatorValid& valid, double period_s,
                                      Motion& motion) {
  if (valid.task != Task::kDig || memory_.oil.weight < kLeads || motion.eases) {
    memory_.parking = {};
    return;
  }
  const double lambda = std::max(memory_.lambda.value(), profile_.control.servo_least_lambda);
  for (int axis = 0; axis < 2; ++axis) {
    if (park(motion.wanted_mps[axis], lambda * motion.corrected_mps[axis], period_s,
             memory_.parking[static_cast<unsigned>(axis)])) {
      motion.corrected_mps[axis] = 0.0;
    }
  }
}

void ExcavatorController::open_as_learnt(ExcavatorOutputs& outputs) const {
  if (profile_.control.law == ControlLaw::kKim || !outputs.enable) {
    return;
  }
  for (int i = 0; i < drives().count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    if (outputs.duty_ratio[k] != 0.0 && is_learnt(drives()[i])) {
      outputs.duty_ratio[k] =
          learnt_duty(drives()[i], memory_.watch.drives.learnt[k], memory_.opening[k].value());
    } else if (i < 2 && memory_.parking[k].parked) {
      outputs.duty_ratio[k] =
          parked_duty(drives()[i], memory_.watch.drives.learnt[k], memory_.parking[k].side);
    }
  }
}

void ExcavatorController::tell_learnt(ExcavatorStatus& status) const {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const DriveRow& drive = drives()[axis];
    const LearntValve& valve = memory_.watch.drives.learnt[k];
    status.edges[k] = {{is_edge_known(valve.extend), learnt_edge_ratio(drive, valve, true)},
                       {is_edge_known(valve.retract), learnt_edge_ratio(drive, valve, false)}};
  }
}

void ExcavatorController::lead_spools(ExcavatorOutputs& outputs) {
  if (!on_oil(profile_) || !outputs.enable || memory_.last.tried) {
    memory_.spool = {};
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const double wanted = outputs.duty_ratio[k];
    SpoolModel& spool = memory_.spool[k];
    outputs.duty_ratio[k] =
        led_duty(led_through_s(drives()[axis].answer, wanted, spool.travel_ratio), wanted, spool);
    memory_.last.lead_ratio[k] = outputs.duty_ratio[k] - wanted;
  }
}

}  // namespace graben
