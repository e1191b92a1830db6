// SPDX-License-Identifier: Apache-2.0
/// A joint's model and its cost; that both find a machine: tests/closed_loop/check_identify.py.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "app/identify/joint_cost.hpp"
#include "app/identify/joint_motion.hpp"
#include "app/identify/motion_delay.hpp"
#include "app/identify/motion_result.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

constexpr double kRow_s = 0.05;
constexpr std::size_t kRows = 120;
constexpr std::size_t kBoom = 0;

Grid grid() {
  Grid grid;
  grid.forward = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  grid.backward = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 0.9, 1.0};
  grid.least_rad = -0.3;
  grid.most_rad = 0.3;
  return grid;
}

/// A joint that opens evenly to 0.7 rad/s, loaded, shared and shaken a little.
JointModel joint() {
  JointModel model;
  model.grid = grid();
  std::fill_n(model.value.begin() + kForward, 2 * kRises, 0.7 / kRises);
  std::fill_n(model.value.begin() + kLinkageRatio, kLinkage - 1, 0.9);
  model.value[kDeadTime] = 0.12;
  const std::array<double, 4> lags = {0.05, 0.08, 0.06, 0.09};
  std::copy(lags.begin(), lags.end(), model.value.begin() + kPilotLag);
  std::copy(lags.begin(), lags.end(), model.value.begin() + kFlowLag);
  model.value[kSensorLag] = 0.03;
  model.value[kModeRate] = 12.0;
  model.value[kDampingDriving] = 20.0;
  model.value[kDampingBraking] = 14.0;
  model.value[kInertia + 1] = 0.3;
  model.value[kLoadForward + 1] = 0.1;
  model.value[kLoadBackward + 1] = 0.2;
  model.value[kShare + 1] = 0.3;
  model.value[kRockRate] = 20.0;
  model.value[kRockDamping] = 0.3;
  model.value[kRockForce + 2] = 0.1;
  model.value[kRockOwn] = -0.2;
  return model;
}

/// Commands that go both ways, at another pace for each joint; what is measured is `seed`'s.
MotionRun run(double seed) {
  MotionRun run;
  run.name = "run " + std::to_string(seed);
  for (std::size_t row = 0; row < kRows; ++row) {
    const double time_s = kRow_s * static_cast<double>(row);
    run.time_s.push_back(time_s);
    for (std::size_t of = 0; of < kJoints; ++of) {
      const double pace = 1.0 + 0.3 * static_cast<double>(of);
      run.command[of].push_back(std::sin(pace * time_s + seed));
      run.angle_rad[of].push_back(0.3 * std::sin(0.5 * time_s + seed));
      run.velocity_radps[of].push_back(0.15 * std::cos(0.5 * time_s + seed));
    }
  }
  return run;
}

MotionModel machine() { return {joint(), joint(), joint(), joint()}; }

/// A run in which the machine does what the model says, its sensor of velocity as late as it is.
MotionRun obedient(double seed) {
  MotionRun of = run(seed);
  for (std::size_t row = 1; row < kRows; ++row) {  // The pose of a row moves those after it.
    const Velocities velocity = predict(machine(), of);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      of.velocity_radps[joint] = velocity[joint];
      of.angle_rad[joint][row] = of.angle_rad[joint][row - 1] + kRow_s * velocity[joint][row];
    }
  }
  return of;
}

TEST(derivatives_are_those_of_the_error) {
  const MotionModel model = machine();
  const MotionRun of = run(0.3);
  const Velocities rates = predict(model, of);
  const JointRun input = joint_run(model, kBoom, of, &rates);
  const JointCost cost(input, kBoom, model[kBoom].grid, -1.0, 0.2);
  std::array<double, kParameters> value = model[kBoom].value;
  const double* parameters = value.data();
  const auto count = static_cast<std::size_t>(cost.num_residuals());
  assert_int_equal(count, kRows + rows_ahead(of, 1.0, 4).size());
  std::vector<double> residuals(count);
  std::vector<double> jacobian(count * kParameters);
  double* to = jacobian.data();
  assert_true(cost.Evaluate(&parameters, residuals.data(), &to));
  std::vector<double> plain(count);
  assert_true(cost.Evaluate(&parameters, plain.data(), nullptr));
  for (std::size_t at = 0; at < kParameters; ++at) {
    constexpr double kStep = 1e-6;
    std::vector<double> above(count);
    std::vector<double> below(count);
    value[at] += kStep;
    cost.Evaluate(&parameters, above.data(), nullptr);
    value[at] -= 2.0 * kStep;
    cost.Evaluate(&parameters, below.data(), nullptr);
    value[at] += kStep;
    for (std::size_t row = 0; row < count; ++row) {
      assert_near(residuals[row], plain[row], 1e-12);
      const double slope = (above[row] - below[row]) / (2.0 * kStep);
      assert_near(jacobian[row * kParameters + at], slope, 2e-3 * (1.0 + std::abs(slope)));
    }
  }
}

TEST(nothing_moves_before_dead_time_and_edge) {
  const MotionModel model = machine();
  MotionRun of = run(0.0);
  for (double& command : of.command[kBoom]) {
    command = 0.19;  // Below the first bend of positive commands.
  }
  JointRun input = joint_run(model, kBoom, of, nullptr);
  for (const double open : openings<double>(input, kBoom, model[kBoom].value.data(), grid())) {
    assert_near(open, 0.0, 0.0);
  }
  for (std::size_t row = 0; row < kRows; ++row) {
    of.command[kBoom][row] = row < 20 ? 0.0 : -1.0;
  }
  input = joint_run(model, kBoom, of, nullptr);
  const std::vector<double> open =
      openings<double>(input, kBoom, model[kBoom].value.data(), grid());
  // 0.12 s are two rows and a part.
  assert_near(open[22], 0.0, 0.0);
  assert_true(open[23] < 0.0);
  assert_near(open[kRows - 1], -0.7, 1e-9);
}

TEST(a_first_command_is_new_to_a_joint_that_stands) {
  const MotionModel model = machine();
  const auto opened = [&](double velocity_radps) {
    MotionRun of = run(0.0);
    std::fill(of.command[kBoom].begin(), of.command[kBoom].end(), 1.0);
    of.velocity_radps[kBoom][0] = velocity_radps;
    const JointRun input = joint_run(model, kBoom, of, nullptr);
    return openings<double>(input, kBoom, model[kBoom].value.data(), grid());
  };
  const std::vector<double> stood = opened(0.01);
  assert_near(stood[2], 0.0, 0.0);  // 0.12 s of dead time are two rows and a part.
  assert_true(stood[3] > 0.0 && stood[3] < 0.6);
  assert_near(stood[kRows - 1], 0.7, 1e-9);
  assert_near(opened(0.2)[1], 0.7, 1e-9);
  // Nor does another joint take its share sooner.
  MotionRun of = run(0.0);
  std::fill(of.command[kBoom].begin(), of.command[kBoom].end(), 1.0);
  of.velocity_radps[kBoom][0] = 0.0;
  const JointRun arm = joint_run(model, kBoom + 1, of, nullptr);
  assert_near(arm.other_opening[0][2], 0.0, 0.0);
  assert_near(arm.other_opening[0][kRows - 1], 1.0, 1e-6);
}

/// What `model`'s boom does at rest under a full command; nothing else moves.
std::vector<JointState<double>> stepped(const JointModel& model) {
  MotionRun of = run(0.0);
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      of.command[joint][row] = joint == kBoom && row >= 5 ? 1.0 : 0.0;
      of.angle_rad[joint][row] = 0.0;
    }
  }
  const MotionModel all = {model, joint(), joint(), joint()};
  const JointRun input = joint_run(all, kBoom, of, nullptr);
  return motion<double>(input, kBoom, model.value.data(), model.grid);
}

TEST(a_heavy_pose_answers_later) {
  const auto velocity_radps = [](double heavier) {
    JointModel model = joint();
    model.grid.usual[1] = 0.5;  // Cosine of the boom; it is level here.
    model.value[kInertia] = heavier;
    assert_near(inertia_of(model.value.data(), model.grid, pose_of(Angles{})),
                1.0 + 0.5 * heavier + 0.3, 1e-12);
    return stepped(model)[12].velocity_radps;
  };
  assert_true(velocity_radps(0.0) > velocity_radps(1.0) + 0.01);
  JointModel model = joint();
  model.value[kInertia] = -5.0;  // Nothing weighs less than that.
  assert_near(inertia_of(model.value.data(), model.grid, pose_of(Angles{})), 0.2, 0.0);
}

TEST(a_joint_rocks_the_machine_that_carries_it) {
  JointModel model = joint();
  const auto turned = [&] { return stepped(model); };
  model.value[kRockOwn] = 0.0;
  const std::vector<JointState<double>> firm = turned();
  model.value[kRockOwn] = -0.5;
  const std::vector<JointState<double>> rocking = turned();
  double least = 0.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    assert_near(firm[row].tilt_rad, 0.0, 0.0);
    least = std::min(least, rocking[row].tilt_rad);
  }
  assert_true(least < -1e-3);
  // It comes to rest where it was.
  assert_near(rocking.back().turned_rad, firm.back().turned_rad, 1e-4);
}

TEST(a_model_explains_its_own_motion) {
  const std::array<Score, kJoints> own = judge(machine(), {obedient(0.1), obedient(1.7)});
  const std::array<Score, kJoints> other = judge(machine(), {run(0.1), run(1.7)});
  for (std::size_t of = 0; of < kJoints; ++of) {
    assert_true(own[of].moved);
    assert_near(own[of].velocity_r2, 1.0, 1e-6);
    assert_true(own[of].angle_1s_rms_rad < 0.02 && other[of].angle_1s_rms_rad > 0.1);
    assert_true(other[of].velocity_r2 < 0.5);
  }
}

TEST(a_velocity_of_angles_is_compared_with_angles) {
  MotionRun of = obedient(0.1);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    take_velocity_of_angle(of, joint);
  }
  const Velocities measured = predict_measured(machine(), of);
  const Velocities seen = predict(machine(), of);
  double apart = 0.0;
  for (std::size_t row = 1; row < kRows; ++row) {
    apart = std::max(apart, std::abs(measured[kBoom][row] - seen[kBoom][row]));
  }
  assert_true(apart > 1e-3);  // A mean over 0.1 s, and a lag of 0.03 s.
  assert_true(judge(machine(), {of})[kBoom].velocity_r2 > 0.9);
}

TEST(total_delay_is_dead_time_and_lags) {
  JointModel model = joint();
  const TotalDelay delay = total_delay(model, 1.0);
  assert_true(delay.half_s > 0.12 + 0.05 && delay.half_s < 0.12 + 0.4);
  assert_true(delay.most_s > delay.half_s);
  model.value[kDeadTime] += 0.1;
  assert_near(total_delay(model, 1.0).half_s, delay.half_s + 0.1, 0.006);
  std::fill_n(model.value.begin() + kForward, kRises, 0.0);
  assert_true(std::isnan(total_delay(model, 1.0).half_s));
}

TEST(a_second_ahead_knows_nothing_of_that_second) {
  const MotionRun of = obedient(0.4);
  constexpr std::size_t kFrom = 40;
  const Velocities turns = turns_ahead(machine(), of);
  MotionRun other = of;
  for (std::size_t row = kFrom + 1; row < kRows; ++row) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      other.angle_rad[joint][row] += 0.2;
      other.velocity_radps[joint][row] = -0.3;
    }
  }
  const Velocities same = turns_ahead(machine(), other);
  assert_int_equal(turns[kBoom].size(), kRows - 20);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    assert_near(same[joint][kFrom], turns[joint][kFrom], 1e-12);
    assert_true(std::abs(same[joint][kFrom + 1] - turns[joint][kFrom + 1]) > 1e-6);
    assert_near(of.angle_rad[joint][kFrom + 20] - of.angle_rad[joint][kFrom], turns[joint][kFrom],
                0.03);
  }
}

/// A boom of which a linkage and a pump that is slow to lift are all that is not plain, its
/// commands held for a while each; `seed` chooses them. The other joints stand.
MotionRun lifting(const JointModel& boom, unsigned seed) {
  constexpr std::size_t kLong = 500;
  MotionRun of;
  of.name = "lifting " + std::to_string(seed);
  std::mt19937 dice(seed);
  double command = 0.0;
  std::size_t left = 0;
  for (std::size_t row = 0; row < kLong; ++row, --left) {
    if (left == 0) {
      left = 6 + dice() % 16;
      // Away from the ends of its travel.
      const double angle_rad = row == 0 ? 0.0 : of.angle_rad[kBoom][row - 1];
      const double size = 0.25 + 0.75 * static_cast<double>(dice() % 100) / 99.0;
      command = dice() % 4 == 0 ? 0.0 : (angle_rad > 0.25 * std::sin(double(row)) ? -size : size);
    }
    of.time_s.push_back(kRow_s * static_cast<double>(row));
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      of.command[joint].push_back(joint == kBoom ? command : 0.0);
      of.angle_rad[joint].push_back(row == 0 ? 0.0 : of.angle_rad[joint][row - 1]);
      of.velocity_radps[joint].push_back(0.0);
    }
    if (row > 0) {
      const MotionModel model = {boom, JointModel{}, JointModel{}, JointModel{}};
      const JointRun input = joint_run(model, kBoom, of, nullptr);
      const std::vector<JointState<double>> states =
          motion<double>(input, kBoom, boom.value.data(), boom.grid);
      of.angle_rad[kBoom][row] = states[row].turned_rad;
      of.velocity_radps[kBoom][row] = states[row].seen_radps;
    }
  }
  return of;
}

TEST(linkage_and_slow_pump_are_found) {
  JointModel boom = joint();
  for (const std::size_t plain : {kLoadForward, kLoadBackward}) {
    std::fill_n(boom.value.begin() + static_cast<std::ptrdiff_t>(plain), kPose, 0.0);
  }
  boom.value[kRockOwn] = 0.0;
  std::fill_n(boom.value.begin() + kInertia, kCosines, 0.0);
  const std::array<double, kLinkage - 1> ratios = {0.55, 0.75, 0.92, 0.92, 0.75, 0.55};
  std::copy(ratios.begin(), ratios.end(), boom.value.begin() + kLinkageRatio);
  const std::array<double, 4> slow = {0.25, 0.01, 0.02, 0.01};
  std::copy(slow.begin(), slow.end(), boom.value.begin() + kFlowLag);
  boom.grid.least_rad = -0.6;
  boom.grid.most_rad = 0.6;
  std::vector<MotionRun> runs;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    runs.push_back(lifting(boom, seed));
  }
  FitOptions options;
  options.threads = 1;
  options.passes = 2;
  const MotionModel found = fit_motion({runs.begin(), runs.end() - 1}, options);
  const JointModel& said = found[kBoom];
  // Pilot and pump can stand for each other; that lifting is slow and lowering is not can not.
  const auto slower = [](const JointModel& of) {
    const std::array<double, kParameters>& value = of.value;
    return value[kPilotLag] + value[kFlowLag] - value[kPilotLag + 2] - value[kFlowLag + 2];
  };
  assert_near(slower(said), slower(boom), 0.1);
  for (const double angle_rad : {-0.3, 0.3}) {
    const auto relative = [angle_rad](const JointModel& of) {
      const double* ratio = of.value.data() + kLinkageRatio;
      return linkage_at(ratio, of.grid, angle_rad) / linkage_at(ratio, of.grid, 0.0);
    };
    assert_near(relative(said), relative(boom), 0.08);
  }
  const Score score = judge(found, {runs.back()})[kBoom];
  assert_near(score.velocity_r2, 1.0, 0.005);
  assert_near(score.angle_1s_rms_rad, 0.0, 0.02);
}

std::string refusal(const std::vector<MotionRun>& train, const std::vector<MotionRun>& judge) {
  return graben::test::refusal_of([&] { return split_motion(train, judge); });
}

TEST(judged_runs_are_others) {
  const MotionSplit split = split_motion(
      {run(0.0), run(0.1), run(0.2), run(0.3), run(0.4), run(0.5), run(0.6), run(0.7)}, {});
  assert_int_equal(split.train.size(), 6);
  assert_int_equal(split.judge.size(), 2);
  assert_true(split.judge[0].name == run(0.2).name && split.judge[1].name == run(0.7).name);
  assert_true(refusal({run(0.0), run(0.1)}, {}).find("at least 3") != std::string::npos);
  assert_true(refusal({run(0.0), run(0.1)}, {run(0.5), run(0.1)}).find("same motion") !=
              std::string::npos);
  assert_true(refusal({run(0.0)}, {run(0.1)}).empty());
}

TEST(deviations_that_nothing_gives_are_null) {
  MotionResult result;
  result.model = machine();
  result.model[kBoom].deviation[kForward] = INFINITY;
  result.trained[kBoom].moved = true;
  result.driven[kBoom] = {-0.5, 0.0};
  assert_true(motion_json(result).find("\"deviation_radps\": null") != std::string::npos);
  const std::string text = motion_text(result);
  assert_true(text.find("boom, positive commands: none was driven") != std::string::npos);
  assert_true(text.find("boom, negative commands: nothing beyond 50 % was driven") !=
              std::string::npos);
  assert_true(text.find("arm: stood throughout") != std::string::npos);
}
