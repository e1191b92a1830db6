// SPDX-License-Identifier: Apache-2.0
// The margins' own tests: loops whose margins are known by hand, modes that the plant rings with,
// and runs in time that fade and grow as the eigenvalues say.

#include <cmath>
#include <cstdio>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "tests/margins/loop_margins.hpp"
#include "tests/margins/shipped_law.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::margins;

const machines::SimulatedExcavator& machine() {
  static const machines::SimulatedExcavator is =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  return is;
}

// Tip at (4.5, -1.0) m, as in test_modes.cpp.
const Eigen::Vector3d& middle_m() {
  static const Eigen::Vector3d strokes_m(1.073, 1.213, 0.459);
  return strokes_m;
}

Truth truth_of(double oil_gpa, double lag_s, int late_cycles) {
  Truth truth;
  truth.bulk_modulus_pa = 1e9 * oil_gpa;
  truth.spool_time_constant_s = lag_s;
  truth.late_cycles = late_cycles;
  return truth;
}

/// Two channels by themselves, L = k / (z - 1) of each.
Discrete two_sums() {
  Discrete sums;
  sums.a = sums.b = sums.c = Eigen::Matrix2d::Identity();
  sums.d = Eigen::Matrix2d::Zero();
  return sums;
}

/// The same with a cycle more: L = k / (z (z - 1)).
Discrete two_late_sums() {
  Discrete sums;
  sums.a = Eigen::Matrix4d::Zero();
  sums.a.topLeftCorner(2, 2).setIdentity();
  sums.a.topRightCorner(2, 2).setIdentity();
  sums.b = Eigen::MatrixXd::Zero(4, 2);
  sums.b.bottomRows(2).setIdentity();
  sums.c = Eigen::MatrixXd::Zero(2, 4);
  sums.c.leftCols(2).setIdentity();
  sums.d = Eigen::Matrix2d::Zero();
  return sums;
}

Discrete plain_gain(double gain) {
  Discrete law;
  law.a = Eigen::Matrix2d::Zero();
  law.b = law.c = Eigen::Matrix2d::Zero();
  law.d = -gain * Eigen::Matrix2d::Identity();
  return law;
}

/// S - T = (z - 1 - k) / (z - 1 + k) is farthest out at Nyquist's frequency, z = -1.
TEST(a_sum_has_the_margins_that_a_hand_finds) {
  const LoopMargins margins = loop_margins(plain_gain(0.5), two_sums());
  assert_near(margins.spectral_radius, 0.5, 1e-12);
  for (const ChannelMargin& channel : margins.channel) {
    assert_near(channel.alpha, 2.0 * 1.5 / 2.5, 1e-6);
    assert_near(channel.at_hz, 50.0, 0.1);
  }
  assert_true(!loop_margins(plain_gain(2.01), two_sums()).stable());
  assert_near(loop_margins(plain_gain(2.01), two_sums()).alpha(), 0.0, 0.0);
}

/// z (z - 1) + k has its roots on the circle at k = 1; |L| is 1 where 2 sin(turn / 2) is k.
TEST(a_late_sum_too) {
  constexpr double kGain = 0.4;
  const LoopMargins margins = loop_margins(plain_gain(kGain), two_late_sums());
  const double turn = 2.0 * std::asin(0.5 * kGain);
  for (const ChannelMargin& channel : margins.channel) {
    assert_near(channel.gain_up, 1.0 / kGain, 0.02);
    assert_near(channel.phase_rad, 0.5 * std::acos(-1.0) - 1.5 * turn, 0.01);
    // What the disk promises of gain alone is no more than there is.
    const double promised = (2.0 + channel.alpha) / (2.0 - channel.alpha);
    assert_true(promised > 1.5 && promised < 1.0 / kGain);
    assert_near(gain_db(channel.alpha), 20.0 * std::log10(promised), 1e-9);
  }
}

/// Those that the plant's own ring has, test_modes.cpp.
TEST(modes_are_those_of_the_plant) {
  const Eigen::Vector3d real = modes_hz(machine().plant, middle_m(), truth_of(1.4, 0.02, 0));
  assert_near(real[0], 3.1, 0.1);
  assert_near(real[1], 5.5, 0.2);
  const Eigen::Vector3d stiff = modes_hz(machine().plant, middle_m(), truth_of(10.0, 0.02, 0));
  assert_near(stiff[0], 8.3, 0.3);
  assert_near(stiff[1], 14.8, 0.5);
  Truth heavy = truth_of(1.4, 0.02, 0);
  heavy.mass_ratio = 4.0;
  assert_near(modes_hz(machine().plant, middle_m(), heavy)[0], 0.5 * real[0], 1e-9);
}

/// Led by a duty of 1 m/s for a second, what has flowed is a metre, less what the spool lags.
TEST(a_duty_becomes_flow) {
  for (const int late_cycles : {0, 2}) {
    const Discrete truth =
        linkage_on_oil(machine().plant, middle_m(), truth_of(1.4, 0.02, late_cycles));
    Eigen::VectorXd state = Eigen::VectorXd::Zero(truth.a.rows());
    for (int n = 0; n < 100; ++n) {
      state = truth.a * state + truth.b * Eigen::Vector2d(1.0, 0.0);
    }
    assert_near(state[6], 1.0 - 2.0 * 0.02 - 0.01 * late_cycles, 1e-6);
    assert_near(state[7], 0.0, 1e-9);
  }
}

/// The firmware's functions around the truth, in time: log of how far off it is after so long. It
/// begins with so little that what grows meets no limit.
double far_off(const LawInTime& law, const Discrete& truth, int from, int cycles) {
  Eigen::VectorXd state = Eigen::VectorXd::Zero(truth.a.rows());
  state.head<2>() << 1e-9, -1e-9;
  LawInTime::State held = LawInTime::State::Zero();
  double squares = 0.0;
  for (int n = 0; n < from + cycles; ++n) {
    const Eigen::Vector2d duty = law.step(truth.c * state, held);
    state = truth.a * state + truth.b * duty;
    squares += n >= from ? state.head<3>().squaredNorm() : 0.0;
  }
  return 0.5 * std::log(squares);
}

/// Runs in time fade, or grow, as the eigenvalues of the matrices say. What the bucket's servo
/// takes back, at 2 / s, no duty excites.
TEST(runs_in_time_go_as_the_eigenvalues_say) {
  const OilGains gains{OilDesign{}};
  const LawInTime law(machine().profile, gains, middle_m());
  const Discrete matrices = as_matrices(law);
  const double servo_ps = machine().profile.control.servo_gain_ps;
  int compared = 0;
  int unstable = 0;
  for (const double oil_gpa : {0.6, 1.0, 1.4, 1.7, 2.0}) {
    for (const double lag_s : {0.015, 0.020, 0.040}) {
      const Discrete truth =
          linkage_on_oil(machine().plant, middle_m(), truth_of(oil_gpa, lag_s, 1));
      const double expected_ps = -decay_ps(loop_margins(matrices, truth).spectral_radius);
      constexpr int kLater = 300;
      const double seen_ps =
          (far_off(law, truth, 600, 200) - far_off(law, truth, 600 - kLater, 200)) /
          (0.01 * kLater);
      if (expected_ps > -0.99 * servo_ps) {
        assert_near(seen_ps, expected_ps, 0.03 * std::abs(expected_ps) + 0.02);
        ++compared;
        unstable += expected_ps > 0.0 ? 1 : 0;
      } else {
        assert_true(seen_ps < -0.9 * servo_ps);
      }
    }
  }
  std::printf("%d runs compared, %d of them unstable\n", compared, unstable);
  assert_true(unstable >= 3 && compared - unstable >= 3);
}

/// The law's matrices are the law.
TEST(matrices_step_as_the_law_does) {
  const OilGains gains{OilDesign{}};
  const LawInTime law(machine().profile, gains, middle_m());
  const Discrete matrices = as_matrices(law);
  LawInTime::State state = LawInTime::State::Zero();
  Eigen::VectorXd linear = state;
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector4d seen = 1e-5 * Eigen::Vector4d(std::sin(n), 1.0, std::cos(3 * n), -0.5);
    const Eigen::Vector2d expected = matrices.c * linear + matrices.d * seen;
    linear = matrices.a * linear + matrices.b * seen;
    assert_true((law.step(seen, state) - expected).norm() < 1e-9);
    assert_true((state - linear).norm() < 1e-8);
  }
}

/// Oil that is assumed too stiff, and a gain that is too large, are told.
TEST(what_is_wrong_is_told) {
  const OilGains gains{OilDesign{}};
  const Discrete soft = linkage_on_oil(machine().plant, middle_m(), truth_of(0.6, 0.02, 0));
  const auto alpha = [&](double assumed_gpa, double gain) {
    ExcavatorProfile profile = machine().profile;
    profile.oil.bulk_modulus_pa = 1e9 * assumed_gpa;
    Discrete law = as_matrices(LawInTime(profile, gains, middle_m()));
    law.c *= gain;
    law.d *= gain;
    return loop_margins(law, soft).alpha();
  };
  const double sound = alpha(0.8, 1.0);
  assert_true(sound > 0.3);
  assert_true(alpha(2.0, 1.0) < 0.3 * sound);
  assert_near(alpha(0.8, 3.0), 0.0, 0.0);
}
