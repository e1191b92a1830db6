// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Second stage of a cycle: what cannot be seen. Loads, what the servos are owed, the oil's state,
/// the ground's force and the payload, after the last cycle's command.

#include "firmware/excavator/estimation/load/load_observer.hpp"
#include "firmware/excavator/estimation/oil/held_load.hpp"
#include "firmware/excavator/estimation/oil/oil_gains.hpp"
#include "firmware/excavator/estimation/oil/oil_softness.hpp"
#include "firmware/excavator/inputs/inputs.hpp"
#include "firmware/excavator/stage.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {

/// What estimates have to know of the motion that is under way.
struct MotionUnderWay {
  StepKind kind = StepKind::kNone;  ///< Of a program's step, and how far it has come.
  double share = 0.0;
  bool on_plan = false;   ///< There are places, `planned_m`, where the drives should be.
  bool new_plan = false;  ///< And they begin newly.
  DriveVector planned_m = DriveVector::Zero();
  bool for_oil = false;  ///< The oil's law may lead it: a dig's path and cuts.
};

/// State from cycle to cycle.
struct EstimationState {
  KinematicState pose;  ///< Of this cycle.
  std::array<LoadState, kDriveCount> load{};
  ExcavatorServo servo;
  OilState oil;
  OilSoftness softness;
  OilModes modes;
  HeldLoad held;
  double payload_kg = 0.0;  ///< As weighed at rest, for the oil's modes.
  LoadObserver load_observer;
  SwingPush swing_push;
};

/// Gains of the oil's law; all 0 unless control.law has the oil as a state.
[[nodiscard]] OilGains oil_gains(const ExcavatorProfile& profile);

/// The profile has what the oil's law needs, and asks for it.
[[nodiscard]] bool is_on_oil(const ExcavatorProfile& profile);

/// A cycle on. Not inlined, for the stack below the solver.
[[gnu::noinline]] void estimate(const ExcavatorModel& machine, const OilGains& gains,
                                const ExcavatorValid& valid, const InputState& inputs,
                                const MotionUnderWay& motion, const Cycle& cycle,
                                const LastCycle& last, EstimationState& state);

}  // namespace graben
