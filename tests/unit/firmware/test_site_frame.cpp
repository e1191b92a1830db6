// SPDX-License-Identifier: Apache-2.0
// The site's frame under the machine: by touched points, checked by a third, lost with the tracks.

#include "firmware/excavator/fences/site_frame.hpp"

#include <cmath>

#include "firmware/excavator/motion/hand/assist_line.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/grid_ground.hpp"

constexpr double kDegree = 3.14159265358979 / 180.0;

/// Where a machine truly stands in the frame that its task file's design was read into.
struct Placed {
  double heading_rad = 0.0;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< Of that frame, for the machine.

  [[nodiscard]] Eigen::Vector3d to_machine(const Eigen::Vector3d& of) const {
    const double c = std::cos(heading_rad);
    const double s = std::sin(heading_rad);
    return origin_m + Eigen::Vector3d(c * of.x() - s * of.y(), s * of.x() + c * of.y(), of.z());
  }
};

const Placed kTruth = {2.2, {4.0, -1.5, 0.35}};

SitePoints points() {
  SitePoints site;
  site.can_touch = true;
  site.by_touch = true;
  site.benchmark_m = {0.5, -0.5, 0.1};
  site.second_m = {4.5, 1.0, 0.4};
  return site;
}

/// Rises by 1:2 along x of its frame, through its origin.
FenceSet slope(double rise = 0.5, double turn_rad = 0.0) {
  DesignPlane plane;
  plane.up =
      Eigen::Vector3d(-rise * std::cos(turn_rad), -rise * std::sin(turn_rad), 1.0).normalized();
  FenceSet fences;
  fences.count = 2;
  fences.fence[0].offset_m = 8.0;
  fences.fence[1] = plane.fence();
  return fences;
}

struct Site {
  SitePoints of = points();
  FenceSet fences = slope();
  SiteState state;

  Site() { state.known = SiteKnown::kUnknown; }

  MarkTouch touch(TouchKind kind, const Eigen::Vector3d& at_m) {
    return next_site(of, fences, kind,
                     {std::hypot(at_m.x(), at_m.y()), std::atan2(at_m.y(), at_m.x()), at_m.z()},
                     state);
  }
  /// Both points where they truly are, the second one beside it.
  MarkTouch touch_both(const Eigen::Vector3d& off_m = Eigen::Vector3d::Zero(),
                       const Placed& truth = kTruth) {
    assert_int_equal(touch(TouchKind::kBenchmark, truth.to_machine(of.benchmark_m)),
                     MarkTouch::kTaken);
    return touch(TouchKind::kHeading, truth.to_machine(of.second_m) + off_m);
  }
  /// Of the machine's ground frame, as the design's frame has it now.
  [[nodiscard]] Eigen::Vector3d seen(const Eigen::Vector3d& at_m) const {
    const FrameShift& shift = *placed(fences, state).shift;
    const double c = std::cos(shift.turn_rad);
    const double s = std::sin(shift.turn_rad);
    return shift.origin_m +
           Eigen::Vector3d(c * at_m.x() + s * at_m.y(), c * at_m.y() - s * at_m.x(), at_m.z());
  }
  /// A made place of the true design, `x`, `y` in its frame.
  MarkTouch check(double x, double y, double rise_x, double rise_y) {
    return touch(TouchKind::kSurface, kTruth.to_machine({x, y, rise_x * x + rise_y * y}));
  }
};

TEST(two_touches_lay_the_frame_under_the_machine, Site site) {
  assert_int_equal(placed(site.fences, site.state).count, 1);
  assert_true(placed(site.fences, site.state).shift == nullptr);
  assert_int_equal(site.touch_both(), MarkTouch::kTaken);
  assert_int_equal(site.state.known, SiteKnown::kKnown);
  assert_int_equal(placed(site.fences, site.state).count, 2);
  for (const Eigen::Vector3d& place_m :
       {Eigen::Vector3d(-2.0, 1.0, 0.3), Eigen::Vector3d(3.0, -2.5, -1.0)}) {
    assert_near((site.seen(kTruth.to_machine(place_m)) - place_m).norm(), 0.0, 1e-12);
  }
}

/// A design that lies elsewhere than it is given holds the machine as one that is given there.
TEST(a_placed_design_holds_as_one_that_is_given_there, Site site) {
  assert_int_equal(site.touch_both(), MarkTouch::kTaken);
  const auto& machine = test::excavator_12t();
  const SwingKinematics kinematics(machine.profile.geometry);
  FenceSet given = site.fences;
  Fence& design = given.fence[1];
  const Eigen::Vector3d level = kTruth.to_machine(design.normal) - kTruth.origin_m;
  design.normal = level;
  design.offset_m += level.dot(kTruth.origin_m);
  bool held = false;
  bool freed = false;
  for (const double swing_rad : {-1.0, 0.4, 2.0}) {
    for (const double boom_m : {0.3, 0.5, 0.7}) {
      DriveVector at;
      at << boom_m, 0.5, 0.4, swing_rad;
      for (const double way : {1.0, -1.0}) {
        DriveVector velocity;
        velocity << 0.2 * way, -0.1 * way, 0.05, 0.2 * way;
        const MotionCap there = test::motion_cap(machine.profile, kinematics, given, at, velocity);
        const MotionCap here = test::motion_cap(machine.profile, kinematics,
                                                placed(site.fences, site.state), at, velocity);
        assert_near(here.factor, there.factor, 1e-9);
        assert_near((here.share - there.share).norm(), 0.0, 0.0);
        held = held || there.limit.kind == LimitKind::kFence;
        freed = freed || there.factor == 1.0;
        AssistView view;
        view.now_m = view.at_m = 3.0;
        const AssistLine one =
            assist_design(machine.profile, given, swing_rad, {0.01, 0.02}, view).at;
        const AssistLine other = assist_design(machine.profile, placed(site.fences, site.state),
                                               swing_rad, {0.01, 0.02}, view)
                                     .at;
        assert_near((one.up - other.up).norm(), 0.0, 1e-9);
        assert_near(one.from_foot_m, other.from_foot_m, 1e-9);
      }
    }
  }
  assert_true(held && freed);
}

TEST(and_heights_on_a_grid, Site site) {
  const auto height_m = [](double x, double y) { return 0.2 * x - 0.3 * y; };
  const test::GridGround ground(height_m);
  // The same where it truly lies.
  const test::GridGround given([&](double x, double y) {
    const double c = std::cos(kTruth.heading_rad);
    const double s = std::sin(kTruth.heading_rad);
    const double off_x = x - kTruth.origin_m.x();
    const double off_y = y - kTruth.origin_m.y();
    return height_m(c * off_x + s * off_y, c * off_y - s * off_x) + kTruth.origin_m.z();
  });
  site.fences = ground.fences();
  assert_int_equal(site.touch_both(), MarkTouch::kTaken);
  const auto& machine = test::excavator_12t();
  for (const double swing_rad : {-1.0, 0.4, 2.0}) {
    AssistView view;
    view.now_m = view.at_m = 3.0;
    const AssistLine one =
        assist_design(machine.profile, given.fences(), swing_rad, {0.01, 0.02}, view).at;
    const AssistLine other = assist_design(machine.profile, placed(site.fences, site.state),
                                           swing_rad, {0.01, 0.02}, view)
                                 .at;
    assert_true(one.known && other.known);
    assert_near((one.up - other.up).norm(), 0.0, 0.01);
    assert_near(one.height_m({3.0, 0.0, 0.0}), other.height_m({3.0, 0.0, 0.0}), 0.002);
  }
  assert_int_equal(site.check(1.0, 2.0, 0.2, -0.3), MarkTouch::kTaken);
  // Beyond the border there is nothing to check by.
  assert_int_equal(site.check(30.0, 2.0, 0.2, -0.3), MarkTouch::kNoPoint);
  assert_int_equal(site.state.known, SiteKnown::kKnown);
  const Eigen::Vector3d up(0.0, 0.0, 0.031);
  const Eigen::Vector3d made_m = kTruth.to_machine({1.0, 2.0, -0.4});
  assert_int_equal(site.touch(TouchKind::kSurface, made_m + up), MarkTouch::kContradict);
}

TEST(the_benchmark_comes_first_and_begins_anew, Site site) {
  assert_int_equal(site.touch(TouchKind::kHeading, {1.0, 2.0, 0.0}), MarkTouch::kNoPoint);
  assert_int_equal(site.touch(TouchKind::kSurface, {1.0, 2.0, 0.0}), MarkTouch::kNoPoint);
  assert_int_equal(site.state.known, SiteKnown::kUnknown);
  assert_int_equal(site.touch_both(), MarkTouch::kTaken);
  assert_int_equal(site.touch(TouchKind::kBenchmark, {1.0, 2.0, 0.0}), MarkTouch::kTaken);
  assert_int_equal(site.state.known, SiteKnown::kBenchmark);
  assert_int_equal(placed(site.fences, site.state).count, 1);
  site.of.can_touch = false;
  site.state.known = SiteKnown::kKnown;
  assert_int_equal(site.touch(TouchKind::kBenchmark, {1.0, 2.0, 0.0}), MarkTouch::kNoPoint);
  assert_int_equal(site.state.known, SiteKnown::kKnown);
}

/// Farther, nearer, higher or lower by more than 30 mm than the site has it: refused.
TEST(a_second_point_elsewhere_is_refused, Site site) {
  const Eigen::Vector3d along =
      (kTruth.to_machine(site.of.second_m) - kTruth.to_machine(site.of.benchmark_m))
          .cwiseProduct(Eigen::Vector3d(1.0, 1.0, 0.0))
          .normalized();
  for (const double side : {1.0, -1.0}) {
    for (const Eigen::Vector3d& way : {along, Eigen::Vector3d(0.0, 0.0, 1.0)}) {
      assert_int_equal(site.touch_both(0.031 * side * way), MarkTouch::kContradict);
      assert_int_equal(site.state.known, SiteKnown::kBenchmark);
      assert_int_equal(site.touch_both(0.029 * side * way), MarkTouch::kTaken);
    }
  }
  const Eigen::Vector3d nowhere(NAN, 0.0, 0.0);
  assert_int_equal(site.touch_both(nowhere), MarkTouch::kContradict);
}

/// What two points don't show, a place of the design does. A second point 0.22 m beside its own
/// makes the heading 3 deg off: on a slope of 1:2 it is seen from 1.3 m across the benchmark on.
TEST(a_third_point_sees_a_wrong_heading, Site site) {
  const Eigen::Vector3d way = site.of.second_m - site.of.benchmark_m;
  Placed turned = kTruth;
  turned.heading_rad += 3.0 * kDegree;
  const Eigen::Vector3d beside = turned.to_machine(way) - kTruth.to_machine(way);
  assert_near(beside.norm(), 0.224, 0.001);
  const auto at_across = [&](double across_m) {
    assert_int_equal(site.touch_both(beside), MarkTouch::kTaken);
    return site.check(site.of.benchmark_m.x(), site.of.benchmark_m.y() + across_m, 0.5, 0.0);
  };
  assert_int_equal(at_across(1.2), MarkTouch::kTaken);
  assert_int_equal(at_across(-1.2), MarkTouch::kTaken);
  assert_int_equal(at_across(1.4), MarkTouch::kContradict);
  assert_int_equal(site.state.known, SiteKnown::kUnknown);
  assert_int_equal(at_across(-1.4), MarkTouch::kContradict);
}

/// A slope the other way up is seen from 34 mm beside the line in which both meet, another design
/// from 30 mm over or under it.
TEST(a_third_point_sees_a_wrong_design, Site site) {
  const auto on_mirrored = [&](double off_m) {
    assert_int_equal(site.touch_both(), MarkTouch::kTaken);
    site.fences = slope(-0.5);
    return site.check(off_m, 1.0, 0.5, 0.0);
  };
  assert_int_equal(on_mirrored(0.033), MarkTouch::kTaken);
  assert_int_equal(on_mirrored(0.035), MarkTouch::kContradict);
  assert_int_equal(on_mirrored(-0.035), MarkTouch::kContradict);
  for (const double higher_m : {0.031, -0.031, 0.029}) {
    assert_int_equal(site.touch_both(), MarkTouch::kTaken);
    site.fences = slope();
    site.fences.fence[1].offset_m -= higher_m;
    assert_int_equal(site.check(2.0, 1.0, 0.5, 0.0),
                     higher_m == 0.029 ? MarkTouch::kTaken : MarkTouch::kContradict);
  }
  assert_int_equal(site.state.known, SiteKnown::kKnown);
}

/// On a level design a heading off by 3 deg shows at no height, and does no harm there: the listed
/// case.
TEST(what_no_touch_shows, Site site) {
  site.fences = slope(0.0);
  Placed turned = kTruth;
  turned.heading_rad += 3.0 * kDegree;
  assert_int_equal(site.touch_both(Eigen::Vector3d::Zero(), turned), MarkTouch::kTaken);
  assert_int_equal(site.check(3.0, 4.0, 0.0, 0.0), MarkTouch::kTaken);
}

TEST(moved_tracks_take_the_design_away, Site site) {
  assert_int_equal(site.touch_both(), MarkTouch::kTaken);
  assert_int_equal(site.touch(TouchKind::kMoved, {0.0, 0.0, 0.0}), MarkTouch::kTaken);
  assert_true(site.state.is_lost());
  const FenceView view = placed(site.fences, site.state);
  assert_int_equal(view.count, 1);
  assert_true(&view.at(0) == &site.fences.fence[0]);
  // What was touched before is not a point of where it stands now.
  assert_int_equal(site.touch(TouchKind::kHeading, kTruth.to_machine(site.of.second_m)),
                   MarkTouch::kNoPoint);
}

/// A task without a design has all its fences, whatever is known.
TEST(other_fences_stay, Site site) {
  site.fences.count = 1;
  assert_int_equal(placed(site.fences, site.state).count, 1);
  site.fences.count = 0;
  assert_int_equal(placed(site.fences, site.state).count, 0);
}

/// Seconds of a platform that turns and a swing that shows it, rad/s.
SiteState watched(double platform_radps, double swing_radps, double seconds) {
  SiteState state;
  state.known = SiteKnown::kKnown;
  for (int n = 1; n <= std::lround(seconds / 0.01); ++n) {
    watch_tracks(platform_radps, 0.01 * n * swing_radps, 0.01, state);
  }
  return state;
}

TEST(turning_tracks_are_seen_by_the_platforms_gyro) {
  for (const double side : {1.0, -1.0}) {
    assert_int_equal(watched(0.2 * side, 0.0, 0.6).known, SiteKnown::kUnknown);
    assert_int_equal(watched(0.5 * side, 0.3 * side, 0.6).known, SiteKnown::kUnknown);
    // Half a turn of the swing with a gyro's scale 1 % off, and its zero off by 0.3 deg/s.
    assert_int_equal(watched(1.01 * side, 1.0 * side, 3.14).known, SiteKnown::kKnown);
    assert_int_equal(watched(0.3 * kDegree * side, 0.0, 120.0).known, SiteKnown::kKnown);
  }
  assert_int_equal(watched(NAN, 0.0, 0.1).known, SiteKnown::kUnknown);
}
