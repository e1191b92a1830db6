// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/motion_watch.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

constexpr double kRail_pa = 40e6;
constexpr double kPeriod_s = 0.01;

/// One chamber of one axis whose pressure is set by hand; all others live.
struct Chamber {
  unsigned axis = 0;
  bool rod = false;
  double pressure_pa = 5e6;
  double stroke_m = 0.0;
  bool known = true;
  double empty_pa = kEmptyChamber_pa;
  std::array<PressurePair, kDriveCount> state{};
  int cycle = 0;

  std::array<bool, kDriveCount> step(double period_s = kPeriod_s) {
    const ExcavatorBank bank = excavator_bank(test::plain_machine());
    std::array<ValidDrive, kDriveCount> seen;
    std::array<bool, kDriveCount> wrong{};
    const double alive_pa = 6e6 + 1e3 * (++cycle % 7);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      seen[i].load_known = i != axis || known;
      seen[i].cap_pressure_pa = i == axis && !rod ? pressure_pa : alive_pa;
      seen[i].rod_pressure_pa = i == axis && rod ? pressure_pa : alive_pa;
      seen[i].stroke_m = stroke_m;
    }
    const bool any = watch_pressures(bank.rows(), empty_pa, seen, period_s, state);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      wrong[i] = !seen[i].load_known && (i != axis || known);
    }
    assert_int_equal(any, wrong[0] || wrong[1] || wrong[2]);
    return wrong;
  }
  bool wrong(double period_s = kPeriod_s) {
    const std::array<bool, kDriveCount> all = step(period_s);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      assert_true(i == axis || !all[i]);
    }
    return all[axis];
  }
};

/// Each chamber by itself, cap and rod side of each axis.
template <class Check>
void in_each_chamber(Check check) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const bool rod : {false, true}) {
      Chamber chamber;
      chamber.axis = axis;
      chamber.rod = rod;
      check(chamber);
    }
  }
}

TEST(pressures_that_live_are_believed) {
  in_each_chamber([](Chamber chamber) {
    for (int n = 0; n < 300; ++n) {
      chamber.pressure_pa = 5e6 + n;
      chamber.stroke_m = 0.01 * n;
      assert_false(chamber.wrong());
    }
  });
}

/// 0.3 s at the rail are a peak; longer is a sensor at its end.
TEST(a_sensor_at_its_rail_is_wrong) {
  in_each_chamber([](Chamber chamber) {
    chamber.pressure_pa = kRail_pa;
    assert_false(chamber.wrong(0.3));
    assert_false(chamber.wrong(0.0));
    assert_true(chamber.wrong(1e-6));
    assert_true(chamber.wrong());
    chamber.pressure_pa = std::nextafter(kRail_pa, 0.0);
    assert_false(chamber.wrong());
    chamber.pressure_pa = kRail_pa + 1.0;
    assert_false(chamber.wrong(0.3));
    assert_true(chamber.wrong(1e-6));
  });
}

/// Peaks do not add up.
TEST(a_peak_ends_with_itself) {
  in_each_chamber([](Chamber chamber) {
    for (int n = 0; n < 20; ++n) {
      chamber.pressure_pa = kRail_pa;
      assert_false(chamber.wrong(0.25));
      chamber.pressure_pa = 10e6;
      assert_false(chamber.wrong(0.25));
    }
  });
}

/// 0.06 m of motion with the same number; either way; until it changes.
TEST(a_number_that_stands_while_the_cylinder_moves_is_stuck) {
  for (const double sign : {1.0, -1.0}) {
    in_each_chamber([sign](Chamber chamber) {
      assert_false(chamber.wrong());  // At stroke 0 the number was new.
      chamber.stroke_m = sign * 0.06;
      assert_false(chamber.wrong());
      chamber.stroke_m = sign * 0.063;
      assert_true(chamber.wrong());
      assert_true(chamber.wrong());
      chamber.pressure_pa = std::nextafter(5e6, 9e9);
      assert_false(chamber.wrong());
      chamber.stroke_m += sign * 0.06;
      assert_false(chamber.wrong());
    });
  }
}

/// A cylinder that swings about its place goes a way too; what a sensor trembles by is none.
TEST(to_and_fro_adds_up_and_trembling_does_not) {
  in_each_chamber([](Chamber swinging) {
    Chamber trembling = swinging;
    int cycles = 0;
    while (!swinging.wrong()) {
      swinging.stroke_m = ++cycles % 2 == 0 ? 0.0 : 0.005;
      assert_true(cycles <= 13);
    }
    assert_int_equal(cycles, 13);
    for (int n = 0; n < 1000; ++n) {
      trembling.stroke_m = n % 2 == 0 ? 0.0 : 0.002;
      assert_false(trembling.wrong());
    }
  });
}

TEST(a_cylinder_at_rest_has_one_pressure, Chamber chamber) {
  repeat(1000, [&] { assert_false(chamber.wrong()); });
}

/// A chamber without oil has one pressure for long, whatever its sensor's zero.
TEST(an_empty_chamber_is_not_stuck) {
  for (const double empty_pa : {kEmptyChamber_pa, kEmptyUnknown_pa}) {
    for (const double pressure_pa : {0.0, empty_pa, std::nextafter(empty_pa, 1e9)}) {
      in_each_chamber([&](Chamber chamber) {
        chamber.empty_pa = empty_pa;
        chamber.pressure_pa = pressure_pa;
        assert_false(chamber.wrong());
        chamber.stroke_m = 0.5;
        assert_int_equal(chamber.wrong(), pressure_pa > empty_pa);
      });
    }
  }
}

/// An axis whose pressures did not come is neither judged nor forgotten.
TEST(what_is_not_known_is_not_judged) {
  in_each_chamber([](Chamber chamber) {
    chamber.pressure_pa = kRail_pa;
    assert_false(chamber.wrong(0.3));
    chamber.known = false;
    assert_false(chamber.wrong(1.0));
    chamber.known = true;
    assert_true(chamber.wrong());
  });
}
