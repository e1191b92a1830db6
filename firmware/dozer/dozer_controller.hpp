// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's controller: one step from signals to commands, 100 times a second.

#include "firmware/core/sealed.hpp"
#include "firmware/dozer/blade_control.hpp"
#include "firmware/dozer/flow_share.hpp"
#include "firmware/dozer/safety/dozer_gate.hpp"
#include "firmware/dozer/safety/dozer_watch.hpp"
#include "firmware/dozer/tilt_control.hpp"
#include "firmware/dozer/travel/blade_load.hpp"
#include "firmware/dozer/travel/body_motion.hpp"
#include "firmware/dozer/travel/course.hpp"
#include "firmware/dozer/travel/fall.hpp"
#include "firmware/dozer/travel/passes.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "firmware/dozer/travel/speed_limit.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/tuning.hpp"
#include "firmware/drives/drive_servo.hpp"
#include "firmware/safety/cycle.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/task_change.hpp"
#include "firmware/safety/tube.hpp"

namespace graben {

/// Dozer controller configuration, computed once, at start or before it goes into flash.
struct DozerSetup {
  // NOLINTNEXTLINE(google-explicit-constructor): a profile is all that it takes.
  DozerSetup(const DozerProfile& machine);

  DozerProfile profile;  ///< Must have passed the application's check.
  DozerBank bank;
  BladeKinematics blade;
  TiltKinematics tilt;
  GradeProfile design;
};

/// Belongs to the tests; nothing of ours defines it.
struct DozerMemoryAccess;

/// Holds what one cycle hands to the next, under a seal; what the machine is stays with the caller.
/// No clock, no globals, no heap; `step` costs a bounded number of operations.
class DozerController {
 public:
  /// `setup` has to outlive it and its copies.
  explicit DozerController(const DozerSetup& setup);
  explicit DozerController(DozerSetup&&) = delete;

  /// One cycle. Any fault gives neutral commands and its code; time only ever counts by
  /// difference, and `now_us` must not fall from call to call.
  [[nodiscard]] DozerOutputs step(const DozerInputs& inputs, TimeUs now_us);

 private:
  /// Lets tests flip a bit of what is stored.
  friend struct DozerMemoryAccess;

  /// Motion of a cycle before the gate.
  struct Motion {
    BladeCommand blade;
    TiltCommand tilt;
    SpeedChoice speed;
    DozerCommand command;
    std::array<TrackState, kTrackCount> track{};
    SteeringState steering;
    double off_track_m = 0.0;  ///< Of a track that curves, the edge's middle left of it.
    double required_flow_m3ps = 0.0;
    double available_flow_m3ps = 0.0;
    std::array<double, kBladeCount> asked_mps{};  ///< Of lift and tilt, as far as the flow goes.
    bool fed = true;                              ///< The pump gives what both ask for.
  };

  struct Memory {
    /// As before the first cycle.
    explicit Memory(const DozerSetup& setup);

    GradeProfile design;  ///< Of this pass.
    GroundMap ground;
    CycleMemory cycle;
    DozerGateState gate;
    DozerValidationState validation;
    DozerWatchState watch;
    DozerLastCommands last;
    SpeedState speed;
    BladeState blade;
    TiltState tilt;
    bool fed = true;                              ///< In the last cycle, as the next.
    std::array<double, kBladeCount> asked_mps{};  ///< See Motion.
    std::array<ServoState, kBladeCount> servo;    ///< What is under way to lift and tilt.
    std::array<TrackState, kTrackCount> track{};
    Foretelling foretelling;
    PushState load;
    FlowShareState flow;
    FallState fall;
    PassState pass;
    PassSituation in_pass;
    PositionState position;
    BrakeState brake;
    TaskChangeState change;
    StallState stall;
    TubeState tube;
    SteeringState steering;  ///< Of a design whose track curves, as the next.
    TubeState off_track;
  };

  [[nodiscard]] DriveRows drives() const { return setup_.bank.rows(); }
  [[nodiscard]] DozerValid validate_and_watch(const DozerInputs& inputs, const Cycle& cycle,
                                              TimeUs now_us);
  /// The task as it may be followed: a change of it passes standstill.
  void choose_task(DozerValid& valid, double period_s);
  /// Takes in where the machine is: what the blade has cut, what lies ahead.
  void estimate(const DozerValid& valid, double period_s);
  [[nodiscard]] FlowSituation flow_now(const DozerValid& valid) const {
    return {{due_mps(memory_->servo[kBladeLift]), due_mps(memory_->servo[kBladeTilt])},
            {valid.blade().stroke_m, valid.tilt().stroke_m},
            memory_->last.drives.moving ? valid.engine_radps : 0.0};
  }
  /// As it is measured, over its track.
  [[nodiscard]] Driving driving_of(const DozerValid& valid) const {
    const Stand stand{valid.height_m - raised_m(valid, valid.position_m), valid.pitch_rad};
    return {motion_of(profile_.body, stand, valid.climb_mps, valid.pitch_rate_radps),
            valid.position_m, valid.velocity_mps};
  }
  /// `lead_s` after that.
  [[nodiscard]] Driving driven(const DozerValid& valid, double lead_s) const;
  /// Follows what happens if the ground before the blade lets go of it.
  void watch_fall(const DozerValid& valid, double period_s);
  /// Body and blade so much after the moment that the measured pose is of, with this stroke.
  [[nodiscard]] BladeSituation foretold(const DozerValid& valid, double lead_s,
                                        double stroke_m) const;
  /// What the blade is to leave standing there.
  [[nodiscard]] BladeLift lift_at(const Driving& driving) const;
  /// On a track that curves: edge and design as they lie there, `lead_s` on.
  void place_on_curve(const DozerValid& valid, double lead_s, BladeSituation& at) const;
  /// So much higher is the design below the body than on the track beside it.
  [[nodiscard]] double raised_m(const DozerValid& valid, double x_m) const {
    return memory_->design.cross_at(x_m).slope * valid.course.offset_m;
  }
  [[nodiscard]] double reach_m() const { return setup_.blade.edge_m(0.0).x(); }
  [[nodiscard]] EdgeCourse edge_now(const DozerValid& valid) const {
    return edge_course(memory_->design, valid.position_m, valid.course, reach_m());
  }
  /// Of the error that the task allows, what the blade may leave standing on purpose: the rest is
  /// for what nobody foresees.
  [[nodiscard]] double lift_most_m() const { return kGradeLiftShare * profile_.grade.tolerance_m; }

  /// The same of the tilt.
  [[nodiscard]] TiltSituation tilt_at(const BladeSituation& at, double stroke_m) const;
  /// How much farther off the design than its middle an end of the edge is, by that error of its
  /// slope.
  [[nodiscard]] double at_ends_m(double cross_error) const {
    return profile_.tilt.half_width_m() * std::abs(cross_error);
  }
  /// Both drives' velocities, and what the pump makes of them: it shares its flow between them as
  /// they ask for it.
  void move_blade(const DozerValid& valid, double period_s, Motion& motion) const;
  void move_tilt(const DozerValid& valid, const BladeSituation& now, const BladeSituation& then,
                 double period_s, Motion& motion) const;
  /// Blade and travel speed, and the displacements for it.
  [[nodiscard]] Motion flow_limited(const DozerValid& valid, double period_s) const;
  /// v_c on the way back from a pass.
  [[nodiscard]] SpeedChoice return_speed(double desired_mps, double period_s) const;
  /// v_c of this cycle and what it is chosen from.
  [[nodiscard]] SpeedChoice choose_speed(const DozerValid& valid, const Motion& motion,
                                         double period_s) const;
  void describe_motion(const Motion& motion, const FaultSet& degraded, DozerStatus& status) const;
  /// Keeps what the next cycle needs of this one.
  void remember(const DozerValid& valid, const Motion& motion, const ModeDecision& decision,
                const DozerGateResult& gated, double period_s);

  const DozerSetup& setup_;
  const DozerProfile& profile_;
  Sealed<Memory> memory_;
  Preview preview_;  ///< Made anew in each cycle.
};

}  // namespace graben
