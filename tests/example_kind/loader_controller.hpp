// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The loader's controller: the bucket's edge along a straight cut, by the common rooms.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "firmware/core/sealed.hpp"
#include "firmware/drives/bank_cycle.hpp"
#include "firmware/drives/spool_opening.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "firmware/numeric/triangle.hpp"
#include "tests/example_kind/loader_profile.hpp"

namespace graben {

struct LoaderInputs : MachineInputs {
  std::array<DriveInputs, kLoaderDrives> drive;
};

struct LoaderOutputs : MachineOutputs {
  std::array<double, kLoaderDrives> duty_ratio{};
  MachineStatus status;
};

inline DriveRow loader_drive(const LoaderProfile& profile, unsigned i) {
  DriveRow row;
  set_cylinder_range(profile.stroke_m[i], row);
  row.extend_area_m2 = profile.cap_m2[i];
  row.retract_area_m2 = profile.rod_m2[i];
  row.spool = profile.spool[i];
  row.metering = profile.metering;
  row.answer = straight_answers(profile.deadband_ratio, 0.0, 0.053);
  row.control.spool_rate_ps = 3.0;
  row.control.spool_threshold = 0.001;
  row.control.stroke_end_gain_ps = 2.0;
  row.control.end_slack_m = 0.05e-3;
  row.control.deceleration_mps2 = 0.5;
  row.control.at_end = {LimitKind::kStrokeEnd, static_cast<std::uint8_t>(i)};
  row.feedback = {2.0, 0.025, 0.025, 0.2, 2.4, 0.4};
  row.watch.fastest_mps = kFasterThanPumps * rated_flow_m3ps(profile.pump) / profile.rod_m2[i];
  row.watch.settle_s = 0.10;
  row.watch.spool_tolerance = 0.12;
  row.watch.uncommanded_m = 0.06;
  row.watch.stuck_m = 0.06;
  row.watch.pressure_rail_pa = 40e6;
  row.watch.rest_s = rest_s(row);
  return row;
}

struct LoaderSetup {
  LoaderProfile profile;
  DriveBank<kLoaderDrives> bank{{loader_drive(profile, kLift), loader_drive(profile, kTilt)}};
  McvMachine valve = mcv_machine(bank.rows(), {&profile.pump, 1});
};

class LoaderController {
 public:
  /// `setup` has to outlive it.
  explicit LoaderController(const LoaderSetup& setup) : setup_(setup) {}

  [[nodiscard]] LoaderOutputs step(const LoaderInputs& inputs, TimeUs now_us) {
    const Cycle cycle = begin_cycle(memory_->cycle, memory_.unseal(), now_us);
    const BankValid<kLoaderDrives> valid = validate_and_watch(inputs, cycle, now_us);
    estimate(drives(), valid, cycle, 0.15, *memory_);
    const BankMotion<kLoaderDrives> motion = along_the_cut(valid);
    const double flow_m3ps = pump_flow_m3ps(setup_.profile.pump, valid.engine_radps, 1.0);
    const McvSolution solution =
        steady_lambda(setup_.valve, mcv_input(motion.corrected_mps, memory_->load, {&flow_m3ps, 1}),
                      McvPolicy::kGlobal, {6.0, 2000.0, 0.75}, memory_->lambda, cycle.period_s);
    ModeDecision decision =
        decide_mode(memory_->cycle, cycle, valid, solver_fault(solution),
                    spools_centred(drives(), valid.drive), inputs.link.stop_requested);
    LoaderOutputs outputs;
    const GateResult gated = put_out(drives(), decision.active(), solution.point.spool_m,
                                     cycle.period_s, *memory_, outputs.duty_ratio);
    take_refusal(gated.fault, decision);
    outputs.enable = gated.enable;
    end_cycle(decision, valid, memory_->cycle, outputs, outputs.status);
    if (decision.active()) {
      outputs.status.lambda = motion.cap.factor * solution.point.lambda;
      outputs.status.limit =
          held_by({solution.limit, motion.cap.limit, degraded_limit(valid.degraded)});
    }
    remember(decision, outputs, motion, solution.point.lambda, *memory_);
    memory_.seal();
    return outputs;
  }

 private:
  using Vector = Eigen::Vector2d;

  [[nodiscard]] DriveRows drives() const { return setup_.bank.rows(); }

  [[nodiscard]] BankValid<kLoaderDrives> validate_and_watch(const LoaderInputs& inputs,
                                                            const Cycle& cycle, TimeUs now_us) {
    BankValid<kLoaderDrives> valid;
    const BusCapabilities bus;
    const Freshness fresh(0.045, now_us);
    const double rated_radps = setup_.profile.pump.rated_speed_radps;
    read_machine(bus, inputs, {rated_radps, 0.4 * rated_radps}, fresh, now_us, valid);
    read_and_watch(drives(), bus, inputs.drive, fresh, 0.3, cycle.period_s, *memory_, valid);
    return valid;
  }

  [[nodiscard]] BankMotion<kLoaderDrives> along_the_cut(
      const BankValid<kLoaderDrives>& valid) const {
    const LoaderProfile& profile = setup_.profile;
    // Where the drives will be when a command of now takes effect.
    Vector angle_rad;
    Vector radpm;
    for (unsigned i = 0; i < kLoaderDrives; ++i) {
      const CylinderTriangle triangle(profile.parent_pin_m[i], profile.child_pin_m[i], -1);
      angle_rad[i] = triangle.angle(profile.closed_length_m[i] +
                                    stroke_then_m(setup_.bank.row[i], memory_->servo[i]));
      radpm[i] = 1.0 / triangle.length_rate(angle_rad[i]);
    }
    const double both_rad = angle_rad.sum();
    const Vector bucket_m = profile.bucket_m * Vector(std::sin(both_rad), -std::cos(both_rad));
    const Vector edge_m =
        profile.arm_m * Vector(std::cos(angle_rad[kLift]), std::sin(angle_rad[kLift])) + bucket_m;
    Eigen::Matrix2d per_stroke;
    per_stroke << -edge_m.y() * radpm[kLift], -bucket_m.y() * radpm[kTilt],
        edge_m.x() * radpm[kLift], bucket_m.x() * radpm[kTilt];
    BankMotion<kLoaderDrives> motion;
    if (valid.task == Task::kDig) {
      const Vector along = (profile.cut_to_m - profile.cut_from_m).normalized();
      const Vector left_m = profile.cut_to_m - edge_m;
      const double most_mps = profile.speed_mps * valid.speed_override_ratio;
      const double along_mps = std::clamp(2.0 * along.dot(left_m), -most_mps, most_mps);
      const Vector back_mps = 3.0 * (left_m - along.dot(left_m) * along);
      // Where the drives cannot move the edge so, no number comes of it, and the solver refuses it.
      const Vector wanted_mps = per_stroke.inverse() * (along_mps * along + back_mps);
      motion.wanted_mps = {wanted_mps[kLift], wanted_mps[kTilt]};
      correct(drives(), valid, *memory_, motion);
    }
    return motion;
  }

  const LoaderSetup& setup_;
  Sealed<BankMemory<kLoaderDrives>> memory_;
};

}  // namespace graben
