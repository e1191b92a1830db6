// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "firmware/dozer/travel/ground_map.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "firmware/dozer/travel/support.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

const DozerBody& body() { return test::dozer().profile.body; }

/// Cuts along a design with the edge from `from_m` on, the machine on level ground behind it.
GroundMap cut(const GradeProfile& design, double from_m, double to_m, double above_m = 0.0) {
  GroundMap ground;
  for (double x_m = from_m; x_m <= to_m; x_m += 0.013) {
    ground.pass(x_m, design.at(x_m).height_m + above_m, design, from_m - 2.2, 0.0, 0.0);
  }
  return ground;
}

TEST(behind_the_edge_it_is_what_was_cut_before_it_the_design) {
  const GradeProfile design(test::dozer().profile.grade);
  const GroundMap ground = cut(design, 2.0, 8.0, -0.01);
  for (double x_m = 2.5; x_m < 7.8; x_m += 0.05) {
    assert_near(ground.height_m(x_m, design), design.at(x_m).height_m - 0.01, 1e-3);
  }
  assert_near(ground.height_m(9.5, design), design.at(9.5).height_m, 0.0);
  assert_near(ground.height_m(1.0, design), 0.0, 1e-12);
}

TEST(what_is_cut_stays_cut) {
  const GradeProfile design(test::level(-0.1));
  GroundMap ground = cut(design, 0.0, 4.0);
  for (double x_m = 4.0; x_m > 2.0; x_m -= 0.02) {
    ground.pass(x_m, -0.3, design, x_m - 2.2, 0.0, 0.0);
  }
  assert_near(ground.height_m(3.0, design), -0.1, 1e-9);
  for (double x_m = 2.0; x_m < 4.0; x_m += 0.02) {
    ground.pass(x_m, -0.05, design, x_m - 2.2, 0.0, 0.0);
  }
  assert_near(ground.height_m(3.0, design), -0.1, 1e-9);
  for (double x_m = 2.0; x_m < 4.0; x_m += 0.02) {
    ground.pass(x_m - 1.0, -0.2, design, x_m - 2.2, 0.0, 0.0);
  }
  assert_near(ground.height_m(2.5, design), -0.2, 1e-9);
}

/// The blade is carried: what lies below it is the line that the machine stands on.
TEST(in_the_air_nothing_is_cut) {
  const GradeProfile design(test::level(0.0));
  GroundMap ground = cut(design, 0.0, 3.0);
  for (double x_m = 3.0; x_m < 6.0; x_m += 0.02) {
    ground.pass(x_m, 0.5 + 0.05 * x_m, design, x_m - 2.2, 0.02, 0.0);
  }
  assert_near(ground.height_m(5.0, design), 0.02, 1e-9);
}

TEST(a_jump_starts_it_afresh) {
  const GradeProfile design(test::level(0.0));
  GroundMap ground = cut(design, 0.0, 3.0, -0.05);
  ground.pass(50.0, 1.0, design, 47.8, 0.4, 0.1);
  assert_near(ground.height_m(47.0, design), 0.4 - 0.08, 1e-9);
  ground.pass(std::numeric_limits<double>::quiet_NaN(), 0.0, design, 0.0, 0.0, 0.0);
  assert_true(std::isfinite(ground.height_m(0.0, design)));
}

TEST(it_remembers_as_far_as_the_tracks_reach) {
  const GradeProfile design(test::level(-0.1));
  const GroundMap ground = cut(design, 0.0, 40.0);
  assert_near(ground.height_m(40.0 - GroundMap::kLength_m + 0.2, design), -0.1, 1e-9);
  assert_near(ground.height_m(-30.0, design), -0.1, 1e-9);
  assert_true(GroundMap::kLength_m > 2.3 + body().track_contact_m);
}

/// For another pass the design lies before the edge, and behind it what was left.
TEST(turned_back_it_forgets_only_what_lies_ahead) {
  const GradeProfile design(test::level(-0.1));
  GroundMap ground = cut(design, 0.0, 12.0, 0.05);
  assert_near(ground.height_m(8.0, design), -0.05, 1e-9);
  ground.turn_back(6.0);
  assert_near(ground.height_m(8.0, design), -0.1, 1e-9);
  assert_near(ground.height_m(4.0, design), -0.05, 1e-9);
  ground.turn_back(9.0);
  assert_near(ground.height_m(8.0, design), -0.1, 1e-9);
}

/// A pass begins with the blade on its way down to ground that an earlier one has left: that is
/// where it was, however low the blade hangs over it.
TEST(a_blade_on_its_way_down_makes_no_ground) {
  const GradeProfile design(test::level(-0.1));
  GroundMap ground = cut(design, 0.0, 12.0, 0.05);
  ground.turn_back(6.0);
  for (double x_m = 6.0; x_m < 8.0; x_m += 0.02) {
    ground.pass(x_m, -0.03 + 0.01 * (8.0 - x_m), design, x_m - 2.2, 0.3, 0.0, true);
  }
  assert_near(ground.height_m(7.0, design), -0.05, 1e-9);
  // As soon as it is down, what it leaves counts: cut, or filled with what it carries.
  for (double x_m = 8.0; x_m < 10.0; x_m += 0.02) {
    ground.pass(x_m, -0.08, design, x_m - 2.2, 0.3, 0.0);
  }
  assert_near(ground.height_m(9.0, design), -0.08, 1e-9);
  // Where it has never been, it is the line that the tracks stand on.
  for (double x_m = 10.0; x_m < 14.0; x_m += 0.02) {
    ground.pass(x_m, 0.5, design, x_m - 2.2, 0.3, 0.0, true);
  }
  assert_near(ground.height_m(11.0, design), -0.05, 1e-9);
  assert_near(ground.height_m(13.0, design), 0.3, 1e-9);
}

/// On level ground at its height, on a slope along it.
TEST(on_a_plane_it_stands_along_it) {
  for (const double slope : {-0.3, 0.0, 0.2}) {
    GradeDesign plane = test::level(0.0);
    plane.plane_slope = slope;
    plane.plane_height_m = 0.7;
    const GradeProfile design(plane);
    Stand stand{0.7 + 50.0 * slope, 0.0};
    repeat(5, [&] { stand = stand_at(body(), GroundMap(), design, 50.0, stand); });
    // As many wheels as there may be, each as much softer, stand the same.
    DozerBody wheels = body();
    wheels.suspension_npm *= static_cast<double>(wheels.wheels) / kMostWheels;
    wheels.wheels = kMostWheels;
    Stand of_more{0.7 + 50.0 * slope, 0.0};
    repeat(5, [&] { of_more = stand_at(wheels, GroundMap(), design, 50.0, of_more); });
    assert_near(of_more.pitch_rad, stand.pitch_rad, 0.02);
    assert_near(of_more.height_m, stand.height_m, 0.02);
    // The tilted springs' load leans to the lower end.
    assert_near(stand.pitch_rad, std::atan(slope), 0.02);
    assert_near(stand.height_m, 0.7 + 50.0 * slope, 0.02);
    if (slope == 0.0) {
      assert_near(stand.pitch_rad, 0.0, 1e-9);
      assert_near(stand.height_m, 0.7, 1e-9);
    }
  }
}

/// Forces and moments over the wheels, worked out by themselves.
TEST(where_it_stands_the_wheels_carry_it) {
  const GradeProfile design(test::dozer().profile.grade);
  Stand stand{0.0, 0.0};
  const double weight_n = body().mass_kg * 9.80665;
  int unrested = 0;
  for (double x_m = 0.0; x_m < 25.0; x_m += 0.05) {
    stand = stand_at(body(), GroundMap(), design, x_m, stand);
    double force_n = 0.0;
    double moment_nm = 0.0;
    for (int i = 0; i < body().wheels; ++i) {
      const double along_m = -1.2 + 2.4 * i / (body().wheels - 1);
      const double at_m = x_m + along_m * std::cos(stand.pitch_rad);
      const double pressed_m = design.at(at_m).height_m + weight_n / 10 / body().suspension_npm -
                               stand.height_m - along_m * std::sin(stand.pitch_rad);
      const double push_n = std::max(0.0, body().suspension_npm * pressed_m);
      force_n += push_n;
      moment_nm += push_n * (along_m * std::cos(stand.pitch_rad) +
                             body().mass_centre_height_m * std::sin(stand.pitch_rad));
    }
    const bool carries =
        std::abs(force_n / weight_n - 1.0) < 0.05 && std::abs(moment_nm / weight_n) < 0.05;
    unrested += carries ? 0 : 1;
  }
  // Where it tips over the ledge the bounded steps may end beside the rest.
  assert_true(unrested <= 1);
}

TEST(the_shipped_design_is_reached_all_the_way) {
  assert_true(grade_reach(test::dozer().profile, 0.0, 27.0).reached);
}

/// The same trench from its other end, where the slope that the body climbs is the steeper one.
TEST(a_design_out_of_reach_is_named_where_it_is) {
  DozerProfile mirrored = test::dozer().profile;
  const GradeDesign given = mirrored.grade;
  for (int i = 0; i < given.count; ++i) {
    const GradePoint& point = given.point[static_cast<unsigned>(given.count - 1 - i)];
    mirrored.grade.point[static_cast<unsigned>(i)] = {27.0 - point.x_m, point.z_m};
  }
  const GradeReach reach = grade_reach(mirrored, 0.0, 27.0);
  assert_false(reach.reached);
  assert_true(reach.edge_m < mirrored.blade.edge_min_m || reach.edge_m > mirrored.blade.edge_max_m);
  assert_true(reach.position_m > 0.0 && reach.position_m < 27.0);
}

TEST(without_wheels_below_it_comes_down) {
  const GradeProfile design(test::level(0.0));
  Stand stand{3.0, 0.5};
  repeat(30, [&] { stand = stand_at(body(), GroundMap(), design, 0.0, stand); });
  assert_near(stand.height_m, 0.0, 1e-6);
  assert_near(stand.pitch_rad, 0.0, 1e-6);
}

TEST(noise_of_the_position_is_left_behind, PositionState state) {
  double largest_m = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double true_m = 0.012 * n;
    state = next_position(state, true_m + (n % 2 == 0 ? 0.01 : -0.01), 1.2, 0.01);
    largest_m = n > 100 ? std::max(largest_m, std::abs(state.position_m - true_m)) : 0.0;
  }
  assert_true(largest_m < 0.001);
  assert_near(next_position(state, 99.0, 1.0, 0.01).position_m, 99.0, 0.0);
}
