#include <limits>

#include "firmware/safety/gate.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace {

using namespace graben;

constexpr double kLong_s = 1.0;  // Longer than any rate limit needs.

const ExcavatorProfile& profile() { return test::excavator().profile; }
double travel() { return profile().valve.spool_travel_m; }

void duty_follows_the_profiles_table(void**) {
  const GateResult result = gate(profile(), {}, true, {travel(), -0.5 * travel(), 0.0}, kLong_s);
  assert_true(result.enable);
  assert_near(result.duty_ratio[0], 1.0, 1e-12);
  assert_near(result.duty_ratio[1], -0.6, 1e-12);
  assert_near(result.duty_ratio[2], 0.0, 0.0);
}

void a_spool_hardly_open_stays_neutral(void**) {
  const double threshold = profile().control.spool_threshold;
  const GateResult below =
      gate(profile(), {}, true, {0.9 * threshold * travel(), 0.0, 0.0}, kLong_s);
  assert_near(below.duty_ratio[0], 0.0, 0.0);
  const GateResult above =
      gate(profile(), {}, true, {1.1 * threshold * travel(), 0.0, 0.0}, kLong_s);
  assert_true(above.duty_ratio[0] >= 0.2);
}

void positions_beyond_the_travel_are_clamped(void**) {
  const GateResult result =
      gate(profile(), {}, true, {9.0 * travel(), -9.0 * travel(), 0.0}, kLong_s);
  assert_near(result.duty_ratio[0], 1.0, 1e-12);
  assert_near(result.duty_ratio[1], -1.0, 1e-12);
}

void changes_are_limited_in_rate(void**) {
  const double step = profile().control.spool_rate_ps * 0.01;
  const GateResult first = gate(profile(), {}, true, {travel(), 0.0, 0.0}, 0.01);
  assert_near(first.state.opening[0].value(), step, 1e-12);
  const GateResult second = gate(profile(), first.state, true, {travel(), 0.0, 0.0}, 0.01);
  assert_near(second.state.opening[0].value(), 2.0 * step, 1e-12);
  const GateResult still = gate(profile(), first.state, true, {travel(), 0.0, 0.0}, 0.0);
  assert_near(still.state.opening[0].value(), step, 1e-12);
}

/// Towards neutral a spool goes at once; a reversal opens from neutral.
void closing_is_never_delayed(void**) {
  GateState open;
  open.opening = {Guarded(1.0), Guarded(-1.0), Guarded(1.0)};
  const double step = profile().control.spool_rate_ps * 0.01;
  const GateResult result = gate(profile(), open, true, {0.1 * travel(), 0.0, -travel()}, 0.01);
  assert_near(result.state.opening[0].value(), 0.1, 1e-12);
  assert_near(result.state.opening[1].value(), 0.0, 0.0);
  assert_near(result.duty_ratio[1], 0.0, 0.0);
  assert_near(result.state.opening[2].value(), -step, 1e-12);
}

/// A spool that is to be closed has duty 0, whatever the threshold.
void closed_is_duty_zero(void**) {
  ExcavatorProfile keen = profile();
  keen.control.spool_threshold = 0.0;
  const GateResult result = gate(keen, {}, true, {0.0, -0.0, 0.0}, 0.01);
  for (const double duty : result.duty_ratio) {
    assert_near(duty, 0.0, 0.0);
  }
}

/// Neutral knows no rate: not active closes everything in the same cycle.
void not_active_is_neutral_at_once(void**) {
  GateState open;
  open.opening = {Guarded(1.0), Guarded(-1.0), Guarded(0.5)};
  const GateResult result = gate(profile(), open, false, {travel(), travel(), travel()}, 0.01);
  assert_false(result.enable);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_near(result.duty_ratio[i], 0.0, 0.0);
    assert_near(result.state.opening[i].value(), 0.0, 0.0);
  }
}

void what_is_no_number_is_refused(void**) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      std::array<double, kAxisCount> spool = {travel(), travel(), travel()};
      spool[i] = bad;
      const GateResult result = gate(profile(), {}, true, spool, 0.01);
      assert_false(result.enable);
      assert_int_equal(result.fault, Fault::kCommandNotFinite);
      for (const double duty : result.duty_ratio) {
        assert_near(duty, 0.0, 0.0);
      }
    }
  }
  const GateResult timeless = gate(profile(), {}, true, {0.0, 0.0, 0.0}, infinity);
  assert_false(timeless.enable);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(duty_follows_the_profiles_table),
      cmocka_unit_test(a_spool_hardly_open_stays_neutral),
      cmocka_unit_test(positions_beyond_the_travel_are_clamped),
      cmocka_unit_test(changes_are_limited_in_rate),
      cmocka_unit_test(closing_is_never_delayed),
      cmocka_unit_test(closed_is_duty_zero),
      cmocka_unit_test(not_active_is_neutral_at_once),
      cmocka_unit_test(what_is_no_number_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
