// SPDX-License-Identifier: Apache-2.0
/// Measures of calm, of signals whose result is known.

#include "app/runs/calm.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "firmware/numeric/constants.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::runs;

constexpr double kPerSecond = 1.0 / kSampled_s;

/// So many cycles of a signal of the time.
std::vector<double> sampled(int cycles, const std::function<double(double time_s)>& signal) {
  std::vector<double> values;
  for (int n = 0; n < cycles; ++n) {
    values.push_back(signal(kSampled_s * n));
  }
  return values;
}

double sine(double frequency_hz, double time_s) { return std::sin(kTwoPi * frequency_hz * time_s); }

/// A sine of 0.5 Hz and amplitude 2 goes 8 up and down in each period of 2 s.
TEST(a_sine_varies_by_four_amplitudes_a_period) {
  Variation variation;
  assert_near(variation.per_s(), 0.0, 0.0);
  for (const double value : sampled(1001, [](double t) { return 3.0 + 2.0 * sine(0.5, t); })) {
    variation.add(value);
  }
  assert_near(variation.time_s(), 10.0, 1e-9);
  assert_near(variation.per_s(), 4.0, 1e-3);
}

TEST(a_gap_is_no_variation) {
  Variation variation;
  for (const double value : {1.0, 1.5}) {
    variation.add(value);
  }
  variation.pause();
  for (const double value : {9.0, 8.5}) {
    variation.add(value);
  }
  assert_near(variation.time_s(), 2 * kSampled_s, 1e-12);
  assert_near(variation.per_s(), 0.5 * kPerSecond, 1e-9);
}

SpoolCalm spool_of(const std::vector<double>& travels) {
  SpoolCalm spool({0.1, 0.1});
  for (const double travel : travels) {
    spool.add(travel);
  }
  return spool;
}

/// 2 Hz for 10 s: 39 changes of side, of 0.6 each.
TEST(a_square_wave_reverses_twice_a_period) {
  const SpoolCalm spool =
      spool_of(sampled(1001, [](double t) { return sine(2.0, t + 1e-3) > 0.0 ? 0.3 : -0.3; }));
  assert_near(spool.reversals_ps(), 4.0, 1e-9);
  assert_near(spool.travel_ps(), 4.0 * 0.6, 1e-9);
}

/// Standing there, coming back out on the same side, and moving within it.
TEST(the_dead_band_is_no_side) {
  assert_near(spool_of({0.3, 0.05, -0.05, 0.0, 0.3}).reversals_ps(), 0.0, 0.0);
  assert_near(spool_of({-0.3, -0.05, 0.05, 0.0, -0.3}).reversals_ps(), 0.0, 0.0);
  assert_near(spool_of({0.09, -0.09, 0.1, -0.1}).reversals_ps(), 0.0, 0.0);
  // However long it stands between.
  assert_near(spool_of({0.3, 0.0, 0.0, 0.0, -0.11}).reversals_ps(), kPerSecond / 4, 1e-9);
  // To open for the first time is none.
  assert_near(spool_of({0.0, -0.3, -0.3}).reversals_ps(), 0.0, 0.0);
  assert_near(spool_of({}).reversals_ps(), 0.0, 0.0);
}

TEST(no_reversal_over_a_gap) {
  SpoolCalm spool = spool_of({0.3, 0.3});
  spool.pause();
  spool.add(-0.3);
  spool.add(-0.3);
  assert_near(spool.reversals_ps(), 0.0, 0.0);
  assert_near(spool.travel_ps(), 0.0, 0.0);
}

Jerk jerk_of(int cycles, const std::function<Eigen::Vector3d(double time_s)>& at_m) {
  Jerk jerk;
  for (int n = 0; n < cycles; ++n) {
    jerk.add(at_m(kSampled_s * n));
  }
  return jerk;
}

/// x = 2 t^3 has 12 m/s3, z = -t^3 / 6 has -1, and a parabola none.
TEST(a_cubic_has_its_jerk) {
  const auto cubic = [](double t) {
    return Eigen::Vector3d(2.0 * t * t * t, 5.0 * t * t + t, -t * t * t / 6.0);
  };
  assert_near(jerk_of(300, cubic).rms_mps3(), std::sqrt(145.0), 1e-5);
  assert_near(jerk_of(4, cubic).rms_mps3(), std::sqrt(145.0), 1e-5);
  assert_near(jerk_of(3, cubic).rms_mps3(), 0.0, 0.0);
}

/// Amplitude times (2 pi f)^3, over the root of 2. At 1 Hz the low-pass takes 1e-4 of it, the
/// difference over four cycles 5e-4.
TEST(a_sine_has_its_jerk) {
  const auto slow = [](double t) { return Eigen::Vector3d(0.0, 0.0, 0.01 * sine(1.0, t)); };
  const double known_mps3 = 0.01 * kTwoPi * kTwoPi * kTwoPi / std::sqrt(2.0);
  assert_near(jerk_of(1000, slow).rms_mps3(), known_mps3, 5e-3 * known_mps3);
  // A tenth of a millimetre at 40 Hz is 1100 m/s3.
  const auto shaken = [&](double t) {
    return Eigen::Vector3d(slow(t) + Eigen::Vector3d(1e-4 * sine(40.0, t), 0.0, 0.0));
  };
  assert_true(jerk_of(1000, shaken).rms_mps3() < 2.0 * known_mps3);
}

TEST(no_jerk_over_a_gap) {
  Jerk jerk;
  for (const double jump_m : {0.0, 1.0, -3.0}) {
    for (int n = 0; n < 50; ++n) {
      jerk.add({jump_m, 0.1 * n, 0.0});
    }
    jerk.pause();
  }
  assert_near(jerk.rms_mps3(), 0.0, 1e-7);
}

/// The low-pass leaves 1 / (1 + (f / 1 Hz)^4) of each sine.
TEST(only_what_is_fast_rings) {
  const auto both = [](double t) { return 0.02 * sine(3.0, t + 0.07) + 0.5 * sine(0.2, t); };
  const auto fast = [](double t) { return 0.02 * sine(3.0, t + 0.07); };
  const double known = 0.02 / std::sqrt(2.0);
  assert_near(ringing_rms(sampled(3000, fast), 1.0), known, 0.02 * known);
  assert_near(ringing_rms(sampled(3000, both), 1.0), known, 0.03 * known);
  // Half of the cutoff's own.
  const auto at_cutoff = [](double t) { return sine(1.0, t); };
  assert_near(ringing_rms(sampled(6000, at_cutoff), 1.0), 0.5 / std::sqrt(2.0), 0.005);
}

/// A record that begins and ends far from 0, on a slope: the filter must not ring of that.
TEST(the_ends_do_not_ring) {
  for (const int cycles : {1, 2, 5, 100, 3000}) {
    const std::vector<double> level(static_cast<std::size_t>(cycles), 4.0);
    assert_near(ringing_rms(level, 1.0), 0.0, 1e-9);
  }
  for (const int cycles : {400, 3000}) {
    const auto ramp = sampled(cycles, [](double t) { return 4.0 - 0.3 * t; });
    assert_near(ringing_rms(ramp, 1.0), 0.0, 1e-6);
  }
  assert_near(ringing_rms({}, 1.0), 0.0, 0.0);
  // Where it bends, a tenth of the amplitude at most.
  const std::vector<double> half =
      sampled(251, [](double t) { return 0.5 * std::cos(kTwoPi * 0.2 * t); });
  const std::vector<double> slow = slow_part(half, 1.0);
  for (std::size_t n = 0; n < half.size(); ++n) {
    assert_near(slow[n], half[n], 0.05);
  }
}

/// Forwards and backwards: what is symmetric stays so, and in its place.
TEST(nothing_is_late) {
  const auto bump = [](double t) { return std::exp(-(t - 5.0) * (t - 5.0)); };
  const std::vector<double> slow = slow_part(sampled(1001, bump), 1.0);
  for (std::size_t n = 0; n < 500; ++n) {
    assert_near(slow[n], slow[1000 - n], 1e-6);
  }
  assert_true(slow[500] > slow[499] && slow[500] > slow[501]);
}
