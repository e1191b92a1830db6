// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/approach.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t().profile);
  return loaded;
}

Fence box(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& half_m) {
  Fence fence;
  fence.shape = FenceShape::kBox;
  fence.normal = Eigen::Vector3d::UnitX();
  fence.centre_m = centre_m;
  fence.half_m = half_m;
  return fence;
}

/// A level line before the machine.
TaskProgram program(std::initializer_list<Fence> fences) {
  ProgramRequest request;
  request.start = {{7.0, 0.0, -0.4}, 2.2};
  request.step[0] = {StepKind::kDig, {{4.8, 0.0, -0.4}, 0.9}, true, 0.5, 0.0, 1.0};
  request.step_count = 1;
  for (const Fence& fence : fences) {
    request.fences.fence[static_cast<unsigned>(request.fences.count++)] = fence;
  }
  const ProgramResult result = plan_program(machine().profile, request);
  assert_int_equal(result.refusal, ProgramRefusal::kNone);
  return result.program;
}

struct Found {
  ApproachSearch search;
  ApproachPath path;
  int cycles = 0;
};

Found search(const TaskProgram& task, const DriveVector& from) {
  Found found;
  while (!found.search.found && !found.search.failed) {
    search_approach(machine().profile, machine().kinematics, task, from, found.search, found.path);
    // Each way is planned in a cycle, and has at most kApproachLegs legs of kApproachSamples + 1
    // poses.
    assert_true(++found.cycles <=
                kApproachWays *
                    (1 + kApproachLegs * (kApproachSamples + kSamplesPerCycle) / kSamplesPerCycle));
  }
  return found;
}

/// Least that is left before any fence along the way, by poses ten times as many as it looks at,
/// less what the margin is at rest.
double left_m(const TaskProgram& task, const ApproachPath& path) {
  double least_m = 1e3;
  for (int leg = 0; leg < path.legs; ++leg) {
    const DrivePlan plan = approach_leg(path, task, leg);
    for (int i = 0; i <= 10 * kApproachSamples; ++i) {
      const DriveVector at = plan.from + i / (10.0 * kApproachSamples) * plan.change;
      const MachineMotion motion = machine_motion(machine().kinematics, at, DriveVector::Zero(),
                                                  unsure_drives(machine().profile));
      for (int f = 0; f < task.fences.count; ++f) {
        const Fence& fence = task.fences.fence[static_cast<unsigned>(f)];
        for (int k = 0; k < gap_count(fence, machine().profile.geometry.body); ++k) {
          const FenceGap gap = fence_gap(fence, machine().profile.geometry.body, motion, k, 1e3);
          least_m = std::min(
              least_m, gap.distance_m - held_margin_m(machine().profile.fence, fence, motion, gap));
        }
      }
    }
  }
  return least_m;
}

DriveVector beside(const TaskProgram& task) {
  DriveVector from = task.start;
  from[kSwing] = 1.8;
  return from;
}

TEST(without_fences_the_way_is_direct_at_once) {
  const TaskProgram task = program({});
  const Found found = search(task, beside(task));
  assert_true(found.search.found);
  assert_int_equal(found.search.way, ApproachWay::kDirect);
  assert_int_equal(found.cycles, 1);
}

TEST(what_is_far_away_changes_nothing) {
  const TaskProgram task = program({box({-8.0, 0.0, 0.0}, {1.0, 1.0, 1.0})});
  const Found found = search(task, beside(task));
  assert_true(found.search.found);
  assert_int_equal(found.search.way, ApproachWay::kDirect);
  // Its planning, and two legs.
  assert_int_equal(found.cycles,
                   1 + (2 * (kApproachSamples + 1) + kSamplesPerCycle - 1) / kSamplesPerCycle);
}

/// Between the machine and its task: lower than the raised bucket, or near enough to be passed with
/// the bucket drawn in.
TEST(it_goes_over_or_round_what_is_between) {
  const Fence low = box({4.6, 4.6, 0.0}, {0.8, 0.8, 2.0});
  const Fence high = box({5.5, 5.5, 3.0}, {0.8, 0.8, 6.0});
  for (const Fence& fence : {low, high}) {
    const TaskProgram task = program({fence});
    const Found found = search(task, beside(task));
    assert_true(found.search.found);
    assert_int_not_equal(found.search.way, ApproachWay::kDirect);
    const double least_m = left_m(task, found.path);
    print_message("way %d, %.0f mm to spare\n", found.search.way, 1e3 * least_m);
    assert_true(least_m > 0.0);
    const ApproachPath direct = approach_path(machine().profile, machine().kinematics, task,
                                              beside(task), ApproachWay::kDirect);
    assert_true(left_m(task, direct) < 0.0);
  }
}

TEST(where_nothing_leads_there_none_is_found) {
  // From near the axis to beyond all reach, across the way.
  Fence wall = box({4.0, 4.0, 4.0}, {4.0, 0.2, 8.0});
  wall.normal = {std::cos(0.8), std::sin(0.8), 0.0};
  const TaskProgram task = program({wall});
  const Found found = search(task, beside(task));
  assert_true(found.search.failed);
  assert_false(found.search.found);
}

/// A machine that stands beyond a wall beside it may swing back, and nothing else.
TEST(from_beyond_a_fence_it_only_leads_away, Fence wall) {
  wall.normal = Eigen::Vector3d::UnitY();
  wall.offset_m = 3.0;
  const TaskProgram task = program({wall});
  DriveVector from = task.start;
  from[kSwing] = 1.2;  // Its teeth are 3.5 m beyond.
  const Found found = search(task, from);
  assert_true(found.search.found);
  // Farther to the side: swinging back first leads on over it.
  from[kSwing] = 2.2;
  assert_true(search(task, from).search.failed);
}
