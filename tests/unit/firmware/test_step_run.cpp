// SPDX-License-Identifier: Apache-2.0
/// Rounds and steps that end early: from state to state.

#include <limits>

#include "firmware/excavator/motion/dig/step_round.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"
#include "tests/unit/firmware/step_task.hpp"

using namespace graben::test;

/// Each round digs the offset deeper; what the digs do not meet stays; then it is done, and stands
/// where the last round began.
TEST(each_round_digs_deeper) {
  Exact run(in_rounds(3));
  for (int round = 0; round < 3; ++round) {
    assert_int_equal(run.state.round, round);
    const double depth_m = kTop_m - 0.1 * round;
    run.run_step([&](const TeethPose& teeth) { assert_near(teeth.position_m.z(), depth_m, 1e-9); });
    assert_near(aim_of(run.program, run.state).teeth.position_m.z(), depth_m, 1e-9);
    run.run_step();
    assert_near(aim_of(run.program, run.state).teeth.position_m.z(), 1.4, 1e-9);
    assert_false(run.state.off_plan);
    run.run_step();
  }
  assert_int_equal(run.state.phase, TaskPhase::kDone);
  const TaskAim stands = aim_of(run.program, run.state);
  assert_near(stands.teeth.position_m.z(), kTop_m - 0.2, 1e-9);
  assert_near(stands.teeth.position_m.x(), 7.0, 1e-9);
  run.step();
  assert_int_equal(run.state.phase, TaskPhase::kDone);
}

/// As many rounds as bring the dig to the clearance, and no round below it.
TEST(rounds_end_at_the_design) {
  ProgramRequest request = in_rounds(0);
  request.rounds.to_design = true;
  // From -0.1 m to 0.05 m over -0.5: 0.35 m in steps of 0.1 are four after the first.
  with_design(-0.5, request);
  Exact run(request);
  assert_int_equal(run.program.rounds.count, 5);
  for (const double depth_m : {-0.1, -0.2, -0.3, -0.4, -0.45}) {
    run.run_step([&](const TeethPose& teeth) { assert_near(teeth.position_m.z(), depth_m, 1e-9); });
    run.run_step();
    run.run_step();
  }
  assert_int_equal(run.state.phase, TaskPhase::kDone);
  // What leads past nothing, upwards, needs too many, or has no design.
  const auto refusal = [](const ProgramRequest& asked) { return plan(asked).refusal; };
  request.rounds.offset_m = {0.1, 0.0, 0.0};
  assert_int_equal(refusal(request), ProgramRefusal::kRounds);
  request.rounds.offset_m = {0.0, 0.0, -0.002};
  assert_int_equal(refusal(request), ProgramRefusal::kRounds);
  request.rounds.offset_m = {0.0, 0.0, -0.1};
  request.has_design = false;
  assert_int_equal(refusal(request), ProgramRefusal::kRounds);
  assert_int_equal(refusal(in_rounds(kRoundsMost + 1)), ProgramRefusal::kRounds);
  ProgramRequest open = in_rounds(2);
  open.repeats = false;
  open.step[2].to.position_m.x() = 6.5;
  assert_int_equal(refusal(open), ProgramRefusal::kRounds);
}

/// Every round is looked at before anything moves: with fences, and where the machine ends.
TEST(later_rounds_are_refused_with_their_number) {
  ProgramRequest fenced = in_rounds(4);
  fenced.fences.count = 1;
  fenced.fences.fence[0] = {-Eigen::Vector3d::UnitZ(), 0.32, FenceGuard::kMachine};
  const ProgramResult floor = plan(fenced);
  assert_int_equal(floor.refusal, ProgramRefusal::kFence);
  assert_true(floor.round >= 1 && floor.round <= 3);
  fenced.rounds.count = floor.round;
  assert_int_equal(plan(fenced).refusal, ProgramRefusal::kNone);
  ProgramRequest deep = in_rounds(50);
  const ProgramResult reach = plan(deep);
  assert_int_equal(reach.refusal, ProgramRefusal::kBlindSpot);
  deep.rounds.count = reach.round;
  assert_true(reach.round > 5);
  assert_int_equal(plan(deep).refusal, ProgramRefusal::kNone);
}

ProgramRequest until(const StepUntil& until) {
  ProgramRequest request = dig_and_lift();
  request.step[0].until = until;
  return request;
}

/// It comes to rest at the plane, and the lift leads on from there as a line.
TEST(a_plane_ends_a_step_where_it_is) {
  Exact run(until({UntilKind::kPlane, 0.0, -Eigen::Vector3d::UnitX(), -6.0}));
  double x_m = 0.0;
  run.run_step([&](const TeethPose& teeth) { x_m = teeth.position_m.x(); });
  assert_near(x_m, 6.0, 0.01);
  assert_int_equal(run.state.step, 1);
  assert_int_equal(run.state.last_end, UntilKind::kPlane);
  assert_true(run.state.off_plan && !run.state.cut_short);
  const Eigen::Vector3d from_m = aim_of(run.program, run.state).teeth.position_m;
  const Eigen::Vector3d to_m(4.9, 0.0, 1.4);
  assert_near((from_m - Eigen::Vector3d(6.0, 0.0, kTop_m)).norm(), 0.0, 0.01);
  run.run_step([&](const TeethPose& teeth) {
    const Eigen::Vector3d along = (to_m - from_m).normalized();
    assert_true((teeth.position_m - from_m).cross(along).norm() < 1e-6);
  });
  // Where the lift has ended the return begins as planned.
  assert_false(run.state.off_plan);
  assert_int_equal(run.state.last_end, UntilKind::kEnd);
}

/// A force has to last, and to be known.
TEST(a_force_ends_a_step_that_it_holds) {
  const double most_n = 20e3;
  const auto ends_after = [&](double force_n, bool known, int cycles) {
    Exact run(until({UntilKind::kForce, most_n}));
    run.state.time_s = 3.0;
    run.force_known = known;
    run.force_n = force_n * Eigen::Vector2d(0.6, -0.8);
    repeat(cycles, [&] { run.step(); });
    return run.state.ends == UntilKind::kForce || run.state.step == 1;
  };
  assert_true(ends_after(1.01 * most_n, true, 22));
  assert_false(ends_after(1.01 * most_n, true, 18));
  assert_false(ends_after(0.99 * most_n, true, 200));
  assert_false(ends_after(9.0 * most_n, false, 200));
  // One that comes and goes does not.
  Exact run(until({UntilKind::kForce, most_n}));
  run.state.time_s = 3.0;
  for (int n = 0; n < 200; ++n) {
    run.force_n = {n % 15 == 0 ? 0.0 : 2.0 * most_n, 0.0};
    run.step();
    assert_int_equal(run.state.ends, UntilKind::kEnd);
  }
}

/// What the edge has passed, by the ground that it has left; a round that the bucket's fill has cut
/// short is done again at its depth until it is through.
TEST(a_full_bucket_ends_a_dig_and_its_round_is_done_again) {
  ProgramRequest request = in_rounds(2);
  const ExcavatorBody& body = profile().geometry.body;
  // The dig is 2.2 m long and 0.1 m deep: of 0.22 m3 a bucket that takes 0.13 is full on its way.
  const double volume_m3 = 2.2 * 0.1 * body.bucket_width_m;
  request.step[0].until = {UntilKind::kFull, 0.6 * volume_m3 * kSwell / body.capacity_m3};
  Exact run(request);
  double x_m = 0.0;
  const auto follow = [&](const TeethPose& teeth) { x_m = teeth.position_m.x(); };
  run.run_step(follow);
  assert_int_equal(run.state.last_end, UntilKind::kFull);
  // Six tenths of the way, to a bin, and what it takes to come to rest.
  assert_in_range(static_cast<int>(1e3 * x_m), 5480, 5690);
  run.run_step();
  run.run_step();
  assert_int_equal(run.state.round, 0);
  assert_int_equal(run.state.again, 1);
  // Its first part is air by now: it goes through.
  run.run_step(follow);
  assert_int_equal(run.state.last_end, UntilKind::kEnd);
  assert_near(x_m, 4.8, 1e-6);
  run.run_step();
  run.run_step();
  assert_int_equal(run.state.round, 1);
  assert_int_equal(run.state.again, 0);
}

/// What a dig never gets through stays up after so many tries.
TEST(a_round_is_not_done_again_for_ever) {
  ProgramRequest request = in_rounds(2);
  request.step[0].until = {UntilKind::kForce, 20e3};
  Exact run(request);
  int rounds = 0;
  while (run.state.phase == TaskPhase::kSteps) {
    run.force_n = run.state.step == 0 ? Eigen::Vector2d(30e3, 0.0) : Eigen::Vector2d::Zero();
    run.run_step();
    rounds += run.state.step == 0 || run.state.phase == TaskPhase::kDone ? 1 : 0;
    assert_true(rounds < 50);
  }
  assert_int_equal(rounds, 2 * (1 + kAgainMost));
}

/// What follows an early end is looked at from all along the line.
TEST(what_follows_an_early_end_is_refused_at_planning) {
  ProgramRequest request = until({UntilKind::kForce, 20e3});
  // The lift from the line's end stays clear of this box; one from its beginning would pass it.
  request.step[1].to.position_m = {4.9, 0.0, 3.0};
  request.step_count = 2;
  request.repeats = false;
  request.fences.count = 1;
  Fence& box = request.fences.fence[0];
  box.shape = FenceShape::kBox;
  box.normal = Eigen::Vector3d::UnitX();
  box.centre_m = {6.4, 0.0, 2.4};
  box.half_m = {0.15, 1.0, 0.15};
  ProgramRequest plain = request;
  plain.step[0].until = {};
  // Guarded as lines: a bucket with its width and floor takes the way that is left.
  const auto of_points = [](const ProgramRequest& asked) {
    return plan_program(steps_machine().profile, asked);
  };
  assert_int_equal(of_points(plain).refusal, ProgramRefusal::kNone);
  const ProgramResult with = of_points(request);
  assert_int_equal(with.refusal, ProgramRefusal::kFence);
  assert_int_equal(with.step, 1);
  assert_true(with.early_share >= 0.0 && with.early_share < 1.0);
}

TEST(numbers_that_say_nothing_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto bad = [](const ProgramRequest& request) {
    return plan(request).refusal == ProgramRefusal::kBadRequest;
  };
  assert_true(bad(until({UntilKind::kForce, nan})));
  assert_true(bad(until({UntilKind::kForce, 0.0})));
  assert_true(bad(until({UntilKind::kPlane, 0.0, {1.0, 1.0, 0.0}, 1.0})));
  assert_true(bad(until({UntilKind::kPlane, 0.0, Eigen::Vector3d::UnitX(), nan})));
  ProgramRequest two = until({UntilKind::kFull, 0.5});
  assert_false(bad(two));
  two.step[1].kind = StepKind::kDig;
  two.step[1].until = two.step[0].until;
  assert_true(bad(two));
  ProgramRequest move = dig_and_lift();
  move.step[2].until = {UntilKind::kForce, 1e4};
  assert_true(bad(move));
  ProgramRequest offset = in_rounds(2);
  offset.rounds.offset_m.x() = nan;
  assert_true(bad(offset));
}
