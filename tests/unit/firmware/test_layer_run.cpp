// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_run.hpp"

#include <algorithm>

#include "tests/unit/firmware/layer_machine.hpp"

using namespace graben::layer_test;

/// No jump of the aim, no place that the machine can't have, nothing below the line.
TEST(digs_down_to_its_design) {
  const TaskProgram program = planned();
  TaskState state = begun(program);
  const double speed_most_mps = 3.0;
  DriveVector last = task_aim(machine().kinematics, program, state).value;
  double lowest_m = 1.0;
  for (int n = 0; state.phase != TaskPhase::kDone; ++n) {
    assert_true(n < 200000);
    state = advance(program, state, follows(program, state));
    const TaskAim aim = task_aim(machine().kinematics, program, state);
    assert_int_equal(aim.blind.kind, BlindKind::kNone);
    assert_true((aim.value - last).cwiseAbs().maxCoeff() < speed_most_mps * kCycle_s);
    last = aim.value;
    lowest_m = std::min(lowest_m, aim.teeth.position_m.z());
  }
  assert_true(state.dug.cuts.met);
  assert_near(lowest_m, kDesign_m + 0.012, 2e-3);
}

/// The aim's velocity is what its place changes by.
TEST(aims_move_as_they_say) {
  const TaskProgram program = planned();
  TaskState state = begun(program);
  int looked = 0;
  for (int n = 0; n < 6000; ++n) {
    const TaskState next = advance(program, state, follows(program, state));
    if (in_cut(state) && in_cut(next) && state.dig.share > 0.3 && next.dig.share < 0.6) {
      const TaskAim now = task_aim(machine().kinematics, program, next);
      const DriveVector before = task_aim(machine().kinematics, program, state).value;
      const DriveVector said = next.pace_ratio * now.velocity + now.at_once;
      assert_true(((now.value - before) / kCycle_s - said).norm() < 0.02);
      ++looked;
    }
    state = next;
  }
  assert_true(looked > 50);
}

TEST(a_heavy_cut_gives_way_upwards) {
  const TaskProgram program = planned();
  const TaskState state = cut_beyond(program, 0.4);
  const TaskState heavy = pressed(program, state, 50, {1.3, 0.0});
  assert_true(heavy.dig.height_m > state.dig.height_m + 0.02);
  assert_true(heavy.dig.heavy_s > 0.5);
  // Held for a second it ends, is lifted, and the next cuts are less deep.
  const TaskState ended = pressed_out(program, heavy, 200, {1.6, 0.0});
  assert_true(ended.dug.cuts.depth_m < state.dug.cuts.depth_m);
}

TEST(a_force_along_the_way_holds_nothing_up) {
  const TaskProgram program = planned();
  const TaskState state = cut_beyond(program, 0.3);
  const TaskState pushed = pressed(program, state, 50, {-2.0, 0.0});
  assert_near(pushed.dig.height_m, state.dig.height_m, 5e-3);
}

/// Teeth that do not come down are not pressed on by a plan far below them.
TEST(soil_that_holds_the_edge_up_is_cut_from_there) {
  const TaskProgram program = planned();
  TaskState state = enters_below(program, 0.55);
  const TeethPose held = task_aim(machine().kinematics, program, state).teeth;
  for (int n = 0; n < 300 && !in_cut(state); ++n) {
    CutSeen seen;
    seen.teeth = held;
    const TeethPose aim = task_aim(machine().kinematics, program, state).teeth;
    seen.behind_m = (held.position_m - aim.position_m).norm();
    state = advance(program, state, seen);
    assert_true(seen.behind_m < 0.13);
  }
  assert_true(in_cut(state));
  assert_true(state.dig.give_m > 0.0);
}

/// A platform that still swings about its place is waited for, over the ground.
TEST(teeth_off_to_a_side_do_not_end_the_way_down) {
  const TaskProgram program = planned();
  TaskState state = enters_below(program, 0.7);
  for (int n = 0; n < 300; ++n) {
    CutSeen seen = follows(program, state);
    seen.teeth.position_m.y() += 0.12;
    seen.behind_m = 0.12;
    state = advance(program, state, seen);
    assert_int_equal(state.dig.phase, CutPhase::kEnters);
  }
  state = run_until(program, state, in_cut);
  assert_near(state.dig.give_m, 0.0, 0.01);
}

/// Oil that is pressed lets off before the edge goes along: it would throw it down.
TEST(pressed_oil_lets_off_before_a_cut) {
  const TaskProgram program = planned();
  TaskState state = enters_below(program, 0.6);
  const double presses_n = 0.03 / program.layers.give_down_mpn;
  bool eased = false;
  for (int n = 0; n < 400 && !in_cut(state); ++n) {
    CutSeen seen = follows(program, state);
    const TeethPose stands = seen.teeth;
    seen.force_n = {0.0, eased && n % 400 > 0 && state.dig.height_m > state.dig.stood_m + 0.03
                             ? 0.0
                             : presses_n};
    if (state.dig.eases) {
      // The ground does not push: the teeth stay while their oil lets off.
      seen.teeth.position_m.z() =
          std::min(stands.position_m.z(), kDesign_m + 0.012 + state.dig.stood_m);
    }
    eased = eased || state.dig.eases;
    state = advance(program, state, seen);
  }
  assert_true(eased);
  assert_true(in_cut(state));
  assert_false(state.dig.eases);
  // The plan goes on from where the teeth are.
  assert_near(state.dig.height_m, state.dig.stood_m, 0.012);
}

/// A heel that is pressed on uncut ground is as heavy as soil before the edge.
TEST(a_pressed_heel_gives_way_too) {
  const TaskProgram program = planned();
  const TaskState state = cut_beyond(program, 0.6);
  const TaskState borne = pressed(program, state, 50, {0.0, 2.0});
  assert_true(borne.dig.height_m > state.dig.height_m + 0.02);
}

/// Of the last cut: teeth under their plan slow it down more than teeth over it, and at once.
TEST(a_last_cut_waits_for_teeth_that_sink) {
  const TaskProgram program = planned();
  const TaskState state = run_until(program, begun(program), [](const TaskState& at) {
    return in_cut(at) && at.dug.cuts.cut.thin && at.dig.share > 0.5;
  });
  const auto pace_with = [&](double off_m) {
    const auto off = [off_m](CutSeen& seen) {
      seen.teeth.position_m.z() += off_m;
      seen.behind_m = 0.012;
    };
    return advance_seeing(program, state, 15, off).pace_ratio;
  };
  assert_true(pace_with(-0.012) < 0.5);
  assert_true(pace_with(0.012) > 0.7);
}

/// For 60 cycles, without getting on.
TaskState held_at(const TaskProgram& program, const TaskState& state, const TeethPose& held) {
  return advance_seeing(program, state, 60, [&held](CutSeen& seen) {
    seen.teeth = held;
    seen.lambda = 0.0;
  });
}

/// In the slot that it has gone down in, the bucket is lifted the way that it has come.
TEST(teeth_in_their_slot_go_back_as_they_came) {
  const TaskProgram program = planned();
  TaskState state = pressed_out(program, cut_beyond(program, 0.05), 300, {2.0, 0.0});
  const TeethPose held = task_aim(machine().kinematics, program, state).teeth;
  state = held_at(program, state, held);
  const TeethPose freed = state.dig.lift.line.at(1.0);
  const TeethPose& entered = state.dig.entered;
  assert_near(freed.attitude_rad, entered.attitude_rad, 1e-6);
  assert_near((freed.position_m - entered.position_m).head<2>().norm(), 0.0, 1e-6);
  assert_true(freed.position_m.z() > held.position_m.z() + 0.3);
}

/// Nobody has looked at fences there.
TEST(begins_beyond_its_line_where_nothing_is_fenced) {
  TaskProgram program = planned();
  const auto begins_m = [&] {
    Cut cut = undug(program.layers).cut;
    cut.height_m = 0.0;
    begin_beyond(machine().kinematics, program, cut);
    return cut.from_share * program.layers.way_m;
  };
  assert_true(begins_m() < -0.05 && begins_m() > -0.5 - 1e-9);
  program.fences.fence[1] = program.fences.fence[0];
  program.fences.count = 2;
  assert_near(begins_m(), 0.0, 0.0);
}

/// A heel on uncut ground holds a bucket that is to be folded: it is lifted straight up first.
TEST(a_held_heel_is_lifted_straight_up) {
  const TaskProgram program = planned();
  TaskState state = folding(program);
  const TeethPose held = task_aim(machine().kinematics, program, state).teeth;
  state = held_at(program, state, held);
  assert_int_equal(state.dig.phase, CutPhase::kLifts);
  const TeethPose& change = state.dig.lift.line.change;
  assert_near(change.attitude_rad, 0.0, 1e-9);
  assert_true(change.position_m.z() > 0.2);
  state = run_until(program, state, [](const TaskState& at) { return at.step == 1; });
  assert_true(task_aim(machine().kinematics, program, state).teeth.attitude_rad < 0.45);
}

/// Where the first way is beyond what the machine can, the next one is looked at in the next cycle;
/// it ends with the way that lift_line() finds at once.
TEST(a_lift_tries_one_way_a_cycle_and_stands_meanwhile) {
  const TaskProgram program = planned();
  const TaskState cut = cut_beyond(program, 0.5);
  int waited = 0;
  int found = 0;
  for (double x_m = 3.0; x_m < 8.5; x_m += 0.25) {
    for (double z_m = -1.0; z_m < 5.0; z_m += 0.25) {
      CutSeen seen = follows(program, cut);
      seen.teeth = {{x_m, 0.0, z_m}, 1.0};
      const DigCycle cycle{
          machine().profile, machine().kinematics, program, kCycle_s, kCycle_s, seen};
      TaskState state = cut;
      enter_phase<LiftPhase>(cycle, state.step, state);
      unsigned cycles = 1;
      for (; state.dig.tries > 0; ++cycles) {
        const TeethPose aim = task_aim(machine().kinematics, program, state).teeth;
        assert_near((aim.position_m - seen.teeth.position_m).norm(), 0.0, 1e-12);
        assert_false(LiftPhase::go_on(cycle, state));
        assert_near(state.time_s, 0.0, 0.0);
      }
      assert_true(cycles <= kLiftTries);
      const LinePlan at_once = lift_line(machine().profile, machine().kinematics, program.layers,
                                         seen.teeth, LiftPart::kFolds);
      assert_near(state.dig.lift.way_m, at_once.way_m, 0.0);
      assert_near(state.dig.lift.line.change.attitude_rad, at_once.line.change.attitude_rad, 0.0);
      waited += cycles > 1 ? 1 : 0;
      found += cycles > 1 && at_once.way_m > 0.0 ? 1 : 0;
    }
  }
  assert_true(found > 0);
  assert_true(waited > found);
}

TEST(a_full_bucket_ends_the_cut) {
  const TaskProgram program = planned();
  const TaskState state = run_until(program, begun(program), [](const TaskState& at) {
    return at.dig.phase == CutPhase::kLifts;
  });
  const double full_m3 = program.layers.full_m3;
  assert_true(state.dug.cuts.loaded_m3 > 0.95 * full_m3);
  assert_true(state.dug.cuts.loaded_m3 < 1.2 * full_m3);
}

/// The bucket comes out of the ground folded in, before it swings.
TEST(lifts_out_before_it_swings) {
  const TaskProgram program = planned();
  TaskState state = lifted(program);
  const TaskAim aim = task_aim(machine().kinematics, program, state);
  assert_true(aim.teeth.position_m.z() > 0.3);
  assert_true(aim.teeth.attitude_rad < 0.45);
  state = run_until(program, state, [](const TaskState& at) {
    return at.phase == TaskPhase::kSteps && at.step == 2;
  });
  assert_true(swing_of(task_aim(machine().kinematics, program, state).value) > 0.5);
}

/// What was dug is known when the task goes on, however long it has rested, and forgotten when it
/// has come to its end.
TEST(goes_on_where_it_was) {
  const TaskProgram program = planned();
  TaskState state = lifted(program);
  state.dug.touched = true;
  state.dug.zero_m = 0.02;
  TaskMemory rests = remembered(0, state);
  repeat(100, [&] {
    rests = stopped(rests);
    assert_false(rests.runs);
    assert_true(rests.state.dug.begun);
    assert_true(rests.state.dug.cuts.height_m == state.dug.cuts.height_m);
    assert_true(rests.state.dug.touched);
    assert_near(rests.state.dug.zero_m, 0.02, 0.0);
  });
  TaskState done = state;
  done.phase = TaskPhase::kDone;
  assert_false(stopped(remembered(0, done)).state.dug.begun);
}

TEST(what_can_t_be_dug_in_layers_is_refused) {
  const auto assert_refused = [](ProgramRefusal refusal, void (*change)(ProgramRequest&)) {
    ProgramRequest asked = request();
    change(asked);
    assert_int_equal(plan_program(machine().profile, asked).refusal, refusal);
  };
  using Request = ProgramRequest;
  assert_refused(ProgramRefusal::kLayers, [](Request& asked) { asked.has_design = false; });
  assert_refused(ProgramRefusal::kLayers, [](Request& asked) { asked.repeats = false; });
  assert_refused(ProgramRefusal::kSwingEnd, [](Request& asked) {
    asked.step[0].strips = 3;
    asked.step[0].strip_rad = 3.5;
  });
  assert_refused(ProgramRefusal::kLayers,
                 [](Request& asked) { asked.step[0].strips = kStripMost + 1; });
  assert_refused(ProgramRefusal::kBlindSpot, [](Request& asked) { asked.step[0].ground_m = 9.0; });
}
