// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulated excavator whose operator has levers, or a station that tries duties.

#include <algorithm>
#include <cmath>

#include "app/runs/excavator_rig.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

/// Armed, and at its task with the hands at rest, once constructed.
struct HandsRig : runs::ExcavatorRig {
  HandsRig(const machines::SimulatedExcavator& machine, const Eigen::Vector3d& start_m,
           Task by_hand, const TaskBook& book = {})
      : LoopbackRig(machine, ExcavatorSetup(machine.profile, book), runs::start_at(start_m),
                    by_hand, 1.0),
        kinematics(machine.profile.geometry) {
    driver.set_hands(hands);
  }

  void cycle() {
    driver.set_hands(hands);
    step(now_us);
    now_us += kPeriod_us;
  }
  void run(double time_s) {
    for (double at_s = 0.0; at_s < time_s; at_s += 0.01) {
      cycle();
    }
  }
  void work() {
    run(1.0);
    assert_int_equal(status().mode, EcuMode::kActive);
  }
  /// The operator lets go, gives enable again, and the task.
  void work_again() {
    hands.lever_ratio = {};
    hands.tried_ratio = {};
    release();
    run(0.5);
    enable_from(now_us);
    run(1.0);
    assert_int_equal(status().mode, EcuMode::kActive);
  }

  [[nodiscard]] const ExcavatorStatus& status() const { return ecu->outputs().status; }
  [[nodiscard]] Eigen::Vector3d strokes_m() const {
    const auto strokes = plant.plant().strokes_m();
    Eigen::Vector3d inside(strokes[0], strokes[1], strokes[2]);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      inside[i] = std::clamp(inside[i], 0.0, setup.profile.geometry.cylinder[i].stroke_m);
    }
    return inside;
  }
  [[nodiscard]] TipPose tip() const { return kinematics.state(strokes_m()).tip; }
  [[nodiscard]] bool neutral() const {
    const auto& duty = ecu->outputs().duty_ratio;
    return !ecu->outputs().enable &&
           std::all_of(duty.begin(), duty.end(), [](double each) { return each == 0.0; });
  }

  ExcavatorKinematics kinematics;
  plant::OperatorHands hands;
  TimeUs now_us = 0;
};

}  // namespace graben::test
