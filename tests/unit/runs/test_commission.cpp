// SPDX-License-Identifier: Apache-2.0
// Commissioning over the bus, on the simulated 22 t excavator: what stops it, and that it goes on.

#include <functional>

#include "tests/unit/runs/hands_rig.hpp"

using test::HandsRig;

const Eigen::Vector3d kStart_m(0.7, 0.7, 0.5);
constexpr double kDuty = 0.5;

/// Windows of 0.25 m each way about where each drive stands.
struct Station : HandsRig {
  explicit Station(const machines::SimulatedExcavator& machine = test::excavator(),
                   const Eigen::Vector3d& start_m = kStart_m)
      : HandsRig(machine, start_m, Task::kCommission) {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      hands.window[i] = StrokeWindow{start_m[i] - 0.25, start_m[i] + 0.25, 0.5};
    }
    work();
  }

  /// A duty until a fault, or for so long; how far the drives have then gone at most.
  Eigen::Vector3d try_duty(unsigned axis, double duty, double time_s) {
    const Eigen::Vector3d from_m = strokes_m();
    Eigen::Vector3d farthest_m = Eigen::Vector3d::Zero();
    hands.tried_ratio[axis] = duty;
    for (double at_s = 0.0; at_s < time_s && status().fault == Fault::kNone; at_s += 0.01) {
      cycle();
      farthest_m = farthest_m.cwiseMax((strokes_m() - from_m).cwiseAbs());
    }
    return farthest_m;
  }
  /// A fault that stops: neutral, latched, and after the cure the machine works again.
  void expect_stop(std::initializer_list<Fault> any, const std::function<void()>& cure) {
    assert_true(std::count(any.begin(), any.end(), status().fault) == 1);
    assert_int_equal(status().mode, EcuMode::kFault);
    assert_true(neutral());
    cure();
    run(1.0);
    assert_int_equal(status().mode, EcuMode::kFault);
    work_again();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      hands.window[i] = StrokeWindow{strokes_m()[i] - 0.2, strokes_m()[i] + 0.2, 0.5};
    }
    run(0.5);
    const Eigen::Vector3d moved_m = try_duty(kArm, -0.4, 0.8);
    assert_int_equal(status().fault, Fault::kNone);
    assert_true(moved_m[kArm] > 0.01);
  }
};

TEST(a_duty_moves_its_drive_and_no_other) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double duty : {0.4, -0.4}) {
      Station rig;
      const Eigen::Vector3d from_m = rig.strokes_m();
      const Eigen::Vector3d moved_m = rig.try_duty(axis, duty, 1.0);
      assert_int_equal(rig.status().fault, Fault::kNone);
      assert_near(rig.ecu->outputs().duty_ratio[axis], duty, 1e-4);
      assert_near(rig.status().lambda, 1.0, 0.0);
      assert_true((rig.strokes_m()[axis] - from_m[axis]) * duty > 0.0);
      for (unsigned i = 0; i < kAxisCount; ++i) {
        assert_true(i == axis ? moved_m[i] > 0.01 : moved_m[i] < 0.005);
      }
      rig.hands.tried_ratio = {};
      rig.run(0.05);
      assert_near(rig.ecu->outputs().duty_ratio[axis], 0.0, 0.0);
      // Closed, it stays.
      rig.run(1.0);
      const Eigen::Vector3d closed_m = rig.strokes_m();
      rig.run(3.0);
      assert_true((rig.strokes_m() - closed_m).norm() < 0.003);
      assert_int_equal(rig.status().mode, EcuMode::kActive);
    }
  }
}

/// A machine of which the profile knows little is not stopped: edges, exponents, dead times, lags.
TEST(a_sound_machine_nobody_knows_is_not_stopped) {
  struct Found {
    double edge;
    double exponent;
    double dead_s;
    double lag_s;
  };
  for (const Found& found : {Found{0.10, 1.3, 0.0, 0.015}, Found{0.10, 1.9, 0.25, 0.15},
                             Found{0.55, 1.3, 0.25, 0.15}, Found{0.55, 1.9, 0.10, 0.05}}) {
    machines::SimulatedExcavator machine = test::excavator();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      machine.plant.spool[i].extend = {found.edge, 0.0, found.exponent};
      machine.plant.spool[i].retract = {found.edge, 0.0, found.exponent};
      machine.plant.spool[i].time_constant_s = found.lag_s;
      machine.plant.dead_time[i] = {found.dead_s, found.dead_s};
    }
    for (unsigned axis = 0; axis < kAxisCount; ++axis) {
      Station rig(machine);
      for (const double duty : {0.35, -0.35, 0.6, -0.6, 0.75, -0.75, 0.0}) {
        rig.try_duty(axis, duty, 1.2);
      }
      for (int n = 0; n < 16; ++n) {
        rig.try_duty(axis, n % 2 == 0 ? 0.7 : -0.7, 0.15);
      }
      rig.try_duty(axis, 0.0, 2.0);
      assert_int_equal(rig.status().fault, Fault::kNone);
      // Let go of in motion, its spool closes late and is not stuck.
      rig.try_duty(axis, -0.75, 0.8);
      rig.release();
      rig.run(2.0);
      assert_int_equal(rig.status().fault, Fault::kNone);
      assert_int_equal(rig.status().mode, EcuMode::kReady);
    }
  }
}

TEST(the_window_holds) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double side : {1.0, -1.0}) {
      Station rig;
      const double moved_m = rig.try_duty(axis, side * 0.8, 14.0)[axis];
      assert_int_equal(rig.status().fault, Fault::kNone);
      assert_int_equal(rig.status().limit.kind, LimitKind::kStrokeEnd);
      assert_int_equal(rig.status().limit.index, axis);
      assert_true(moved_m > 0.1 && moved_m < 0.26);
      const double there_m = rig.strokes_m()[axis];
      rig.try_duty(axis, side * -0.6, 1.0);
      assert_true((there_m - rig.strokes_m()[axis]) * side > 0.01);
    }
  }
}

TEST(without_a_fresh_window_nothing_moves) {
  Station rig;
  rig.driver.faults().set_silent(dbc::excavator::CommissionWindow::kId, true);
  rig.run(1.1);
  assert_true(rig.try_duty(kArm, 0.6, 1.0).norm() < 0.002);
  assert_int_equal(rig.status().fault, Fault::kNone);
  rig.driver.faults().set_silent(dbc::excavator::CommissionWindow::kId, false);
}

/// Within 50 mm, in whatever duty; the pilot pressure goes.
TEST(a_reversed_valve) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double duty : {kDuty, -kDuty, 0.8, -0.8}) {
      Station rig;
      rig.plant.faults().axis[axis].reversed = true;
      assert_true(rig.try_duty(axis, duty, 8.0)[axis] < 0.05);
      assert_true(rig.ecu->outputs().pilot_cut);
      rig.expect_stop({Fault::kWrongDirection},
                      [&] { rig.plant.faults().axis[axis].reversed = false; });
    }
  }
}

TEST(swapped_sensors) {
  for (const unsigned axis : {0U, 1U}) {
    for (const double duty : {kDuty, -kDuty}) {
      Station rig;
      rig.plant.faults().stroke_from = {1, 0, 2};
      assert_true(rig.try_duty(axis, duty, 8.0)[axis] < 0.05);
      rig.expect_stop({Fault::kUncommandedMotion}, [&] {
        rig.plant.faults().stroke_from = {0, 1, 2};
      });
    }
  }
}

/// Known by the pressures, except of a boom that rises; that by the bound of what may be tried.
TEST(a_stuck_sensor) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double duty : {0.4, -0.4}) {
      Station rig;
      rig.plant.faults().axis[axis].stroke.stuck = true;
      const double moved_m = rig.try_duty(axis, duty, 12.0)[axis];
      assert_true(moved_m < 0.6);
      rig.expect_stop({Fault::kStrokeStuck}, [&] { rig.plant.faults().axis[axis].stroke = {}; });
    }
  }
}

/// One that hangs after its drive has moved is known by that.
TEST(a_sensor_that_gets_stuck) {
  Station rig;
  rig.try_duty(kBoom, 0.4, 2.0);
  rig.try_duty(kBoom, 0.0, 1.5);
  assert_int_equal(rig.status().fault, Fault::kNone);
  rig.plant.faults().axis[kBoom].stroke.stuck = true;
  assert_true(rig.try_duty(kBoom, 0.6, 6.0)[kBoom] < 0.12);
  rig.expect_stop({Fault::kStrokeStuck}, [&] { rig.plant.faults().axis[kBoom].stroke = {}; });
}

TEST(the_engine_stops) {
  Station rig;
  rig.try_duty(kArm, 0.4, 0.5);
  rig.plant.faults().engine_ratio = 0.0;
  rig.try_duty(kArm, 0.4, 1.0);
  rig.expect_stop({Fault::kEngineStopped}, [&] { rig.plant.faults().engine_ratio = 1.0; });
}

TEST(the_operator_lets_go) {
  Station rig;
  rig.try_duty(kArm, 0.4, 0.5);
  rig.release();
  rig.run(0.03);
  assert_true(rig.neutral());
  assert_int_equal(rig.status().mode, EcuMode::kReady);
  assert_int_equal(rig.status().fault, Fault::kNone);
  // Spools that close late are not stuck.
  rig.run(1.0);
  assert_int_equal(rig.status().fault, Fault::kNone);
  rig.work_again();
}

TEST(duties_that_are_silent) {
  Station rig;
  rig.try_duty(kArm, 0.4, 0.5);
  rig.driver.faults().set_silent(dbc::excavator::CommissionDuty::kId, true);
  rig.try_duty(kArm, 0.4, 0.07);
  rig.expect_stop({Fault::kOperatorMissing}, [&] {
    rig.driver.faults().set_silent(dbc::excavator::CommissionDuty::kId, false);
  });
}

TEST(the_bus_is_gone) {
  Station rig;
  rig.try_duty(kArm, 0.4, 0.5);
  rig.ecu_port.set_state(CanPortState::kDown);
  rig.try_duty(kArm, 0.4, 0.05);
  // Nobody hears the controller: the valve side closes by itself.
  rig.run(0.15);
  assert_false(rig.plant.spools_enabled());
  rig.expect_stop({Fault::kBusDown}, [&] { rig.ecu_port.set_state(CanPortState::kClosed); });
}

/// Against a rock in its window's middle.
TEST(a_blocked_cylinder) {
  machines::Scenario scenario;
  scenario.obstacle = true;
  machines::SimulatedExcavator machine = machines::arranged(test::excavator(), scenario);
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  plant::ObstacleProfile& rock = *machine.plant.obstacle;
  rock.hold_s = 1e4;
  const TipPose tip = kinematics.state(kStart_m).tip;
  rock.point_m = {tip.x_m - 0.3, tip.y_m};
  rock.normal = Eigen::Vector2d::UnitX();
  rock.size_m = 3.0;
  Station rig(machine);
  const double moved_m = rig.try_duty(kArm, kDuty, 8.0)[kArm];
  assert_true(moved_m > 0.01 && moved_m < 0.2);
  rig.expect_stop({Fault::kStrokeStuck}, [&] { rig.hands.tried_ratio = {}; });
}

/// Two at once at most.
TEST(three_duties_are_refused) {
  Station rig;
  rig.hands.tried_ratio = {0.4, 0.4, 0.0};
  rig.run(0.5);
  assert_int_equal(rig.status().fault, Fault::kNone);
  rig.hands.tried_ratio[2] = 0.4;
  rig.run(0.1);
  rig.expect_stop({Fault::kCommissionBound}, [] {});
}

TEST(too_fast_for_its_window) {
  Station rig;
  rig.hands.window[kArm]->most_mps = 0.05;
  rig.run(0.5);
  assert_true(rig.try_duty(kArm, -0.7, 4.0)[kArm] < 0.05);
  rig.expect_stop({Fault::kCommissionBound}, [] {});
}

/// The swing's lever is its duty, of which the profile's watches ask nothing; while a link is tried
/// it is neutral.
TEST(a_duty_turns_the_swing_while_nothing_else_is_tried) {
  for (const double duty : {0.5, -0.5}) {
    const machines::SimulatedExcavator& machine = test::excavator_12t();
    Station rig(machine, Eigen::Vector3d(0.5, 0.6, 0.4));
    rig.hands.lever_ratio[kSwing] = duty;
    rig.run(1.0);
    assert_int_equal(rig.status().fault, Fault::kNone);
    assert_near(rig.ecu->outputs().duty_ratio[kSwing], duty, 0.01);
    assert_true(rig.plant.plant().swing_rad() * duty > 0.02);
    rig.hands.tried_ratio[kBucket] = 0.3;
    rig.run(0.3);
    assert_near(rig.ecu->outputs().duty_ratio[kSwing], 0.0, 0.0);
    rig.hands.tried_ratio[kBucket] = 0.0;
    rig.hands.lever_ratio[kSwing] = 0.0;
    rig.run(1.5);
    const double stands_rad = rig.plant.plant().swing_rad();
    rig.run(1.0);
    assert_near(rig.plant.plant().swing_rad(), stands_rad, 0.003);
    assert_int_equal(rig.status().fault, Fault::kNone);
  }
}
