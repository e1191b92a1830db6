/// A joint's model and its cost; that both find a machine: tests/closed_loop/check_identify.py.

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/identify/joint_cost.hpp"
#include "app/identify/motion_result.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben::identify;

constexpr double kRow_s = 0.05;
constexpr std::size_t kRows = 120;
constexpr std::size_t kBoom = 0;

Knots bends() {
  return {{0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0},
          {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 0.9, 1.0}};
}

/// A joint that opens evenly to 0.7 rad/s, loaded, shared and shaken a little.
JointModel joint() {
  JointModel model;
  model.knots = bends();
  for (std::size_t at = kForward; at < kModeRate; ++at) {
    model.value[at] = 0.7 / kRises;
  }
  model.value[kDeadTime] = 0.12;
  model.value[kLagOpening] = 0.05;
  model.value[kLagClosing] = 0.08;
  model.value[kModeRate] = 12.0;
  model.value[kDampingDriving] = 20.0;
  model.value[kDampingBraking] = 14.0;
  model.value[kLoadForward + 1] = 0.1;
  model.value[kShare + 1] = 0.3;
  model.value[kRockRate] = 20.0;
  model.value[kRockDamping] = 0.3;
  model.value[kRockForce + 2] = 0.1;
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

/// A run in which the machine does what the model says.
MotionRun obedient(double seed) {
  MotionRun of = run(seed);
  of.velocity_radps = predict(machine(), of);
  return of;
}

void derivatives_are_those_of_the_error(void** /*state*/) {
  const MotionModel model = machine();
  const MotionRun of = run(0.3);
  const Velocities rates = predict(model, of);
  const JointRun input = joint_run(model, kBoom, of, &rates);
  const JointCost cost(input, kBoom, model[kBoom].knots, -1.0, 0.2);
  std::array<double, kParameters> value = model[kBoom].value;
  const double* parameters = value.data();
  std::vector<double> residuals(kRows);
  std::vector<double> jacobian(kRows * kParameters);
  double* to = jacobian.data();
  assert_true(cost.Evaluate(&parameters, residuals.data(), &to));
  std::vector<double> plain(kRows);
  assert_true(cost.Evaluate(&parameters, plain.data(), nullptr));
  for (std::size_t at = 0; at < kParameters; ++at) {
    constexpr double kStep = 1e-6;
    std::vector<double> above(kRows);
    std::vector<double> below(kRows);
    value[at] += kStep;
    cost.Evaluate(&parameters, above.data(), nullptr);
    value[at] -= 2.0 * kStep;
    cost.Evaluate(&parameters, below.data(), nullptr);
    value[at] += kStep;
    for (std::size_t row = 0; row < kRows; ++row) {
      assert_near(residuals[row], plain[row], 1e-12);
      const double slope = (above[row] - below[row]) / (2.0 * kStep);
      assert_near(jacobian[row * kParameters + at], slope, 2e-3 * (1.0 + std::abs(slope)));
    }
  }
}

void nothing_moves_before_dead_time_and_edge(void** /*state*/) {
  const MotionModel model = machine();
  MotionRun of = run(0.0);
  for (double& command : of.command[kBoom]) {
    command = 0.19;  // Below the first bend of positive commands.
  }
  JointRun input = joint_run(model, kBoom, of, nullptr);
  for (const double open : openings<double>(input, kBoom, model[kBoom].value.data(), bends())) {
    assert_near(open, 0.0, 0.0);
  }
  for (std::size_t row = 0; row < kRows; ++row) {
    of.command[kBoom][row] = row < 20 ? 0.0 : -1.0;
  }
  input = joint_run(model, kBoom, of, nullptr);
  const std::vector<double> open =
      openings<double>(input, kBoom, model[kBoom].value.data(), bends());
  // 0.12 s are two rows and a part.
  assert_near(open[22], 0.0, 0.0);
  assert_true(open[23] < 0.0);
  assert_near(open[kRows - 1], -0.7, 1e-9);
}

void a_model_explains_its_own_motion(void** /*state*/) {
  const std::array<Score, kJoints> own = judge(machine(), {obedient(0.1), obedient(1.7)});
  const std::array<Score, kJoints> other = judge(machine(), {run(0.1), run(1.7)});
  for (std::size_t of = 0; of < kJoints; ++of) {
    assert_true(own[of].moved);
    assert_near(own[of].velocity_r2, 1.0, 1e-12);
    assert_true(other[of].velocity_r2 < 0.5);
  }
}

std::string refusal(std::vector<MotionRun> train, std::vector<MotionRun> judge) {
  try {
    (void)split_motion(std::move(train), std::move(judge));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void judged_runs_are_others(void** /*state*/) {
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

void deviations_that_nothing_gives_are_null(void** /*state*/) {
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(derivatives_are_those_of_the_error),
      cmocka_unit_test(nothing_moves_before_dead_time_and_edge),
      cmocka_unit_test(a_model_explains_its_own_motion),
      cmocka_unit_test(judged_runs_are_others),
      cmocka_unit_test(deviations_that_nothing_gives_are_null),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
