// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The shipped dozer driving on its design, as a machine that does what it is told at once: what
/// the controller needs to be brought to kActive the way an operator does it.

#include <algorithm>
#include <functional>
#include <memory>

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

namespace graben::test {

struct Grading {
  static constexpr TimeUs kPeriod = 10 * kMillisecondUs;

  explicit Grading(const DozerProfile& dozer_profile = dozer().profile)
      : profile(dozer_profile),
        setup(std::make_shared<DozerSetup>(profile)),
        controller(*setup),
        blade(profile.blade) {
    stroke_m = blade.stroke_m(0.0);
    tilt_stroke_m = setup->tilt.stroke_m(0.0);
    DozerInputs released = next();
    released.driver.enable.value = false;
    step(released);
    step(at_rest(false));
    step(at_rest(true));
    run(20);
    assert_int_equal(outputs.status.mode, EcuMode::kActive);
    assert_true(outputs.status.faults.empty());
  }

  /// What the machine says now. It stands level on level ground.
  DozerInputs next() {
    const double engine_radps = profile.hst.engine_radps;
    speed_mps = track_speed_mps(profile.hst, engine_radps, outputs.pump_ratio[kLeft],
                                outputs.motor_ratio[kLeft]);
    position_m += speed_mps * 0.01;
    const double flow_m3ps = profile.implement.valve_flow_max_m3ps;
    const double blade_mps = outputs.enable ? std::clamp(outputs.status.wanted_blade_mps,
                                                         -flow_m3ps / profile.blade.rod_area_m2(),
                                                         flow_m3ps / profile.blade.cap_area_m2())
                                            : 0.0;
    stroke_m = std::clamp(stroke_m + blade_mps * 0.01, 0.0, blade.stroke_max_m());
    DozerInputs inputs = complete_dozer_inputs(now_us);
    if (profile.tilt.present) {
      tilt_stroke_m += outputs.enable ? outputs.status.wanted_tilt_mps * 0.01 : 0.0;
      inputs.tilt_stroke_m = fresh(tilt_stroke_m, now_us);
      inputs.tilt_spool_ratio = fresh(outputs.tilt_duty_ratio, now_us);
      inputs.body.roll_rad = fresh(roll_rad, now_us);
      inputs.body.roll_rate_radps = fresh((roll_rad - last_roll_rad) / 0.01, now_us);
      last_roll_rad = roll_rad;
    }
    std::array<double, kTrackCount> tracks_mps = {speed_mps, speed_mps};
    if (profile.grade.curves()) {
      tracks_mps[kRight] = track_speed_mps(profile.hst, engine_radps, outputs.pump_ratio[kRight],
                                           outputs.motor_ratio[kRight]);
      turn(tracks_mps, inputs.body);
    }
    inputs.blade_stroke_m = fresh(stroke_m, now_us);
    inputs.blade_spool_ratio = fresh(outputs.blade_duty_ratio, now_us);
    inputs.valve_enabled = fresh(outputs.enable, now_us);
    inputs.body.position_m = fresh(position_m, now_us);
    inputs.body.height_m = fresh(height_m, now_us);
    inputs.body.pitch_rad = fresh(0.0, now_us);
    inputs.body.velocity_mps = fresh(speed_mps, now_us);
    inputs.body.climb_mps = fresh(0.0, now_us);
    inputs.body.pitch_rate_radps = fresh(0.0, now_us);
    for (unsigned i = 0; i < kTrackCount; ++i) {
      inputs.track[i].pump_ratio = fresh(outputs.pump_ratio[i], now_us);
      inputs.track[i].motor_ratio = fresh(outputs.motor_ratio[i], now_us);
      inputs.track[i].speed_mps = fresh(tracks_mps[i], now_us);
    }
    inputs.engine_speed_radps = fresh(engine_radps, now_us);
    return inputs;
  }
  /// As its tracks say, on a track that curves. The station is the way of its middle.
  void turn(const std::array<double, kTrackCount>& tracks_mps, BodyInputs& body) {
    const double middle_mps = 0.5 * (tracks_mps[kLeft] + tracks_mps[kRight]);
    course.yaw_rate_radps =
        0.5 * (tracks_mps[kRight] - tracks_mps[kLeft]) / profile.body.half_gauge_m;
    position_m += (middle_mps - speed_mps) * 0.01;
    speed_mps = middle_mps;
    course = course_after(setup->design, course, position_m, speed_mps, 0.01);
    body.offset_m = fresh(course.offset_m, now_us);
    body.heading_rad = fresh(course.heading_rad, now_us);
    body.yaw_rate_radps = fresh(course.yaw_rate_radps, now_us);
  }
  DozerInputs at_rest(bool enable) {
    DozerInputs resting = next();
    resting.driver.enable.value = enable;
    resting.driver.task.value = Task::kNone;
    return resting;
  }
  DozerOutputs step(const DozerInputs& inputs) {
    outputs = controller.step(inputs, now_us);
    now_us += kPeriod;
    return outputs;
  }
  void run(int cycles) {
    repeat(cycles, [&] { step(next()); });
  }

  DozerProfile profile;
  std::shared_ptr<const DozerSetup> setup;  ///< Of its copies too.
  DozerController controller;
  BladeKinematics blade;
  TimeUs now_us = kSecondUs;
  DozerOutputs outputs;
  double position_m = -3.0;
  double height_m = 0.0;
  double stroke_m = 0.0;
  double tilt_stroke_m = 0.0;
  double roll_rad = 0.0;
  double last_roll_rad = 0.0;
  Course course;
  double speed_mps = 0.0;
};

using ChangeOfDozer = std::function<void(DozerInputs&)>;

/// A machine that has graded for half a second, and what it does once its inputs are changed so:
/// until it stops, or so many cycles.
inline Grading graded_with(const DozerProfile& profile, const ChangeOfDozer& change, int cycles) {
  Grading grading(profile);
  grading.run(50);
  for (int n = 0; n < cycles && grading.outputs.status.mode == EcuMode::kActive; ++n) {
    DozerInputs inputs = grading.next();
    change(inputs);
    grading.step(inputs);
  }
  return grading;
}

inline void assert_neutral(const DozerOutputs& outputs) {
  assert_false(outputs.enable);
  assert_near(outputs.blade_duty_ratio, 0.0, 0.0);
  assert_near(outputs.tilt_duty_ratio, 0.0, 0.0);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    assert_near(outputs.pump_ratio[i], 0.0, 0.0);
    assert_near(outputs.motor_ratio[i], 1.0, 0.0);
  }
}

inline void assert_stopped_by(Fault fault, const DozerOutputs& outputs) {
  assert_int_equal(outputs.status.mode, EcuMode::kFault);
  assert_int_equal(outputs.status.fault, fault);
  assert_neutral(outputs);
}

}  // namespace graben::test
