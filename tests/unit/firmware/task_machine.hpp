// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The 12 t machine with tasks, and one that does what its valve is asked: a controller in a closed
/// loop with drives alone.

#include <memory>

#include "firmware/excavator/excavator_controller.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/firmware/inputs.hpp"
#include "tests/unit/firmware/memory_access.hpp"

namespace graben::test {

/// As it answers in the loop: dead time and lags of ReplayedDrives, a platform no softer than that.
inline ExcavatorProfile answering_12t() {
  ExcavatorProfile profile = without_body(excavator_12t().profile);
  profile.control.dead_time_s = 0.05;
  profile.control.response_s = 0.052;
  profile.control.swing_lead_s = 0.0;
  profile.safety.stall_s = 60.0;  // Some tests look at what it does while it is held.
  return profile;
}

inline TaskProgram program_of(const ProgramRequest& request) {
  const ProgramResult result = plan_program(answering_12t(), request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

/// A level line before the machine and two moves, back to its beginning.
inline ProgramRequest level_dig() {
  ProgramRequest request;
  request.start = {{7.0, 0.0, -0.4}, 2.2};
  request.step[0] = {StepKind::kDig, {{4.8, 0.0, -0.4}, 0.9}, true, 0.5, 0.0, 1.0};
  request.step[1] = {StepKind::kSwing, {{0.0, 4.6, 3.4}, 0.3}, false, 0.0, 0.0, 0.5};
  request.step[2] = {StepKind::kReturnToDig, request.start, false, 0.0, 0.0, 0.5};
  request.step_count = 3;
  return request;
}

inline TaskBook book_of(std::initializer_list<TaskProgram> programs) {
  TaskBook book;
  for (const TaskProgram& program : programs) {
    book.program[static_cast<unsigned>(book.count++)] = program;
  }
  return book;
}

/// Armed as an operator does it; asked for the first task from the next cycle on.
struct TaskMachine {
  ExcavatorProfile profile;
  std::shared_ptr<const ExcavatorSetup> setup;  ///< Of its copies too.
  ExcavatorController controller;
  ReplayedDrives drives;  ///< Swing in rad.
  OperatorInputs driver;
  ExcavatorOutputs outputs;
  TimeUs now_us = kSecondUs;
  int cycles = 0;

  TaskMachine(const TaskBook& book, const DriveVector& start,
              const ExcavatorProfile& machine = answering_12t())
      : profile(machine),
        setup(std::make_shared<ExcavatorSetup>(machine, book)),
        controller(*setup),
        drives(start, true) {
    driver.speed_override_ratio.value = 1.0;
    driver.mode.value = OperatorMode::kAutomatic;
    for (const bool enable : {false, false, true}) {
      driver.enable.value = enable;
      step();
    }
    assert_int_equal(outputs.status.mode, EcuMode::kArmed);
    driver.task.value = Task::kProgram;
  }

  [[nodiscard]] ExcavatorInputs inputs() const {
    ExcavatorInputs inputs = following_inputs(outputs, now_us);
    make_12t(inputs);
    // What steps so far says nothing of flow, which this machine does not have.
    const double alive_pa = cycles % 2 == 0 ? 0.0 : 4.5e6;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      inputs.axis[i].stroke_m.value =
          std::clamp(drives.value()[i], 0.0, profile.geometry.cylinder[i].stroke_m);
      inputs.axis[i].cap_pressure_pa.value += alive_pa;
      inputs.axis[i].rod_pressure_pa.value += alive_pa;
    }
    inputs.swing.angle_rad.value = drives.value()[kSwing];
    inputs.swing.left_pressure_pa.value += alive_pa;
    inputs.swing.right_pressure_pa.value += alive_pa;
    inputs.driver.enable.value = driver.enable.value;
    inputs.driver.task.value = driver.task.value;
    inputs.driver.task_number = fresh(driver.task_number.value, now_us);
    inputs.driver.speed_override_ratio.value = driver.speed_override_ratio.value;
    return inputs;
  }
  const ExcavatorOutputs& step(const ExcavatorInputs& inputs) {
    outputs = controller.step(inputs, now_us);
    DriveVector asked_mps = DriveVector::Zero();
    if (outputs.enable) {
      asked_mps = DriveVector(ControllerMemoryAccess::last(controller).asked_mps.data());
    }
    drives.ask(drives_of(profile, asked_mps));
    now_us += 10 * kMillisecondUs;
    ++cycles;
    return outputs;
  }
  const ExcavatorOutputs& step() { return step(inputs()); }
  /// Must stay in motion.
  void run(int count) {
    for (int n = 0; n < count; ++n) {
      step();
      assert_int_equal(outputs.status.mode, EcuMode::kActive);
    }
  }
  /// Until `reached(progress)`; fails after a minute.
  template <class Reached>
  void run_until(Reached&& reached) {
    for (int n = 0; n == 0 || !reached(outputs.status.progress); ++n) {
      assert_true(n < 6000);
      run(1);
    }
  }
};

}  // namespace graben::test
