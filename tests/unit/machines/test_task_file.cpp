// SPDX-License-Identifier: Apache-2.0
#include "app/machines/task_file.hpp"

#include <cmath>

#include "app/machines/task_text.hpp"
#include "tests/unit/machines/written_task.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::test;

TEST(the_paper_s_line) {
  const machines::TaskFile task =
      machines::load_task(machines::find_task("flatten"), profile("excavator_12t"));
  assert_string_equal(task.name.c_str(), "flatten");
  const TaskProgram& program = task.result.program;
  assert_int_equal(program.step_count, 1);
  assert_false(program.repeats);
  assert_true(program.step[0].straight);
  assert_int_equal(program.step[0].kind, StepKind::kDig);
  assert_near(program.step[0].duration_s(), 18.4, 0.0);
  assert_near(program.step[0].line.way_m, 3.7304, 1e-4);
}

TEST(loading_a_truck) {
  const machines::TaskFile task =
      machines::load_task(machines::find_task("truck_by_steps"), profile("excavator_12t"));
  const TaskProgram& program = task.result.program;
  assert_int_equal(program.step_count, 5);
  assert_true(program.repeats);
  constexpr std::array<StepKind, 5> kKinds = {StepKind::kDig, StepKind::kLift, StepKind::kSwing,
                                              StepKind::kDump, StepKind::kReturnToDig};
  double whole_s = 0.0;
  for (unsigned i = 0; i < kKinds.size(); ++i) {
    assert_int_equal(program.step[i].kind, kKinds[i]);
    assert_int_equal(program.step[i].straight, i < 2);
    whole_s += program.step[i].duration_s();
    print_message("%s %.2f s, slowed %.2f\n", machines::step_name(kKinds[i]),
                  program.step[i].duration_s(), task.result.note[i].slowed_ratio);
  }
  assert_true(whole_s > 15.0 && whole_s < 40.0);
  assert_near(program.step[2].drives.change[kSwing], 1.5707963, 1e-6);
  assert_int_equal(program.fences.count, 4);
  assert_near(program.fences.fence[0].offset_m, 6.5, 0.0);
  assert_near(program.fences.fence[1].offset_m, 0.8, 0.0);
  assert_near(program.fences.fence[2].normal.y(), 1.0, 0.0);
  assert_int_equal(program.fences.fence[3].guard, FenceGuard::kTeeth);
  assert_string_equal(machines::fence_name(task.request, 2).c_str(), "fence[2], the wall");
  assert_string_equal(machines::fence_name(task.request, 3).c_str(), "the design surface");
}

/// Everything that is wrong at once, each with key, line, value, unit and what is allowed.
TEST(every_error_is_listed) {
  const std::string errors = errors_of(
      "start = { position = [7.0, 0.0], attitude = 9.0 }\n"
      "repeat = 1\n"
      "colour = \"red\"\n"
      "[[step]]\n"
      "do = \"dance\"\n"
      "to = { position = [4.8, 0.0, 99.0] }\n"
      "speed = 0.4\n"
      "duration = 5.0\n"
      "[[step]]\n"
      "do = \"swing\"\n"
      "path = \"spiral\"\n"
      "to = { position = [0.0, 6.0, 2.0], attitude = 0.5 }\n"
      "speed = 9.0\n"
      "[[fence]]\n"
      "kind = \"wall\"\n"
      "through = [0.0, 7.0]\n"
      "normal = [0.0, 0.0]\n"
      "[design]\n"
      "through = [0.0, 0.0, 0.0]\n"
      "normal = [1.0, 0.0, 0.0]\n"
      "clearance = -1.0\n");
  for (const char* said :
       {"start.position (line 1): must be an array of 3 numbers; allowed: -30 .. 30 m",
        "start.attitude (line 1): 9.0 is out of range; allowed: -7 .. 7 rad",
        "repeat (line 2): 1; allowed: true, false", "colour (line 3): unknown key",
        "step[0].do (line 5): 'dance'; allowed: dig, lift, swing, dump, return, wait",
        "step[0].to.position[2] (line 6): 99.0 is out of range; allowed: -30 .. 30 m",
        "step[0].to.attitude: missing",
        "step[0] (line 4): has a speed and a duration; allowed: one of them",
        "step[1].path (line 11): 'spiral'; allowed: line, drives",
        "step[1].speed (line 13): 9.0 is out of range; allowed: 0.01 .. 3 m/s",
        "fence[0].normal (line 17): has no direction", "design.normal (line 20): must point up",
        "design.clearance (line 21): -1.0 is out of range; allowed: 0.03 .. 1 m"}) {
    assert_says(errors, said);
  }
}

const char* const kKeepOuts =
    "start = { position = [7.0, 0.0, -0.4], attitude = 2.2 }\n"
    "[[step]]\n"
    "do = \"dig\"\n"
    "to = { position = [4.8, 0.0, -0.4], attitude = 0.9 }\n"
    "[[fence]]\n"
    "kind = \"box\"\n"
    "centre = [2.0, 5.0]\n"
    "size = [1.0, 3.0]\n"
    "turn = 0.5\n"
    "heights = [-1.0, 2.0]\n"
    "[[fence]]\n"
    "kind = \"cylinder\"\n"
    "centre = [0.0, -6.0]\n"
    "radius = 0.3\n"
    "heights = [0.0, 4.0]\n";

TEST(boxes_and_cylinders_are_kept_out_of) {
  const Written file(kKeepOuts);
  const FenceSet fences = machines::load_task(file.path(), profile("excavator_12t")).request.fences;
  assert_int_equal(fences.count, 2);
  const Fence& box = fences.fence[0];
  assert_int_equal(box.shape, FenceShape::kBox);
  assert_true((box.centre_m - Eigen::Vector3d(2.0, 5.0, 0.5)).norm() < 1e-12);
  assert_true((box.half_m - Eigen::Vector3d(0.5, 1.5, 1.5)).norm() < 1e-12);
  assert_true((box.normal - Eigen::Vector3d(std::cos(0.5), std::sin(0.5), 0.0)).norm() < 1e-12);
  const Fence& cylinder = fences.fence[1];
  assert_int_equal(cylinder.shape, FenceShape::kCylinder);
  assert_true((cylinder.half_m - Eigen::Vector3d(0.3, 0.3, 2.0)).norm() < 1e-12);
  const auto wrong = [](const std::string& from, const std::string& to) {
    std::string text = kKeepOuts;
    return errors_of(text.replace(text.find(from), from.size(), to));
  };
  assert_says(wrong("[-1.0, 2.0]", "[2.0, -1.0]"),
              "fence[0].heights (line 10): [2, -1] m; allowed: lower, then upper end");
  assert_says(wrong("radius = 0.3", "radius = 0.01"),
              "fence[1].radius (line 14): 0.01 is out of range; allowed: 0.05 .. 30 m");
  assert_says(wrong("kind = \"box\"", "kind = \"ball\""),
              "'ball'; allowed: ceiling, floor, wall, box, cylinder");
  assert_says(wrong("centre = [2.0, 5.0]", "centre = [5.0, 0.5]"),
              "would pass fence[0], the box at 5.00, 0.50 m, by ");
}

/// A pace on a line, a speed on a move of the drives: keys that nothing asks for.
TEST(a_pace_of_the_other_form_is_unknown) {
  assert_says(errors_of(edited("flatten", "duration = 18.4", "pace = 0.5")),
              "step[0].pace (line 9): unknown key");
  assert_says(errors_of(edited("flatten", "duration = 18.4", "path = \"drives\"\nspeed = 0.5")),
              "step[0].speed (line 10): unknown key");
  assert_true(errors_of(edited("flatten", "duration = 18.4", "")).empty());
  assert_says(errors_of("start = { position = [7.0, 0.0, 0.0], attitude = 2.0 }\n"),
              "step: must be 1 to 24 tables; there are 0");
}

/// What can't be planned says which step, what is in the way and where.
TEST(refusals_name_step_joint_and_place) {
  assert_says(
      errors_of(edited("flatten", "[2.244, 3.886, 0.0]", "[9.0, 3.886, 0.0]")),
      "step[0] (line 6): step 0 (dig): the arm cylinder would have to go beyond its closed end");
  const std::string reach =
      errors_of(edited("truck_by_steps", "[4.9, 0.0, 2.4]", "[9.9, 0.0, 2.4]"));
  assert_says(reach, "step 1 (lift): ");
  assert_says(reach, "% of the step, teeth x ");
  const std::string ceiling = errors_of(edited("truck_by_steps", "height = 6.5", "height = 4.0"));
  assert_says(ceiling, "(lift): the arm's pin would pass fence[0], the ceiling at 4.00 m, by ");
  assert_says(ceiling, " mm at 100.00 % of the step, where the margin is ");
  assert_says(ceiling, " mm; beginning at ");
  const std::string wall = errors_of(edited("truck_by_steps", "[0.0, 7.5]", "[0.0, 6.35]"));
  assert_says(wall, "(return): the heel's left corner would come near fence[2], the wall, to ");
  const std::string floor = errors_of(edited("truck_by_steps", "height = -0.8", "height = -0.5"));
  assert_says(floor,
              "step 0 (dig): the edge's left corner would come near fence[1], the floor at "
              "-0.50 m, to 50 mm at ");
  const std::string design = errors_of(
      edited("truck_by_steps", "through = [0.0, 0.0, -0.5]", "through = [0.0, 0.0, 2.5]"));
  assert_says(design, "the design surface");
  const std::string open =
      errors_of(edited("truck_by_steps", "[7.0, 0.0, -0.45], attitude = 2.2 }\n\n[[step]]",
                       "[6.9, 0.0, -0.45], attitude = 2.2 }\n\n[[step]]"));
  assert_says(open, "step 4 (return): the task repeats, but does not end where it starts");
  assert_says(errors_of(shipped("flatten"), "excavator_22t"), "this machine's swing is held");
  assert_says(errors_of("start = { position = [6.0, 0.0, 0.0], attitude = 2.0 }\n[[step]]\n"
                        "do = \"swing\"\nto = { position = [-6.0, 0.1, 0.0], attitude = 2.0 }\n"),
              "the swing would leave its range, -3 .. 3 rad; at ");
}

const char* const kRounds =
    "repeat = true\n"
    "start = { position = [7.0, 0.0, -0.1], attitude = 2.2 }\n"
    "ground = -0.05\n"
    "rounds = { count = 3, offset = [0.0, 0.0, -0.1] }\n"
    "[[step]]\n"
    "do = \"dig\"\n"
    "to = { position = [4.8, 0.0, -0.3], attitude = 0.9 }\n"
    "until = { depth = 0.1 }\n"
    "[[step]]\n"
    "do = \"wait\"\n"
    "[[step]]\n"
    "do = \"lift\"\n"
    "to = { position = [4.9, 0.0, 1.4], attitude = 0.3 }\n"
    "[[step]]\n"
    "do = \"return\"\n"
    "path = \"line\"\n"
    "to = { position = [7.0, 0.0, -0.1], attitude = 2.2 }\n"
    "[design]\n"
    "through = [0.0, 0.0, -0.7]\n"
    "normal = [0.0, 0.0, 1.0]\n"
    "clearance = 0.05\n";

std::string rounds_text(const std::string& from, const std::string& to) {
  std::string text = kRounds;
  assert_true(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

std::string rounds_with(const std::string& from, const std::string& to) {
  return errors_of(rounds_text(from, to));
}

TEST(steps_end_early_and_rounds_repeat) {
  const Written file(kRounds);
  const TaskProgram program =
      machines::load_task(file.path(), profile("excavator_12t")).result.program;
  assert_int_equal(program.rounds.count, 3);
  assert_near(program.rounds.offset_m.z(), -0.1, 0.0);
  assert_near(program.ground_m, -0.05, 0.0);
  const StepUntil& until = program.step[0].until;
  assert_int_equal(until.kind, UntilKind::kPlane);
  assert_near(until.normal.z(), -1.0, 0.0);
  assert_near(until.offset_m, 0.15, 1e-12);
  assert_int_equal(program.step[1].kind, StepKind::kWait);
  assert_int_equal(program.step[1].until.kind, UntilKind::kEnd);
  const Written to_design(
      rounds_text("count = 3, offset = [0.0, 0.0, -0.1]", "until_design = true, deeper = 0.12"));
  const TaskProgram deeper =
      machines::load_task(to_design.path(), profile("excavator_12t")).result.program;
  // The far end is 0.55 m over the clearance.
  assert_int_equal(deeper.rounds.count, 1 + 5);
  assert_near(deeper.rounds.offset_m.z(), -0.12, 1e-12);
}

/// Each with its place and what is allowed.
TEST(what_ends_a_step_or_a_round_is_checked) {
  const std::string depth = "depth = 0.1";
  assert_says(rounds_with(depth, "depth = 0.01"),
              "step[0].until.depth (line 8): 0.01 is out of range; allowed: 0.02 .. 8 m");
  assert_says(rounds_with(depth, "force = 10.0"),
              "step[0].until.force (line 8): 10.0 is out of range; allowed: 1000 .. 1000000 N");
  assert_says(rounds_with(depth, "full = 2.0"),
              "step[0].until.full (line 8): 2.0 is out of range; allowed: 0.2 .. 1.2");
  assert_says(rounds_with(depth, "full = 0.9, force = 2e4"),
              "step[0].until (line 8): 2 of its keys; allowed: one of full, force, depth, plane");
  assert_says(rounds_with(depth, "heavy = true"), "0 of its keys");
  assert_says(rounds_with(depth, "heavy = true"), "step[0].until.heavy (line 8): unknown key");
  assert_says(rounds_with(depth, "depth = 0.04"),
              "step[0].until (line 8): the step begins 10 mm beyond the plane");
  assert_says(rounds_with(depth, "depth = 0.7"), "the step's end is still 250 mm before the plane");
  assert_says(rounds_with("do = \"dig\"\n", "do = \"dig\"\npath = \"drives\"\n"),
              "step[0].until (line 9): ends a line of the teeth; this step is a move");
  assert_says(rounds_with("until = { depth = 0.1 }\n[[step]]\ndo = \"wait\"",
                          "[[step]]\ndo = \"wait\"\nto = 3"),
              "step[1].to (line 10): unknown key");
  assert_says(rounds_with("count = 3, ", ""), "rounds (line 4): needs one of count and");
  assert_says(rounds_with("count = 3", "count = 3, until_design = true"), "needs one of count and");
  assert_says(rounds_with("count = 3", "count = 51"), "allowed: 1 .. 50");
  assert_says(rounds_with("count = 3", "count = 3, deeper = 0.1"), "allowed: one of them");
  assert_says(rounds_with("repeat = true\n", ""), "allowed: with repeat = true");
  assert_says(rounds_with("count = 3, offset = [0.0, 0.0, -0.1]", "until_design = true"),
              "each has to lead nearer to it");
  const std::string deep =
      rounds_with("count = 3, offset = [0.0, 0.0, -0.1]", "count = 3, offset = [1.5, 0.0, 0.0]");
  // The first round's return already leads to where the second one begins.
  assert_says(deep, "step 3 (return): ");
  assert_says(deep, "; in round 1");
  assert_says(rounds_with("do = \"wait\"",
                          "do = \"dig\"\nto = { position = [5.8, 0.0, -0.3], attitude = 1.2 }\n"
                          "until = { full = 0.5 }\n[[step]]\ndo = \"dig\"\nuntil = { full = 0.5 }\n"
                          "to = { position = [4.8, 0.0, -0.3], attitude = 0.9 }"),
              "step[2].until.full (line 15): is the second one");
  ExcavatorProfile dry = profile("excavator_12t");
  dry.oil = {};
  dry.geometry.body = {};
  for (const char* what : {"force = 2e4", "full = 0.5"}) {
    const Written file(rounds_text(depth, what));
    try {
      static_cast<void>(machines::load_task(file.path(), dry));
      fail_msg("a machine that does not know %s", what);
    } catch (const machines::ProfileError& error) {
      assert_says(error.errors().front(), "in the machine's profile");
    }
  }
}

TEST(a_missing_task_says_where_it_looked) {
  expect_refusal([] { return machines::find_task("no_such_task"); },
                 "task 'no_such_task': there is no such file");
}
