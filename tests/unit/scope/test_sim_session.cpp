// SPDX-License-Identifier: Apache-2.0
// What a simulation does by itself, and what becomes of what a page asks of it.

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/unit/scope/sim_watch.hpp"

using test::json;
using test::SimWatch;

TEST(works_by_itself_stops_and_runs) {
  SimWatch sim("dig");
  assert_true(sim.state()["running"] == true);
  assert_false(sim.run_to_active(0.29));
  assert_true(sim.run_to_active(0.2));
  sim.wish({{"do", "stop"}});
  sim.run(0.05);
  assert_true(sim.bus.mode == EcuMode::kReady && sim.bus.commands_neutral);
  assert_true(sim.state()["running"] == false);
  sim.run(1.0);
  assert_true(sim.bus.mode == EcuMode::kReady);
  // Nobody starts by clearing faults.
  sim.wish({{"do", "clear"}});
  sim.run(1.0);
  assert_true(sim.bus.mode == EcuMode::kReady);
  sim.wish({{"do", "run"}});
  assert_true(sim.run_to_active(0.5));
  assert_true(sim.state()["running"] == true);
  // Once more changes nothing.
  sim.bus.forget();
  sim.wish({{"do", "run"}});
  sim.run(0.5);
  assert_false(sim.bus.left_active);
}

TEST(state_has_a_revision) {
  SimWatch sim("dig");
  std::uint64_t seen = 0;
  const std::optional<json> first = sim.session.state(seen);
  assert_true(first && (*first)["kind"] == "sim" && seen == 1);
  assert_false(sim.session.state(seen).has_value());
  sim.wish({{"do", "pace"}, {"value", 2}});
  assert_false(sim.session.state(seen).has_value());
  assert_true(sim.session.step());
  const std::optional<json> second = sim.session.state(seen);
  assert_true(second && (*second)["pace"] == 2.0 && seen == 2);
  assert_false(sim.session.step());
  assert_false(sim.session.state(seen).has_value());
  // What happens once is on for as long as it lasts.
  sim.fault("controller-stalls", true);
  assert_true(sim.session.step());
  assert_true(sim.state()["faults"] == json::array({"controller-stalls"}));
  sim.run(0.3);
  assert_true(sim.state()["faults"].empty());
}

TEST(speed_is_taken_at_once) {
  SimWatch sim("grade");
  double wanted_mps = 0.0;
  sim.also = [&wanted_mps](const CanFrame& frame) {
    using Motion = dbc::dozer::EcuMotion;
    if (frame.id == Motion::kId) {
      wanted_mps = Motion::decode(frame.data).wanted_speed_mps.value;
    }
  };
  assert_true(sim.run_to_active(1.0));
  sim.run(4.0);
  const double before_mps = wanted_mps;
  sim.bus.forget();
  sim.wish({{"do", "speed"}, {"value", 0.1}});
  sim.run(1.5);
  assert_false(sim.bus.left_active);
  assert_true(before_mps > 0.5 && wanted_mps < 0.2);
  assert_near(sim.state()["speed"].get<double>(), 0.1, 0.0);
}

/// Greatest pressure that the arm's cap side has had, least lambda.
struct DigSeen {
  double arm_pa = 0.0;
  double lambda = 1.0;

  void see(const CanFrame& frame) {
    using dbc::excavator::ArmPressure;
    using dbc::excavator::EcuStatus;
    if (frame.id == ArmPressure::kId) {
      arm_pa = std::max(arm_pa, ArmPressure::decode(frame.data).arm_cap_pressure_pa.value);
    }
    if (frame.id == EcuStatus::kId) {
      lambda = std::min(lambda, EcuStatus::decode(frame.data).lambda.value);
    }
  }
};

TEST(soil_comes_and_goes_while_it_digs) {
  SimWatch sim("dig");
  assert_true(sim.run_to_active(1.0));
  sim.run(0.5);
  sim.bus.forget();
  DigSeen seen;
  sim.also = [&seen](const CanFrame& frame) { seen.see(frame); };
  // After the start the pumps give more than is needed.
  sim.run(30.0);
  seen = {};
  sim.run(30.0);
  const double without_pa = seen.arm_pa;
  sim.wish({{"do", "soil"}, {"value", true}});
  sim.run(60.0);
  assert_true(sim.state()["soil"] == true);
  assert_true(seen.arm_pa > without_pa + 3e6);
  // At any place of the path.
  for (int n = 0; n < 14; ++n) {
    sim.wish({{"do", "soil"}, {"value", n % 2 == 1}});
    sim.run(4.3);
  }
  sim.wish({{"do", "soil"}, {"value", false}});
  sim.run(30.0);
  seen = {};
  sim.run(30.0);
  assert_near(seen.arm_pa, without_pa, 1e6);
  assert_false(sim.bus.left_active);
}

TEST(a_rock_comes_loose_and_is_gone) {
  SimWatch sim("dig");
  assert_true(sim.run_to_active(1.0));
  DigSeen seen;
  sim.also = [&seen](const CanFrame& frame) { seen.see(frame); };
  for (int round = 0; round < 2; ++round) {
    seen = {};
    sim.wish({{"do", "obstacle"}, {"value", true}});
    sim.run(0.01);
    assert_true(sim.state()["obstacle"] == true);
    assert_true(sim.run_until(90.0, [&sim] { return !sim.state()["obstacle"].get<bool>(); }));
    assert_true(seen.lambda < 0.05);
    assert_true(sim.bus.mode == EcuMode::kActive);
  }
  sim.wish({{"do", "obstacle"}, {"value", true}});
  sim.run(0.01);
  sim.wish({{"do", "obstacle"}, {"value", false}});
  sim.run(5.0);
  assert_true(sim.state()["obstacle"] == false);
}

/// Where the dozer is, by what its bus says.
struct PositionSeen {
  double now_m = 0.0;
  double most_m = -1e3;

  void see(const CanFrame& frame) {
    using dbc::dozer::BodyPosition;
    if (frame.id == BodyPosition::kId) {
      now_m = BodyPosition::decode(frame.data).position_m.value;
      most_m = std::max(most_m, now_m);
    }
  }
};

TEST(restart_goes_back_and_time_goes_on) {
  SimWatch sim("grade");
  PositionSeen seen;
  sim.also = [&seen](const CanFrame& frame) { seen.see(frame); };
  sim.run(0.02);
  const double start_m = seen.now_m;
  sim.run(8.0);
  assert_true(seen.now_m > start_m + 2.0);
  sim.fault("track-speed", true);
  const TimeUs before_us = sim.session.now_us();
  sim.wish({{"do", "restart"}});
  sim.run(0.02);
  assert_near(seen.now_m, start_m, 0.01);
  assert_true(sim.session.now_us() == before_us + 20 * kMillisecondUs);
  assert_true(sim.state()["faults"] == json::array({"track-speed"}));
  sim.bus.forget();
  sim.run(8.0);
  // The fault is on on the new machine too.
  assert_true(sim.bus.was_degraded);
  assert_false(sim.bus.backwards);
  // Stopped it stays so.
  sim.wish({{"do", "stop"}});
  sim.wish({{"do", "restart"}});
  sim.run(1.0);
  assert_true(sim.bus.mode == EcuMode::kReady);
}

TEST(a_grade_begins_anew) {
  SimWatch sim("grade");
  PositionSeen seen;
  sim.also = [&seen](const CanFrame& frame) { seen.see(frame); };
  sim.run(0.02);
  const double start_m = seen.now_m;
  assert_true(
      sim.run_until(60.0, [&] { return seen.most_m > 20.0 && seen.now_m < start_m + 1.0; }));
  sim.run(5.0);
  assert_true(sim.bus.mode == EcuMode::kActive && seen.now_m > start_m + 1.0);
  assert_false(sim.bus.backwards);
}

/// From its start, where the machine stands at once: nothing has to be approached.
TEST(a_task_begins_anew) {
  SimWatch sim("autodig");
  int begun = 0;
  int jumps = 0;
  bool in_step = false;
  std::optional<double> swing_rad;
  sim.also = [&](const CanFrame& frame) {
    using dbc::excavator::SwingState;
    using dbc::excavator::TaskStatus;
    if (frame.id == TaskStatus::kId) {
      const auto kind = TaskStatus::decode(frame.data).step_kind.value;
      const bool now = kind == TaskStatus::StepKind::kDig;
      begun += now && !in_step ? 1 : 0;
      in_step = now;
    }
    if (frame.id == SwingState::kId) {
      const double now_rad = SwingState::decode(frame.data).swing_angle_rad.value;
      jumps += std::abs(now_rad - swing_rad.value_or(now_rad)) > 0.1 ? 1 : 0;
      swing_rad = now_rad;
    }
  };
  assert_true(sim.run_until(90.0, [&begun] { return begun == 3; }));
  assert_int_equal(jumps, 2);
  assert_false(sim.bus.backwards);
}

/// Frames of the same simulated time are the same, whatever the pace, but for measured times.
TEST(pace_changes_nothing_but_pace) {
  SimWatch one("dig");
  SimWatch other("dig");
  other.wish({{"do", "pace"}, {"value", 10}});
  one.run(2.0);
  other.run(2.0);
  assert_int_equal(one.session.now_us(), other.session.now_us());
  assert_int_equal(one.bus.frames, other.bus.frames);
  assert_near(other.session.pace(), 10.0, 0.0);
}
