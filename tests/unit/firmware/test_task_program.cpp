// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_program.hpp"

#include <limits>

#include "firmware/excavator/motion/program/executor.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/rounds.hpp"

using test::kCycle_s;

constexpr int kPrograms = test::rounds(3000, 200);

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

StepRequest line_to(const TeethPose& to) { return {StepKind::kDig, to, true, 0.5, 0.0, 1.0}; }
StepRequest move_to(const TeethPose& to) { return {StepKind::kSwing, to, false, 0.0, 0.0, 0.8}; }

/// Level dig before the machine, lift, quarter turn, back.
ProgramRequest plain_request() {
  ProgramRequest request;
  request.start = {{7.0, 0.0, -0.4}, 2.2};
  request.step[0] = line_to({{4.8, 0.0, -0.4}, 0.9});
  request.step[1] = line_to({{4.9, 0.0, 2.4}, 0.3});
  request.step[1].kind = StepKind::kLift;
  request.step[2] = move_to({{0.0, 4.6, 3.4}, 0.3});
  request.step[3] = move_to(request.start);
  request.step[3].kind = StepKind::kReturnToDig;
  request.step_count = 4;
  return request;
}

ProgramResult plan(const ProgramRequest& request) {
  return plan_program(machine().profile, request);
}

TEST(steps_follow_each_other) {
  ProgramRequest request = plain_request();
  request.repeats = true;
  const ProgramResult result = plan(request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  const TaskProgram& program = result.program;
  assert_int_equal(program.step_count, 4);
  DriveVector last = program.start;
  for (unsigned i = 0; i < 4; ++i) {
    assert_true((step_motion(machine().kinematics, program.step[i], 0.0).value - last).norm() <
                1e-9);
    last = step_motion(machine().kinematics, program.step[i], 1.0).value;
    const TeethPose teeth = machine().teeth(last);
    assert_true((teeth.position_m - request.step[i].to.position_m).norm() < 1e-9);
    assert_near(teeth.attitude_rad, request.step[i].to.attitude_rad, 1e-9);
  }
  assert_true((last - program.end).norm() < 1e-9);
  assert_true((program.end - program.start).norm() < 1e-9);
}

template <class Edit>
ProgramResult edited(Edit&& edit) {
  ProgramRequest request = plain_request();
  edit(request);
  return plan(request);
}

TEST(what_is_no_request_is_refused) {
  const auto bad = ProgramRefusal::kBadRequest;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(edited([](auto& r) { r.step_count = 0; }).refusal, bad);
  assert_int_equal(edited([](auto& r) { r.step_count = kStepMost + 1; }).refusal, bad);
  assert_int_equal(edited([](auto& r) { r.step[1].kind = StepKind::kDone; }).refusal, bad);
  assert_int_equal(edited([](auto& r) { r.step[2].pace_ratio = 1.5; }).refusal, bad);
  assert_int_equal(edited([&](auto& r) { r.step[2].duration_s = nan; }).refusal, bad);
  assert_int_equal(edited([](auto& r) { r.step[0].duration_s = 5.0; }).refusal, bad);
  assert_int_equal(edited([](auto& r) { r.fences.count = kFenceMost + 1; }).refusal, bad);
  assert_int_equal(edited([](auto& r) {
                     r.fences.count = 1;
                     r.fences.fence[0].normal = {0.0, 0.0, 2.0};
                   }).refusal,
                   bad);
  assert_int_equal(edited([](auto& r) {
                     r.has_design = true;
                     r.design.up = {1.0, 0.0, 0.0};
                   }).refusal,
                   bad);
  assert_int_equal(edited([&](auto& r) { r.start.attitude_rad = nan; }).refusal,
                   ProgramRefusal::kBlindSpot);
  const ProgramResult no_way = edited([](auto& r) { r.step[2].to = r.step[1].to; });
  assert_int_equal(no_way.refusal, ProgramRefusal::kNoWay);
  assert_int_equal(no_way.step, 2);
  const ProgramResult open = edited([](auto& r) {
    r.repeats = true;
    r.step[3].to.position_m.x() -= 0.1;
  });
  assert_int_equal(open.refusal, ProgramRefusal::kOpenEnd);
  assert_int_equal(open.step, 3);
}

TEST(blind_spots_name_joint_and_place) {
  const ProgramResult start = edited([](auto& r) { r.start.position_m.x() = 9.5; });
  assert_int_equal(start.refusal, ProgramRefusal::kBlindSpot);
  assert_int_equal(start.place.blind.kind, BlindKind::kOutOfReach);
  assert_near(start.place.share, 0.0, 0.0);
  const ProgramResult line = edited([](auto& r) { r.step[1].to.position_m.z() = 7.5; });
  assert_int_equal(line.refusal, ProgramRefusal::kBlindSpot);
  assert_int_equal(line.step, 1);
  assert_true(line.place.share > 0.1 && line.place.share < 1.0);
  const ProgramResult move = edited([](auto& r) { r.step[2].to.attitude_rad = 3.5; });
  assert_int_equal(move.refusal, ProgramRefusal::kBlindSpot);
  assert_int_equal(move.step, 2);
  assert_int_equal(move.place.blind.drive, kBucket);
  assert_near(move.place.teeth.position_m.y(), 4.6, 0.0);
}

TEST(the_swing_keeps_to_its_range) {
  const ProgramResult result = edited([](auto& r) { r.step[2].to.position_m = {-4.6, 0.1, 3.4}; });
  assert_int_equal(result.refusal, ProgramRefusal::kSwingEnd);
  assert_int_equal(result.step, 2);
  // 3 of 3.12 rad; a place is told to 1e-12 of the way beyond the tolerance of 1 urad.
  assert_near(result.place.share, 3.0 / std::atan2(0.1, -4.6), 1e-6);
  const Eigen::Vector3d at = result.place.teeth.position_m;
  assert_near(std::atan2(at.y(), at.x()), 3.0, 2e-6);
}

TEST(a_machine_without_swing_does_not_turn) {
  const ProgramResult result = plan_program(test::excavator().profile, plain_request());
  assert_int_equal(result.refusal, ProgramRefusal::kNoSwing);
  assert_int_equal(result.step, 2);
}

/// Each end of a dig is raised to the clearance, and so are the steps that meet it there; nothing
/// else is, and the design is the last fence.
TEST(digging_is_raised_above_the_design) {
  ProgramRequest request = plain_request();
  request.repeats = true;
  request.has_design = true;
  request.design.through_m = {7.0, 0.0, -0.35};
  request.design.up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  request.design.clearance_m = 0.02;
  const ProgramResult result = plan(request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  const TaskProgram& program = result.program;
  const double far_m = request.design.height_m(machine().teeth(program.start).position_m);
  assert_near(far_m, 0.02, 1e-9);
  const DriveVector dug = step_motion(machine().kinematics, program.step[0], 1.0).value;
  assert_near(request.design.height_m(machine().teeth(dug).position_m), 0.02, 1e-9);
  assert_true((program.end - program.start).norm() < 1e-9);
  // By hand: 0.05 and 0.27 m too low, and the clearance over the cosine of the slope.
  const double clear_m = 0.02 * std::sqrt(1.01);
  const auto assert_raised = [&](unsigned step, double from_m, double to_m) {
    assert_near(result.note[step].raised_from_m, from_m, 1e-9);
    assert_near(result.note[step].raised_to_m, to_m, 1e-9);
  };
  assert_raised(0, 0.05 + clear_m, 0.27 + clear_m);
  assert_raised(1, 0.27 + clear_m, 0.0);
  assert_raised(2, 0.0, 0.0);
  assert_raised(3, 0.0, 0.05 + clear_m);
  assert_int_equal(program.fences.count, 1);
  assert_int_equal(program.fences.fence[0].guard, FenceGuard::kTeeth);
}

/// The last step's end is the first one's start, though the first does not dig.
TEST(what_repeats_is_raised_as_one_pose) {
  const ProgramRequest plain = plain_request();
  ProgramRequest request = plain;
  request.start = plain.step[0].to;
  request.step[0] = plain.step[1];
  request.step[1] = move_to(plain.start);
  request.step[2] = plain.step[0];
  request.step_count = 3;
  request.repeats = true;
  request.has_design = true;
  request.design.through_m = {0.0, 0.0, -0.3};
  const ProgramResult result = plan(request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  assert_near(machine().teeth(result.program.start).position_m.z(), -0.3, 1e-9);
  assert_true((result.program.start - result.program.end).norm() < 1e-9);
  assert_near(result.note[0].raised_from_m, 0.1, 1e-9);
  assert_near(result.note[0].raised_to_m, 0.0, 0.0);
}

/// A swing past a wall that the teeth pass by 20 um for less than a step of the walk.
TEST(what_is_passed_between_two_steps_is_found, ProgramRequest request) {
  const TeethPose ahead{{6.9, 0.0, 0.5}, 1.9};
  const auto turned = [&](double swing_rad) {
    TeethPose pose = ahead;
    pose.position_m.x() = 6.9 * std::cos(swing_rad);
    pose.position_m.y() = 6.9 * std::sin(swing_rad);
    return pose;
  };
  request.start = turned(-0.7);
  request.step[0] = move_to(turned(0.73));
  request.step_count = 1;
  request.fences.count = 1;
  request.fences.fence[0] = {Eigen::Vector3d::UnitX(), 6.9 - 20e-6, FenceGuard::kTeeth};
  const ProgramResult result = plan(request);
  assert_int_equal(result.refusal, ProgramRefusal::kFence);
  // Where 6.9 (1 - cos) is 19 um: the tolerance is 1.
  assert_near(result.place.share, (0.7 - std::sqrt(2.0 * 19e-6 / 6.9)) / 1.43, 1e-6);
  request.fences.fence[0].offset_m = 6.9;
  assert_int_equal(plan(request).refusal, ProgramRefusal::kNone);
}

ProgramRequest random_request(plant::Random& random, const DriveVector& start) {
  ProgramRequest request;
  request.start = machine().teeth(start);
  request.step_count = 1 + static_cast<int>(3.0 * random.uniform());
  TeethPose last = request.start;
  for (unsigned i = 0; i < static_cast<unsigned>(request.step_count); ++i) {
    if (random.uniform() < 0.5) {
      for (int axis = 0; axis < 3; ++axis) {
        last.position_m[axis] += random.symmetric(1.5);
      }
      last.attitude_rad += random.symmetric(0.5);
      request.step[i] = line_to(last);
      request.step[i].speed_mps = 0.1 + random.uniform();
    } else {
      last = machine().teeth(machine().random_drive(random));
      request.step[i] = move_to(last);
    }
  }
  request.fences = test::random_fences(machine(), random, start);
  return request;
}

/// Through the executor, all limits in the loop: inside and on the plan to the end.
void assert_replays_inside(const TaskProgram& program, bool late) {
  TaskState state = task_start(machine().profile, machine().kinematics, program, program.start);
  test::ReplayedDrives drives(program.start, late);
  for (int i = 0; i < 20000 && state.phase != TaskPhase::kDone; ++i) {
    const TaskAim aim = task_aim(machine().kinematics, program, state);
    assert_int_equal(aim.blind.kind, BlindKind::kNone);
    const DriveVector then = drives.then();
    const double error_m = (machine().teeth(then).position_m - aim.teeth.position_m).norm();
    // Half a cycle of a rising speed is asked for too late.
    assert_true(error_m < 0.02);
    const DriveVector velocity = state.pace_ratio * aim.velocity + 2.0 * (aim.value - then);
    const VelocityCap cap =
        test::motion_cap(machine().profile, machine().kinematics, program.fences, then, velocity);
    drives.ask(cap.factor * velocity);
    assert_true(test::overrun_m(machine(), program.fences, drives.value()) <= 0.5e-3);
    state = task_advance(machine().profile.line, program, state, cap.factor * kCycle_s, kCycle_s,
                         error_m);
  }
  assert_int_equal(state.phase, TaskPhase::kDone);
}

double passed_m(const ProgramResult& result, double share) {
  const TaskStep& step = result.program.step[static_cast<unsigned>(result.step)];
  const DriveMotion motion = step_motion(machine().kinematics, step, share);
  if (result.refusal == ProgramRefusal::kSwingEnd) {
    return std::abs(motion.value[kSwing]) - machine().profile.swing.left_end_rad;
  }
  const Fence& fence = result.program.fences.fence[static_cast<unsigned>(result.by.fence)];
  const MachineMotion at = machine().points(motion.value);
  double passed_m = -1e3;
  for (int k = 0; k < gap_count(fence, machine().profile.geometry.body); ++k) {
    passed_m = std::max(passed_m,
                        -fence_gap(fence, machine().profile.geometry.body, at, k, 1e3).distance_m);
  }
  return passed_m;
}

/// What is named is passed there, and nothing is before.
void assert_refused_at(const ProgramResult& result) {
  const double share = result.place.share;
  assert_true(share >= 0.0 && share <= 1.0);
  assert_near(passed_m(result, share), kBarTolerance, share > 0.0 ? 1e-9 : 1.0);
  FenceSet fences = result.program.fences;
  const TaskStep& step = result.program.step[static_cast<unsigned>(result.step)];
  for (int i = 0; i < 20; ++i) {
    const DriveVector before = step_motion(machine().kinematics, step, share * i / 20.0).value;
    assert_true(test::overrun_m(machine(), fences, before) <= 2e-5);
  }
  const DriveVector there = step_motion(machine().kinematics, step, share).value;
  assert_true((machine().teeth(there).position_m - result.place.teeth.position_m).norm() < 1e-9);
}

TEST(random_programs_stay_inside_or_say_where_not) {
  std::array<int, 8> ended{};
  int replayed = 0;
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector start = machine().random_drive(random, -0.02);
    const ProgramResult result = plan(random_request(random, start));
    ++ended[static_cast<unsigned>(result.refusal)];
    if (result.refusal == ProgramRefusal::kNone) {
      if (++replayed % 4 == 0) {
        assert_replays_inside(result.program, replayed % 8 == 0);
      }
    } else if (result.refusal == ProgramRefusal::kBlindSpot) {
      assert_int_not_equal(result.place.blind.kind, BlindKind::kNone);
      assert_in_range(result.place.blind.drive, kBoom, kSwing);
    } else {
      assert_refused_at(result);
    }
  }
  print_message("planned %d, refused for blind spots %d, fences %d, swing %d\n", ended[0], ended[3],
                ended[4], ended[5]);
  // Enough of each that the round says something.
  constexpr int kMany = kPrograms / 10;
  assert_true(ended[0] > kMany && ended[3] > kMany && ended[4] > kMany &&
              ended[5] > kPrograms / 150);
}
