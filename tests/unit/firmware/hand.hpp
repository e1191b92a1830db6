// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine that is moved by its levers.

#include "firmware/excavator/motion/hand/hand_motion.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

inline constexpr double kHandPeriod_s = 0.01;
inline constexpr TipPose kHandStart = {5.0, -0.5, 1.3};

/// The machine does at once what is wanted, as far as `followed` lets it.
struct Hand {
  ExcavatorBank bank = excavator_bank(excavator().profile);
  ExcavatorKinematics kinematics{excavator().profile.geometry};
  ExcavatorServo servo;
  HandState state;
  HandAsk ask;
  HandWant want;
  Eigen::Vector3d strokes_m;
  double followed = 1.0;

  explicit Hand(Task task, const TipPose& tip = kHandStart) {
    ask.task = task;
    ask.speed_override_ratio = 1.0;
    strokes_m = kinematics.strokes_from_pose(tip).strokes_m;
    step();
  }
  [[nodiscard]] TipPose tip() const { return kinematics.state(strokes_m).tip; }
  void step() {
    for (int i = 0; i < kAxisCount; ++i) {
      servo.drive[static_cast<unsigned>(i)].stroke_m = strokes_m[i];
    }
    want = want_by_hand(excavator().profile, bank.rows(), kinematics, kinematics.state(strokes_m),
                        servo, ask, state, kHandPeriod_s);
    const Eigen::Vector3d wanted_mps = want.wanted_mps.head<kAxisCount>();
    strokes_m += kHandPeriod_s * followed * wanted_mps;
    state = next_by_hand(excavator().profile.line, want, ask, state, followed, kHandPeriod_s);
  }
  void run(double time_s) {
    for (double at_s = 0.0; at_s < time_s; at_s += kHandPeriod_s) {
      step();
    }
  }
};

}  // namespace graben::test
