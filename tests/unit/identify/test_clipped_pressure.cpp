// SPDX-License-Identifier: Apache-2.0
// Zeros and means of pressures that a sensor shows as 0 where they are less.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "app/identify/machine/clipped_pressure.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

using namespace graben::identify;

constexpr double kNoise_pa = 0.7e6;

std::vector<double> shown(double true_pa, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise_pa);
  std::vector<double> readings_pa;
  repeat(count, [&] { readings_pa.push_back(std::max(0.0, true_pa + noise(random))); });
  return readings_pa;
}

/// On average it is right on both sides of 0, and as far off as it says.
TEST(a_zero_is_found_on_both_sides) {
  for (const double zero_pa : {-0.8e6, -0.3e6, 0.0, 0.6e6, 1.2e6}) {
    double off_pa = 0.0;
    double squares = 0.0;
    constexpr int kTries = 400;
    for (unsigned seed = 1; seed <= kTries; ++seed) {
      const auto found = clipped_zero(shown(zero_pa, 60, seed), kNoise_pa);
      assert_true(found.has_value());
      off_pa += (found->value_pa - zero_pa) / kTries;
      squares += std::pow((found->value_pa - zero_pa) / found->deviation_pa, 2) / kTries;
    }
    assert_near(off_pa, 0.0, 0.03e6);
    assert_near(std::sqrt(squares), 1.0, 0.15);
  }
}

TEST(nothing_above_0_tells_no_zero) {
  assert_false(clipped_zero({}, kNoise_pa).has_value());
  assert_false(clipped_zero({0.0, 0.0, 0.0}, kNoise_pa).has_value());
}

/// What clipping adds to a mean is taken off again; away from 0 nothing changes.
TEST(a_mean_loses_what_clipping_added) {
  for (const double true_pa : {-0.8e6, -0.2e6, 0.5e6, 2.0e6}) {
    double sum_pa = 0.0;
    const std::vector<double> readings_pa = shown(true_pa, 20000, 5);
    for (const double reading_pa : readings_pa) {
      sum_pa += reading_pa;
    }
    const double mean_pa = sum_pa / static_cast<double>(readings_pa.size());
    assert_near(unclipped_mean(mean_pa, kNoise_pa), true_pa, 0.03e6);
  }
  assert_near(unclipped_mean(9e6, kNoise_pa), 9e6, 0.0);
  assert_near(unclipped_mean(0.2e6, 0.0), 0.2e6, 0.0);
  assert_near(unclipped_mean(0.0, kNoise_pa), -2.0 * kNoise_pa, 1.0);
}

/// Noise beside a slow change; readings near 0, which are clipped, do not count.
TEST(noise_is_told_from_a_slow_change) {
  MachineLog log;
  log.segments.resize(1);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, kNoise_pa);
  for (int at = 0; at < 4000; ++at) {
    log.segments[0].axis[1].cap_pa.push_back(12e6 + 3e6 * std::sin(0.01 * at) + noise(random));
    log.segments[0].axis[1].rod_pa.push_back(0.0);
  }
  assert_near(pressure_noise_pa({log}, 1), kNoise_pa, 0.05 * kNoise_pa);
  assert_near(pressure_noise_pa({log}, 0), 0.0, 0.0);
}
