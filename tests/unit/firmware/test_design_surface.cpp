// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/design_surface.hpp"

#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/firmware/grid_ground.hpp"

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A plane in the grid is that plane, however the grid lies, to the count of a height.
TEST(a_plane_of_heights_is_that_plane) {
  for (const double turn_rad : {0.0, 0.4, -2.5}) {
    const test::GridGround ground([](double x, double y) { return -0.6 + 0.1 * x - 0.05 * y; },
                                  turn_rad);
    for (const Eigen::Vector2d& at_m : {Eigen::Vector2d(5.03, 0.01), Eigen::Vector2d(-3.3, 6.12)}) {
      const SurfacePlace place = ground.surface.at(at_m);
      assert_true(place.known);
      assert_near(place.height_m, -0.6 + 0.1 * at_m.x() - 0.05 * at_m.y(), 0.5e-3);
      assert_near(place.slope.x(), 0.1, 0.02);
      assert_near(place.slope.y(), -0.05, 0.02);
    }
  }
}

/// Between four known heights and nowhere else; a place that is no number is beyond the border too.
TEST(beyond_its_border_it_has_no_height) {
  const test::GridGround ground([](double x, double) { return x < 6.0 ? 0.0 : kNothing; }, 0.0);
  assert_true(ground.surface.at({5.9, 0.0}).known);
  assert_false(ground.surface.at({6.01, 0.0}).known);
  assert_false(ground.surface.at({5.98, 0.0}).known);
  for (const Eigen::Vector2d& at_m :
       {Eigen::Vector2d(-12.01, 0.0), Eigen::Vector2d(0.0, 12.01), Eigen::Vector2d(0.0, -12.01),
        Eigen::Vector2d(kNothing, 0.0), Eigen::Vector2d(0.0, 1e300)}) {
    assert_false(ground.surface.at(at_m).known);
  }
  assert_true(ground.surface.at({-11.99, 0.0}).known);
  const test::GridGround across([](double, double y) { return y < 6.0 ? 0.0 : kNothing; }, 0.0);
  assert_true(across.surface.at({0.0, 5.9}).known);
  assert_false(across.surface.at({0.0, 5.98}).known);
}

/// A wall of 1:1 from x = 5 on is met on the way to it, and from the ground that leads to it; from
/// the wall away, and over it, nothing is.
TEST(what_rises_ahead_is_met_in_time) {
  const test::GridGround ground([](double x, double) { return std::max(0.0, x - 5.0); }, 0.0);
  PointMotion point;
  point.position_m = {4.5, 0.0, 0.0};
  point.velocity_mps = {1.0, 0.0, 0.0};
  const SurfaceContact contact = ground.surface.ahead(point, 0.0);
  assert_true(contact.met);
  // Between two places that are looked at it is taken to rise evenly: never too late.
  assert_true(contact.time_s > 0.3 && contact.time_s < 0.51);
  assert_near(contact.up.x(), -std::sqrt(0.5), 0.01);
  point.velocity_mps.x() = -1.0;
  assert_false(ground.surface.ahead(point, 0.0).met);
  point.velocity_mps = {1.0, 0.0, 1.1};
  assert_false(ground.surface.ahead(point, 0.0).met);
  // A fence that stands lower is met later.
  point.velocity_mps = {1.0, 0.0, 0.0};
  assert_near(ground.surface.ahead(point, -0.3).time_s, 0.8, 0.03);
  // Beyond the surface already: where it gets deeper.
  point.position_m.z() = -0.1;
  const double deeper_s = ground.surface.ahead(point, 0.0).time_s;
  assert_true(deeper_s > 0.3 && deeper_s < 0.51);
}

/// Corners and middle of the edge, each over the plane that touches the surface under it; a ridge
/// between the corners counts.
TEST(the_edge_has_three_places_before_a_surface) {
  const test::ReplayMachine machine(test::excavator_12t());
  const DriveVector drive(0.475, 0.565, 0.4375, 0.0);
  const MachineMotion motion = machine_motion(machine.kinematics, drive, {0.1, 0.0, 0.0, 0.0});
  const Eigen::Vector3d middle_m = motion.at(MachinePoint::kTeeth).position_m;
  const test::GridGround ridge([](double, double y) { return -3.0 - std::abs(y); }, 0.0);
  const Fence fence = surface_fence(ridge.surface);
  assert_int_equal(gap_count(fence, machine.profile.geometry.body), 3);
  const double half_m = 0.5 * machine.profile.geometry.body.bucket_width_m;
  double least_m = 1e3;
  for (int gap = 0; gap < 3; ++gap) {
    const FenceGap of = fence_gap(fence, machine.profile.geometry.body, motion, gap, 1e3);
    least_m = std::min(least_m, of.distance_m);
    if (of.point != MachinePoint::kTeeth) {
      assert_near(of.distance_m, std::sqrt(0.5) * (middle_m.z() + 3.0 + half_m), 0.02);
      const Eigen::Vector3d& velocity = motion.at(of.point).velocity_mps;
      const double side = of.point == MachinePoint::kEdgeLeft ? 1.0 : -1.0;
      assert_near(of.closing_mps, -std::sqrt(0.5) * (velocity.z() + side * velocity.y()), 1e-3);
    }
  }
  assert_true(least_m < std::sqrt(0.5) * (middle_m.z() + 3.05));
  const test::GridGround none([](double, double) { return kNothing; });
  assert_near(fence_gap(surface_fence(none.surface), machine.profile.geometry.body, motion, 0, 1e3)
                  .distance_m,
              1e3, 0.0);
}

TEST(numbers_that_are_no_surface_s) {
  const test::GridGround ground([](double, double) { return 0.0; });
  assert_true(ground.surface.usable());
  for (int n = 0; n < 7; ++n) {
    DesignSurface wrong = ground.surface;
    switch (n) {
      case 0:
        wrong.height = nullptr;
        break;
      case 1:
        wrong.columns = 1;
        break;
      case 2:
        wrong.rows = DesignSurface::kMostSide + 1;
        break;
      case 3:
        wrong.step_m = 0.0;
        break;
      case 4:
        wrong.base_m = kNothing;
        break;
      case 5:
        wrong.machine_m.y() = kNothing;
        break;
      default:
        wrong.cosine = 1.1;
    }
    assert_false(wrong.usable());
  }
}
