// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/line_plan.hpp"

#include <cmath>
#include <limits>

#include "app/plant/random.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/rounds.hpp"

constexpr int kTargets = test::rounds(10000, 300);
/// What a stroke may pass its range by: rounding of a pose made from a stroke at its end.
constexpr double kStrokeTolerance_m = 1.001e-6;

struct Machine {
  explicit Machine(const machines::SimulatedExcavator& machine)
      : kinematics(machine.profile.geometry),
        limits(drive_limits(machine.profile)),
        task(machine.experiment.line) {
    request = {task.from, task.to, machine.profile.line.acceleration_mps2};
    request.duration_s = task.duration_s;
  }
  [[nodiscard]] PlanResult plan() const { return plan_line(kinematics, limits, request); }

  SwingKinematics kinematics;
  DriveLimits limits;
  machines::LineTask task;
  LineRequest request;
};

Machine of_the_paper() { return Machine(test::excavator_12t()); }

/// 200 L/min a section over the pistons; the pump could give more.
TEST(limits_come_from_flow_and_area) {
  const DriveLimits limits = of_the_paper().limits;
  assert_near(limits.speed_out[kBoom], 3.333e-3 / 0.0173180, 1e-5);
  assert_near(limits.speed_in[kArm], 3.333e-3 / 0.0055418, 1e-4);
  assert_near(limits.speed_out[kSwing], 1.435, 0.0);
  assert_near(limits.speed_in[kSwing], 1.435, 0.0);
  ExcavatorProfile small = test::excavator_12t().profile;
  small.pump[0].displacement_m3prev *= 0.5;
  assert_near(drive_limits(small).speed_out[kBoom], 2.2958e-3 / 0.0173180, 1e-4);
}

/// J to K in 18.4 s. The paper's 15 mm/s can't be its speed: the mean alone is 203.
TEST(the_paper_s_line) {
  const Machine machine = of_the_paper();
  const PlanResult result = machine.plan();
  assert_int_equal(result.refusal, PlanRefusal::kNone);
  assert_int_equal(result.slowed_by, PlanLimit::kNone);
  assert_near(result.plan.ramp.duration_s, 18.4, 0.0);
  assert_near(result.plan.way_m, 3.7304, 1e-4);
  assert_true(result.plan.way_m * result.plan.ramp.peak_rate_ps() > 0.2);
  const PlanState start = plan_state(machine.kinematics, result.plan, 0.0);
  const PlanState end = plan_state(machine.kinematics, result.plan, 18.4);
  assert_true((start.teeth.position_m - Eigen::Vector3d(0.0, 6.866, 0.0)).norm() < 1e-12);
  assert_true((end.teeth.position_m - Eigen::Vector3d(2.244, 3.886, 0.0)).norm() < 1e-12);
  assert_near(end.teeth.attitude_rad, 1.221730, 1e-12);
  assert_near(end.by_share.value[kSwing] - start.by_share.value[kSwing], -0.5236, 1e-3);
}

/// Strokes of the plan through the forward kinematics: 1000 moments.
TEST(replay_stays_on_the_line) {
  for (const Machine& machine : {of_the_paper(), Machine(test::excavator())}) {
    const PlanResult result = machine.plan();
    assert_int_equal(result.refusal, PlanRefusal::kNone);
    const Eigen::Vector3d along = result.plan.line.change.position_m.normalized();
    double off_line_m = 0.0;
    double off_plan_m = 0.0;
    double off_attitude_rad = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const PlanState state =
          plan_state(machine.kinematics, result.plan, result.plan.ramp.duration_s * i / 1000.0);
      const DriveResult joints = machine.kinematics.joints_from_drive(state.by_share.value);
      assert_int_equal(joints.blind.kind, BlindKind::kNone);
      const TeethPose there = machine.kinematics.teeth_from_joints(joints.value);
      const Eigen::Vector3d from_start = there.position_m - machine.task.from.position_m;
      off_line_m = std::max(off_line_m, (from_start - along * along.dot(from_start)).norm());
      off_plan_m = std::max(off_plan_m, (there.position_m - state.teeth.position_m).norm());
      off_attitude_rad =
          std::max(off_attitude_rad, std::abs(there.attitude_rad - state.teeth.attitude_rad));
    }
    print_message("off the line %.2e m, off the plan %.2e m and %.2e rad\n", off_line_m, off_plan_m,
                  off_attitude_rad);
    assert_true(off_line_m < 1e-9);
    assert_true(off_plan_m < 1e-9);
    assert_true(off_attitude_rad < 1e-9);
  }
}

TEST(velocities_are_differences_of_displacements) {
  constexpr double kStep_s = 1e-4;
  const Machine machine = of_the_paper();
  const LinePlan plan = machine.plan().plan;
  const auto at = [&](double t) { return plan_state(machine.kinematics, plan, t); };
  for (double t = 0.05; t < 18.3; t += 0.1) {
    const PlanState here = at(t);
    const PlanState ahead = at(t + kStep_s);
    const PlanState behind = at(t - kStep_s);
    const DriveVector velocity = (ahead.by_share.value - behind.by_share.value) / (2.0 * kStep_s);
    const DriveVector acceleration = (ahead.velocity - behind.velocity) / (2.0 * kStep_s);
    assert_true((here.velocity - velocity).cwiseAbs().maxCoeff() < 1e-7);
    assert_true((here.acceleration - acceleration).cwiseAbs().maxCoeff() < 1e-4);
    const Eigen::Vector3d teeth_mps =
        (ahead.teeth.position_m - behind.teeth.position_m) / (2.0 * kStep_s);
    assert_true((here.teeth_velocity_mps - teeth_mps).norm() < 1e-7);
    const Eigen::Vector3d teeth_mps2 =
        (ahead.teeth_velocity_mps - behind.teeth_velocity_mps) / (2.0 * kStep_s);
    assert_true((here.teeth_acceleration_mps2 - teeth_mps2).norm() < 1e-4);
  }
}

/// Twice as much asked of one drive than it can: the whole takes twice as long on the same line.
TEST(the_whole_is_slowed_by_one_drive) {
  Machine machine = of_the_paper();
  const PlanResult free = machine.plan();
  for (int drive = 0; drive < kDriveCount; ++drive) {
    machine.limits = of_the_paper().limits;
    machine.limits.speed_out[drive] = machine.limits.speed_in[drive] =
        0.5 * free.peaks.speed[drive];
    const PlanResult slow = machine.plan();
    assert_int_equal(slow.slowed_by, PlanLimit::kSpeed);
    assert_int_equal(slow.drive, drive);
    assert_near(slow.plan.ramp.duration_s, 2.0 * 18.4, 1e-3);
    assert_near(slow.slowed_ratio, 2.0, 1e-4);
    assert_near(slow.peaks.speed_ratio[drive], 1.0, 1e-12);
    assert_near(slow.peaks.acceleration[drive], 0.25 * free.peaks.acceleration[drive], 1e-9);
    machine.limits = of_the_paper().limits;
    machine.limits.acceleration[drive] = 0.25 * free.peaks.acceleration[drive];
    const PlanResult gentle = machine.plan();
    assert_int_equal(gentle.slowed_by, PlanLimit::kAcceleration);
    assert_int_equal(gentle.drive, drive);
    assert_near(gentle.plan.ramp.duration_s, 2.0 * 18.4, 1e-3);
  }
}

/// Extending has its own limit, retracting its own.
TEST(limits_hold_in_their_direction) {
  Machine machine = of_the_paper();
  const PlanResult free = machine.plan();
  // The line swings to the right only.
  machine.limits.speed_out[kSwing] = 0.1 * free.peaks.speed[kSwing];
  assert_int_equal(machine.plan().slowed_by, PlanLimit::kNone);
  machine.limits.speed_in[kSwing] = 0.5 * free.peaks.speed[kSwing];
  assert_int_equal(machine.plan().slowed_by, PlanLimit::kSpeed);
}

TEST(speed_given_and_duration_found) {
  Machine machine = of_the_paper();
  const double speed_mps = machine.plan().plan.way_m * machine.plan().plan.ramp.peak_rate_ps();
  machine.request.duration_s = 0.0;
  machine.request.speed_mps = speed_mps;
  assert_near(machine.plan().plan.ramp.duration_s, 18.4, 1e-9);
  machine.request.duration_s = 0.1;
  machine.request.speed_mps = 0.0;
  const PlanResult hasty = machine.plan();
  assert_int_equal(hasty.refusal, PlanRefusal::kNone);
  assert_int_not_equal(hasty.slowed_by, PlanLimit::kNone);
  assert_true(hasty.plan.ramp.duration_s > 5.0);
  machine.limits.speed_out *= 100.0;
  machine.limits.speed_in *= 100.0;
  machine.limits.acceleration *= 100.0;
  assert_int_equal(machine.plan().slowed_by, PlanLimit::kTeethAcceleration);
}

TEST(what_is_no_task_is_refused) {
  const auto refused = [](void (*spoil)(Machine&)) {
    Machine machine = of_the_paper();
    spoil(machine);
    return machine.plan().refusal;
  };
  const auto bad = PlanRefusal::kBadRequest;
  assert_int_equal(refused([](Machine& m) { m.request.speed_mps = 1.0; }), bad);
  assert_int_equal(refused([](Machine& m) { m.request.duration_s = 0.0; }), bad);
  assert_int_equal(refused([](Machine& m) { m.request.duration_s = -1.0; }), bad);
  assert_int_equal(refused([](Machine& m) { m.request.acceleration_mps2 = 0.0; }), bad);
  assert_int_equal(refused([](Machine& m) { m.limits.speed_in[kSwing] = 0.0; }), bad);
  assert_int_equal(refused([](Machine& m) { m.limits.speed_out[kArm] = -1.0; }), bad);
  assert_int_equal(refused([](Machine& m) {
                     m.limits.acceleration[kBoom] = std::numeric_limits<double>::infinity();
                   }),
                   bad);
  assert_int_equal(refused([](Machine& m) {
                     m.request.from.position_m.x() = std::numeric_limits<double>::quiet_NaN();
                   }),
                   bad);
  assert_int_equal(refused([](Machine& m) {
                     m.request.to.attitude_rad = std::numeric_limits<double>::quiet_NaN();
                   }),
                   bad);
  assert_int_equal(refused([](Machine& m) { m.request.to = m.request.from; }), PlanRefusal::kNoWay);
  assert_int_equal(refused([](Machine& m) { m.request.to.position_m.x() = 12.0; }),
                   PlanRefusal::kBlindSpot);
}

/// Between one random place of the work space and one of a box about the machine.
LineRequest random_request(const Machine& machine, plant::Random& random) {
  const ExcavatorGeometry& geometry = machine.kinematics.geometry();
  DriveVector drive;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    drive[i] = random.uniform() * geometry.cylinder[i].stroke_m;
  }
  drive[kSwing] = 3.14 * random.symmetric(1.0);
  LineRequest request = machine.request;
  request.from =
      machine.kinematics.teeth_from_joints(machine.kinematics.joints_from_drive(drive).value);
  request.to = request.from;
  const double size_m = random.uniform() < 0.5 ? 2.0 : 9.0;
  for (int axis = 0; axis < 3; ++axis) {
    request.to.position_m[axis] += random.symmetric(size_m);
  }
  request.to.attitude_rad += random.symmetric(1.0);
  const bool timed = random.uniform() < 0.5;
  request.duration_s = timed ? 1.0 + 20.0 * random.uniform() : 0.0;
  request.speed_mps = timed ? 0.0 : 0.05 + 2.0 * random.uniform();
  return request;
}

void assert_within_limits(const Machine& machine, const LinePlan& plan, plant::Random& random) {
  const ExcavatorGeometry& geometry = machine.kinematics.geometry();
  for (int i = 0; i <= 50; ++i) {
    const double time_s = plan.ramp.duration_s * (i < 49 ? random.uniform() : i - 49.0);
    const PlanState state = plan_state(machine.kinematics, plan, time_s);
    assert_int_equal(state.by_share.blind.kind, BlindKind::kNone);
    for (int drive = 0; drive < kDriveCount; ++drive) {
      const double speed = state.velocity[drive];
      assert_true(speed <= 1.001 * machine.limits.speed_out[drive]);
      assert_true(-speed <= 1.001 * machine.limits.speed_in[drive]);
      assert_true(std::abs(state.acceleration[drive]) <=
                  1.001 * machine.limits.acceleration[drive]);
      if (drive != kSwing) {
        const double most_m = geometry.cylinder[static_cast<unsigned>(drive)].stroke_m;
        assert_true(state.by_share.value[drive] >= -kStrokeTolerance_m);
        assert_true(state.by_share.value[drive] <= most_m + kStrokeTolerance_m);
      }
    }
    const DriveResult joints = machine.kinematics.joints_from_drive(state.by_share.value);
    const TeethPose replay = machine.kinematics.teeth_from_joints(joints.value);
    assert_true((replay.position_m - state.teeth.position_m).norm() < 1e-6);
  }
}

/// The machine can be everywhere before the place, and can't at it; the place is on the line.
void assert_place(const Machine& machine, const PlanResult& result) {
  assert_int_equal(result.refusal, PlanRefusal::kBlindSpot);
  const BlindPlace& place = result.blind;
  assert_int_not_equal(place.blind.kind, BlindKind::kNone);
  assert_int_not_equal(place.blind.kind, BlindKind::kNotFinite);
  assert_in_range(place.blind.drive, kBoom, kSwing);
  assert_true(place.share >= 0.0 && place.share <= 1.0);
  const auto kind_at = [&](double share) {
    return line_motion(machine.kinematics, result.plan.line, share).blind.kind;
  };
  assert_int_equal(kind_at(place.share), place.blind.kind);
  for (int i = 0; i < 50; ++i) {
    const double before = (place.share - 1e-9) * i / 50.0;
    assert_true(before < 0.0 || place.share == 0.0 || kind_at(before) == BlindKind::kNone);
  }
  assert_true((place.teeth.position_m - result.plan.line.at(place.share).position_m).norm() < 1e-9);
}

TEST(random_targets_keep_all_limits_or_say_where_not) {
  int accepted = 0;
  int slowed = 0;
  std::array<int, kDriveCount> refused{};
  const Machine machines[] = {of_the_paper(), Machine(test::excavator())};
  for (int i = 0; i < kTargets; ++i) {
    const Machine& machine = machines[i % 2];
    plant::Random random(static_cast<std::uint64_t>(i), plant::Draw::kStart);
    const LineRequest request = random_request(machine, random);
    const PlanResult result = plan_line(machine.kinematics, machine.limits, request);
    if (result.refusal == PlanRefusal::kNone) {
      assert_within_limits(machine, result.plan, random);
      assert_true(request.duration_s == 0.0 ||
                  result.plan.ramp.duration_s >= request.duration_s - 1e-12);
      ++accepted;
      slowed += result.slowed_by == PlanLimit::kNone ? 0 : 1;
    } else {
      assert_place(machine, result);
      ++refused[static_cast<unsigned>(result.blind.blind.drive)];
    }
  }
  print_message(
      "%d accepted, %d of them slowed; refused for boom %d, arm %d, bucket %d, swing %d\n",
      accepted, slowed, refused[kBoom], refused[kArm], refused[kBucket], refused[kSwing]);
  assert_true(accepted > kTargets / 10);
  assert_true(slowed > kTargets / 100 && accepted - slowed > kTargets / 100);
  for (int drive = 0; drive < kAxisCount; ++drive) {
    assert_true(refused[static_cast<unsigned>(drive)] > kTargets / 100);
  }
}
