// SPDX-License-Identifier: Apache-2.0
// What four areas of a valve say of its cylinder's stroke sensor.

#include "app/identify/machine/stroke_scale.hpp"

#include <stdexcept>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

/// All of a drive's areas seem so much of the profile's.
void set_factors(DriveEstimate& drive, double extend_in, double extend_out, double retract_in,
                 double retract_out) {
  drive.extend.driven_most = drive.retract.driven_most = 1.0;
  drive.extend.coefficient_factor = {extend_in, 0.05, true};
  drive.extend.out_area_factor = {extend_out, 0.05, true};
  drive.retract.coefficient_factor = {retract_in, 0.05, true};
  drive.retract.out_area_factor = {retract_out, 0.05, true};
}

TEST(all_areas_alike_are_the_sensor) {
  for (const double scale : {0.5, 2.0}) {
    MachineEstimate machine;
    set_factors(machine.drive[kArm], 1.2 * scale, 0.8 * scale, scale, scale);
    const auto scales = stroke_scales(machine);
    assert_false(scales[kBoom].known);
    assert_true(scales[kArm].known);
    assert_near(scales[kArm].ratio, scale * 0.99, 0.03 * scale);
    assert_int_equal(scale_notes(machine).size(), 1);
    test::expect_refusal([&] { assert_scales(machine); }, "arm: by its oil");
  }
}

TEST(areas_that_differ_are_the_valve, MachineEstimate machine) {
  set_factors(machine.drive[kBoom], 0.6, 1.3, 0.7, 1.3);
  set_factors(machine.drive[kArm], 0.65, 0.65, 0.65, 0.65);
  set_factors(machine.drive[kBucket], 1.3, 1.3, 1.3, 1.3);
  assert_scales(machine);
  // In doubt it says so.
  assert_int_equal(scale_notes(machine).size(), 2);
  assert_true(scale_notes(machine)[0].rfind("arm: ", 0) == 0);
}

/// The bounds.
TEST(what_is_farther_off_is_refused) {
  const auto all = [](double factor) {
    MachineEstimate machine;
    set_factors(machine.drive[kBoom], factor, factor, factor, factor);
    return machine;
  };
  for (const double sound : {0.69, 1.24}) {
    assert_true(scale_notes(all(sound)).empty());
  }
  for (const double doubtful : {0.62, 0.67, 1.26, 1.33}) {
    assert_int_equal(scale_notes(all(doubtful)).size(), 1);
    assert_scales(all(doubtful));
  }
  for (const double wrong : {0.60, 1.35}) {
    test::expect_refusal([&] { assert_scales(all(wrong)); }, "--strokes-measured");
  }
}

/// A side that is hardly known counts little.
TEST(what_is_known_better_counts_more, MachineEstimate machine) {
  set_factors(machine.drive[kBoom], 0.4, 0.4, 1.0, 1.0);
  machine.drive[kBoom].extend.coefficient_factor.deviation = 0.4;
  machine.drive[kBoom].extend.out_area_factor.deviation = 0.4;
  assert_true(stroke_scales(machine)[kBoom].ratio > 0.93);
}

/// One side alone may be anything.
TEST(what_was_not_driven_says_nothing, MachineEstimate machine) {
  set_factors(machine.drive[kBoom], 0.3, 0.3, 0.3, 0.3);
  machine.drive[kBoom].retract.driven_most = 0.0;
  assert_false(stroke_scales(machine)[kBoom].known);
  assert_scales(machine);
  assert_true(scale_notes(machine).empty());
}
