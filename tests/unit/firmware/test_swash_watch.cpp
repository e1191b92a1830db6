#include "firmware/excavator/safety/excavator_validation.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

namespace {

using namespace graben;

constexpr std::array<double, kPumpCount> kWanted = {0.5, 0.75};
constexpr double kTolerance = 0.125;

struct Pumps {
  std::array<double, kPumpCount> swash = kWanted;
  SwashState state{};
  std::array<double, kPumpCount> flow_with{};

  bool disagree(double period_s, bool commanded = true) {
    flow_with = swash;
    return watch_swash(test::plain_machine(), commanded, period_s, flow_with, state);
  }
  void assert_flow_with(double first, double second) const {
    assert_near(flow_with[0], first, 0.0);
    assert_near(flow_with[1], second, 0.0);
  }
};

/// Off by the tolerance for ever is well; by the next number it is not, either way, either pump.
void the_tolerance_is_a_sharp_edge(void**) {
  for (unsigned pump = 0; pump < kPumpCount; ++pump) {
    for (const double sign : {1.0, -1.0}) {
      Pumps pumps;
      pumps.swash[pump] = kWanted[pump] + sign * kTolerance;
      assert_false(pumps.disagree(10.0));
      pumps.swash[pump] = std::nextafter(pumps.swash[pump], sign * 9.0);
      assert_true(pumps.disagree(10.0));
    }
  }
}

/// The servo has 0.5 s; a moment of agreement gives it as much again.
void the_servo_is_given_its_time(void**) {
  Pumps pumps;
  pumps.swash[0] = 0.0;
  assert_false(pumps.disagree(0.25));
  assert_false(pumps.disagree(0.25));
  pumps.assert_flow_with(0.0, kWanted[1]);
  assert_true(pumps.disagree(1e-6));
  pumps.swash[0] = kWanted[0];
  assert_false(pumps.disagree(0.25));
  pumps.swash[0] = 0.0;
  assert_false(pumps.disagree(0.5));
  assert_true(pumps.disagree(1e-6));
}

/// The smaller of command and feedback, of that pump alone, and only once it disagrees.
void the_smaller_one_counts(void**) {
  Pumps more;
  more.swash = {0.25, 1.0};
  assert_false(more.disagree(0.5));
  more.assert_flow_with(0.25, 1.0);
  assert_true(more.disagree(0.5));
  more.assert_flow_with(0.25, kWanted[1]);
  Pumps near;
  near.swash = {0.5625, 0.25};
  assert_true(near.disagree(1.0));
  near.assert_flow_with(0.5625, 0.25);
}

/// Without a command nothing is asked, and nothing is remembered.
void without_a_command_nothing_is_asked(void**) {
  Pumps pumps;
  pumps.swash = {0.0, 0.0};
  assert_false(pumps.disagree(10.0, false));
  pumps.assert_flow_with(0.0, 0.0);
  assert_false(pumps.disagree(0.5));
  assert_false(pumps.disagree(10.0, false));
  assert_false(pumps.disagree(0.5));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_tolerance_is_a_sharp_edge),
      cmocka_unit_test(the_servo_is_given_its_time),
      cmocka_unit_test(the_smaller_one_counts),
      cmocka_unit_test(without_a_command_nothing_is_asked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
