// SPDX-License-Identifier: Apache-2.0
// What is said of figures over days: growth that is more than noise, and nothing of noise alone.

#include <functional>
#include <random>

#include "app/identify/drift/work_order.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::identify;

constexpr double kDay_s = 86400.0;
constexpr double kBegin_s = 1788336000.0;  // 2 September 2026.

/// One figure of the arm on each day, as its logs know it.
std::vector<FigureDrift> drifting(Wears what, double unit, std::size_t days,
                                  const std::function<double(double)>& at, double deviation) {
  std::vector<DayFigures> all;
  for (std::size_t day = 0; day < days; ++day) {
    DayFigures of;
    of.time_s = kBegin_s + kDay_s * static_cast<double>(day);
    of.figures.push_back(
        {what, "arm", {unit * at(static_cast<double>(day)), unit * deviation, true}});
    all.push_back(of);
  }
  return drifts_of(all);
}

std::vector<FigureDrift> creeping(std::size_t days, const std::function<double(double)>& at,
                                  double deviation = 0.03) {
  return drifting(Wears::kCreep, 1e-12, days, at, deviation);
}

TEST(growth_is_an_order_in_plain_words) {
  std::mt19937 dice(3);
  std::normal_distribution<double> noise(0.0, 0.05);
  const auto drifts = creeping(10, [&](double day) { return 1.0 + 2.0 * day / 9.0 + noise(dice); });
  const auto orders = work_orders(drifts);
  assert_int_equal(orders.size(), 1);
  assert_true(orders[0].find("arm: leakage (it creeps while closed) 3.0 times") == 0 ||
              orders[0].find("arm: leakage (it creeps while closed) 2.9 times") == 0);
  assert_true(orders[0].find("that of 2 September 2026; beyond its noise from ") !=
              std::string::npos);
  assert_true(orders[0].find("look at the piston's seal") != std::string::npos);
  // By half of the final size.
  assert_true(*drifts[0].first_beyond_s <= kBegin_s + 5.0 * kDay_s);
}

/// Touches of one day's log are 0.3 mm off; 5 mm in ten days are seen by half of them.
TEST(a_zero_that_shifts_is_seen_by_half_of_it) {
  std::mt19937 dice(5);
  std::normal_distribution<double> noise(0.0, 0.15);
  int seen = 0;
  for (int machine = 0; machine < 100; ++machine) {
    const auto shifting = [&](double final_mm) {
      return drifting(
          Wears::kStrokeZero, 1e-3, 10,
          [&](double day) { return final_mm * day / 9.0 + noise(dice); }, 0.3);
    };
    const auto five = shifting(5.0)[0].first_beyond_s;
    seen += five && *five <= kBegin_s + 5.0 * kDay_s ? 1 : 0;
    assert_false(shifting(0.0)[0].first_beyond_s.has_value());
  }
  assert_true(seen >= 90);
}

TEST(noise_is_none_and_one_bad_log_neither) {
  std::mt19937 dice(4);
  std::normal_distribution<double> noise(0.0, 0.2);
  for (int machine = 0; machine < 300; ++machine) {
    const auto drifts = creeping(
        30, [&](double /*day*/) { return 1.0 + noise(dice); }, 0.4);
    assert_false(drifts[0].first_beyond_s.has_value());
    assert_true(work_orders(drifts).empty());
  }
  for (const double bad : {0.0, 5.0, 9.0}) {
    const auto drifts = creeping(10, [&](double day) { return day == bad ? 4.0 : 1.0; });
    assert_false(drifts[0].first_beyond_s.has_value());
  }
}

TEST(what_few_logs_say_is_no_trend) {
  const auto grows = [](double day) { return 1.0 + day; };
  assert_false(creeping(4, grows)[0].trend.known);
  assert_true(creeping(5, grows)[0].is_beyond);
  // Small, however sure.
  assert_false(creeping(30, [](double day) { return 1.0 + 0.01 * day; })[0].is_beyond);
}
