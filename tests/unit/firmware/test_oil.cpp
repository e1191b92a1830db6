// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/excavator/estimation/oil/oil_cycle.hpp"
#include "firmware/excavator/estimation/oil/oil_law.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

const ExcavatorProfile& machine() { return test::excavator().profile; }

KinematicState state_at(double boom_m, double arm_m, double bucket_m) {
  return ExcavatorKinematics(machine().geometry).state({boom_m, arm_m, bucket_m});
}

std::array<LoadState, kDriveCount> pressed() {
  std::array<LoadState, kDriveCount> load{};
  load.fill({8e6, 5e6});
  return load;
}

OilModes modes_at(const KinematicState& now, double payload_kg = 0.0) {
  const std::array<LoadState, kDriveCount> load = pressed();
  return oil_modes(machine().oil, machine().geometry, now, {load.data(), 2}, payload_kg, 1.0);
}

/// x, y of the mass centre and angle of each link; the bucket is locked to the arm as it is at
/// `locked_m`.
std::array<Eigen::Vector3d, 3> bodies(const Eigen::Vector3d& strokes_m,
                                      const Eigen::Vector3d& locked_m) {
  const ExcavatorKinematics kinematics(machine().geometry);
  Eigen::Vector3d joints = kinematics.joints_from_strokes(strokes_m).joints_rad;
  joints[2] = kinematics.joints_from_strokes(locked_m).joints_rad[2];
  std::array<Eigen::Vector3d, 3> body;
  Eigen::Vector2d pin = Eigen::Vector2d::Zero();
  double angle = 0.0;
  const std::array<double, 3> length = {machine().geometry.boom_length_m,
                                        machine().geometry.arm_length_m, 0.0};
  for (unsigned i = 0; i < 3; ++i) {
    angle += joints[static_cast<int>(i)];
    const Eigen::Rotation2Dd turn(angle);
    const Eigen::Vector2d centre = pin + turn * machine().oil.link[i].centre_m;
    body[i] = {centre.x(), centre.y(), angle};
    pin += turn * Eigen::Vector2d(length[i], 0.0);
  }
  return body;
}

/// Kinetic energy of three rigid bodies, from where their mass centres are at strokes a little
/// further on.
double kinetic_j(const Eigen::Vector3d& strokes_m, const Eigen::Vector2d& speed_mps) {
  constexpr double kStep_s = 1e-5;
  Eigen::Vector3d way_m = Eigen::Vector3d::Zero();
  way_m.head<2>() = kStep_s * speed_mps;
  const auto before = bodies(strokes_m - way_m, strokes_m);
  const auto after = bodies(strokes_m + way_m, strokes_m);
  double energy_j = 0.0;
  for (unsigned i = 0; i < 3; ++i) {
    const Eigen::Vector3d rate = (after[i] - before[i]) / (2.0 * kStep_s);
    const LinkMass& link = machine().oil.link[i];
    energy_j += 0.5 * link.mass_kg * rate.head<2>().squaredNorm() +
                0.5 * link.inertia_kgm2 * rate[2] * rate[2];
  }
  return energy_j;
}

/// Force of the boom's cylinder that holds the links and what lies in the bucket's mass centre.
double holding_n(const Eigen::Vector3d& strokes_m, double carried_kg) {
  constexpr double kStep_m = 1e-5;
  const Eigen::Vector3d way_m(kStep_m, 0.0, 0.0);
  const auto below = bodies(strokes_m - way_m, strokes_m);
  const auto above = bodies(strokes_m + way_m, strokes_m);
  double force_n = 0.0;
  for (unsigned i = 0; i < 3; ++i) {
    const double mass_kg = machine().oil.link[i].mass_kg + (i == kBucket ? carried_kg : 0.0);
    force_n += 9.80665 * mass_kg * (above[i].y() - below[i].y()) / (2.0 * kStep_m);
  }
  return force_n;
}

TEST(what_is_carried_is_weighed) {
  for (const double arm_m : {0.3, 0.7, 1.0}) {
    const Eigen::Vector3d strokes_m(0.6, arm_m, 0.5);
    const KinematicState now = state_at(strokes_m[0], strokes_m[1], strokes_m[2]);
    const auto weighed_kg = [&](double carried_kg) {
      return payload_kg(machine().oil, machine().geometry, now, holding_n(strokes_m, carried_kg));
    };
    assert_near(weighed_kg(0.0), 0.0, 0.1);
    assert_near(weighed_kg(500.0), 1.6 * 500.0, 0.5);
    assert_near(weighed_kg(1000.0), 1.6 * 1000.0, 0.5);
    assert_near(weighed_kg(3000.0), 2000.0, 0.0);
    assert_near(weighed_kg(-3000.0), 0.0, 0.0);  // on the ground
  }
}

TEST(inertia_is_that_of_three_bodies) {
  for (const double arm_m : {0.3, 0.7, 1.2}) {
    const Eigen::Vector3d strokes_m(0.6, arm_m, 0.5);
    const KinematicState now = state_at(strokes_m[0], strokes_m[1], strokes_m[2]);
    const Eigen::Matrix2d inertia = stroke_inertia_kg(machine().oil, machine().geometry, now, 0.0);
    for (const Eigen::Vector2d& speed :
         {Eigen::Vector2d(0.1, 0.0), Eigen::Vector2d(0.0, 0.1), Eigen::Vector2d(0.1, -0.2)}) {
      const double energy_j = kinetic_j(strokes_m, speed);
      assert_near(0.5 * speed.dot(inertia * speed), energy_j, 1e-5 * energy_j);
    }
  }
}

TEST(modes_solve_their_equation) {
  const KinematicState now = state_at(0.6, 0.7, 0.5);
  const OilModes modes = modes_at(now);
  const Eigen::Matrix2d inertia = stroke_inertia_kg(machine().oil, machine().geometry, now, 0.0);
  assert_true(modes.omega_radps[0] > 0.0 && modes.omega_radps[0] < modes.omega_radps[1]);
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector2d shape = modes.shape.col(j);
    const Eigen::Vector2d spring = modes.stiffness_npm.cwiseProduct(shape);
    const double omega = modes.omega_radps[j];
    assert_true((spring - omega * omega * (inertia * shape)).norm() < 1e-9 * spring.norm());
    assert_near(shape.norm(), 1.0, 1e-12);
  }
  assert_true((modes.shape * modes.inverse - Eigen::Matrix2d::Identity()).norm() < 1e-12);
}

TEST(a_load_slows_both_modes) {
  const KinematicState now = state_at(0.6, 0.7, 0.5);
  const OilModes empty = modes_at(now);
  const OilModes loaded = modes_at(now, 1000.0);
  assert_true(loaded.omega_radps[0] < 0.95 * empty.omega_radps[0]);
  assert_true(loaded.omega_radps[1] < 0.999 * empty.omega_radps[1]);
}

TEST(an_empty_chamber_is_softer) {
  const CylinderGeometry& boom = machine().geometry.cylinder[kBoom];
  const auto stiffness = [&](double cap_pa, double rod_pa) {
    return oil_column_npm(machine().oil, boom, 2e-3, 0.6, {cap_pa, rod_pa});
  };
  assert_true(stiffness(8e6, 0.0) < 0.8 * stiffness(8e6, 5e6));
  assert_true(stiffness(0.0, 0.0) > 0.0);
  assert_near(stiffness(8e6, 5e6), stiffness(30e6, 20e6), 1e-6);
}

/// One mode of true frequency and lag with the observer and the feedback of an assumed one.
struct OneMode {
  double omega_radps;
  double lag_s;
  int late_cycles;
  Eigen::Vector3d state = Eigen::Vector3d::Zero();  // travel, speed, compression
  std::array<double, 2> lags{};
  std::array<double, 4> sent{};

  void step(double command_mps, double load_m) {
    sent = {command_mps, sent[0], sent[1], sent[2]};
    const double newest = newest_of_lag(lag_s);
    const double before = lags[1];
    lags[0] += newest * (sent[static_cast<unsigned>(late_cycles)] - lags[0]);
    lags[1] += newest * (lags[0] - lags[1]);
    const double flow = 0.5 * (before + lags[1]);
    const ModeTurn turn = mode_turn(omega_radps, kCyclePeriod_s);
    const double beyond = state[1] - flow;
    const double balance = state[2] + load_m;
    state = {state[0] + kCyclePeriod_s * flow + turn.travel_of_speed_s * beyond +
                 turn.travel_of_balance * balance,
             flow + turn.cosine * beyond + turn.speed_of_balance_ps * balance,
             turn.cosine * balance - turn.travel_of_speed_s * beyond - load_m};
  }
  [[nodiscard]] OilSeen seen(double asked_mps) const {
    OilSeen seen;
    seen.asked_mps[0] = asked_mps;
    seen.stroke_m[0] = state[0];
    seen.force_n[0] = state[2];
    seen.force_known = true;
    return seen;
  }
};

/// Both modes alike and not coupled, so that one is looked at.
OilModes plain_modes(double omega_radps) {
  OilModes modes;
  modes.omega_radps.setConstant(omega_radps);
  modes.stiffness_npm.setConstant(1.0);
  return modes;
}

constexpr double kPush_m = 0.005;
constexpr double kMostLeft_m = 0.4 * kPush_m;

/// Travel that is left of a step of the load, m, after this time.
double left_of_a_push_m(double assumed_radps, double true_radps, int late_cycles) {
  const OilGains gains{OilDesign{}};
  const OilModes modes = plain_modes(assumed_radps);
  OneMode plant{true_radps, 0.011, late_cycles};
  OilState state;
  double asked_mps = 0.0;
  double most_m = 0.0;
  for (int n = 0; n < 400; ++n) {
    next_oil(gains, modes, plant.seen(asked_mps), n > 0, true, state);
    asked_mps = oil_correction_mps(gains, modes, state, state.travel_m)[0];
    plant.step(asked_mps, n > 20 ? -kPush_m : 0.0);
    most_m = n > 300 ? std::max(most_m, std::abs(plant.state[0])) : most_m;
  }
  return most_m;
}

/// From oil of 0.6 GPa to 2 GPa where 0.8 GPa is assumed; up to 1.2 GPa with a cycle of delay
/// besides that is not told, and up to 1.7 GPa for all but the fastest modes. Nothing but the
/// feedback damps the mode.
TEST(a_push_is_undone_whatever_the_oil) {
  for (const double assumed_radps : {10.0, 15.0, 20.0, 25.0, 35.0, 45.0}) {
    for (const double oil_gpa : {0.6, 0.8, 1.0, 1.2, 1.7, 2.0}) {
      const double true_radps = assumed_radps * std::sqrt(oil_gpa / 0.8);
      assert_true(left_of_a_push_m(assumed_radps, true_radps, 0) < kMostLeft_m);
      const bool delayed = oil_gpa <= 1.2 || (oil_gpa <= 1.7 && assumed_radps <= 25.0);
      assert_true(!delayed || left_of_a_push_m(assumed_radps, true_radps, 1) < kMostLeft_m);
    }
  }
}

/// Where the margins end: stiff oil, a fast mode and a cycle that is not told, all at once.
TEST(beyond_its_margins_it_rings) {
  assert_true(left_of_a_push_m(45.0, 45.0 * std::sqrt(2.0), 1) > kMostLeft_m);
}

TEST(a_flow_error_is_learnt) {
  const OilGains gains{OilDesign{}};
  const OilModes modes = plain_modes(20.0);
  OneMode plant{20.0, 0.018, 0};
  OilState state;
  for (int n = 0; n < 600; ++n) {
    next_oil(gains, modes, plant.seen(0.0), n > 0, true, state);
    plant.step(0.01, 0.0);
  }
  assert_near(state.flow_error_mps[0], 0.01, 5e-4);
  assert_near(state.speed_mps[0], plant.state[1], 5e-4);
}

/// A drive at 7.4 mm a tenth of a second: its strokes come 0.7 or 0.8 mm further, and neither is a
/// load.
TEST(the_steps_of_a_stroke_are_no_load) {
  const OilGains gains{OilDesign{}};
  const OilModes modes = plain_modes(20.0);
  OilState state;
  double most_m = 0.0;
  for (int n = 0; n < 600; ++n) {
    OilSeen seen;
    seen.asked_mps[0] = 0.074;
    seen.stroke_m[0] = 1e-4 * std::round(7.4 * n);
    seen.stroke_step_m = 5e-5;
    seen.force_known = true;
    next_oil(gains, modes, seen, n > 0, true, state);
    most_m = n > 500 ? std::max(most_m, std::abs(state.load_n[0])) : most_m;
  }
  assert_true(most_m < 2e-4);
}

TEST(the_weight_moves_slowly_and_ends_with_a_fault) {
  const OilGains gains{OilDesign{}};
  const OilModes modes = plain_modes(20.0);
  OilState state;
  OilSeen seen;
  next_oil(gains, modes, seen, false, true, state);
  next_oil(gains, modes, seen, true, true, state);
  assert_near(state.weight, 0.02, 1e-12);
  repeat(100, [&] { next_oil(gains, modes, seen, true, true, state); });
  assert_near(state.weight, 1.0, 0.0);
  next_oil(gains, modes, seen, true, false, state);
  assert_near(state.weight, 0.98, 1e-12);
  next_oil(gains, modes, seen, false, true, state);
  assert_near(state.weight, 0.0, 0.0);
}

TEST(pressures_that_are_not_known_correct_nothing) {
  const OilGains gains{OilDesign{}};
  const OilModes modes = plain_modes(20.0);
  OilState state;
  OilSeen seen;
  next_oil(gains, modes, seen, false, true, state);
  seen.force_n[0] = 1e9;
  next_oil(gains, modes, seen, true, false, state);
  assert_near(state.force_n[0], 0.0, 1e-12);
  assert_near(state.travel_m[0], 0.0, 1e-12);
}

/// One side of boom or arm that is late or slow is enough to leave the oil to the servo; the
/// bucket, which has the servo always, does not count.
TEST(one_late_side_leaves_it_to_the_servo) {
  const auto quick = [](int drive, bool extends, double SaidAnswer::*time, double time_s) {
    ExcavatorProfile profile = machine();
    profile.valve.answer[static_cast<unsigned>(drive)].side(extends).*time = time_s;
    return are_quick(excavator_bank(profile).rows());
  };
  for (const bool extends : {true, false}) {
    for (const int drive : {kBoom, kArm}) {
      for (const auto& [time, most_s] : {std::pair{&SaidAnswer::dead_time_s, 0.05},
                                         {&SaidAnswer::lag_s, 0.1},
                                         {&SaidAnswer::spool_time_constant_s, 0.045}}) {
        assert_true(quick(drive, extends, time, most_s));
        assert_false(quick(drive, extends, time, most_s + 0.001));
      }
    }
    assert_true(quick(kBucket, extends, &SaidAnswer::dead_time_s, 0.2));
  }
}
