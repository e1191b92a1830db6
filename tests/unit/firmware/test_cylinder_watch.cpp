#include "firmware/drives/cylinder_watch.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;

constexpr CylinderLimits kLimits{0.2, 0.02, 0.03};
constexpr double kPeriod_s = 0.01;

/// Seconds until a stroke that does not move, spool open, counts as stuck; 600 if it never does.
double stuck_after_s(double asked_mps) {
  CylinderState state;
  for (int n = 1; n <= 60000; ++n) {
    const CylinderWatchResult result =
        watch_cylinder(kLimits, state, {0.1, asked_mps > 0.0 ? 0.4 : -0.4, asked_mps}, kPeriod_s);
    state = result.state;
    if (result.stuck) {
      return n * kPeriod_s;
    }
  }
  return 600.0;
}

void what_is_asked_for_and_does_not_come_is_stuck(void**) {
  assert_near(stuck_after_s(0.1), 0.3, 0.03);
  assert_near(stuck_after_s(-0.02), 1.6, 0.1);
}

/// A blade on level ground is asked for what leaks, for minutes.
void held_against_leakage_it_is_not_stuck(void**) {
  assert_near(stuck_after_s(0.0005), 600.0, 0.0);
  assert_near(stuck_after_s(-0.0025), 600.0, 0.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_is_asked_for_and_does_not_come_is_stuck),
      cmocka_unit_test(held_against_leakage_it_is_not_stuck),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
