// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/assist_line.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/grid_ground.hpp"
#include "tests/unit/firmware/hand.hpp"

constexpr TipPose kStart = test::kHandStart;

const ExcavatorProfile& profile() { return test::excavator().profile; }

/// Along heights of a grid, as the controller has it: the section is looked at in each cycle.
struct OnSurface : test::Hand {
  const test::GridGround& ground;

  explicit OnSurface(const test::GridGround& of, const TipPose& from = kStart)
      : test::Hand(Task::kAssist, from), ground(of) {
    look();
  }
  void look() {
    AssistView view;
    view.now_m = tip().x_m;
    view.at_m = state.plans ? state.tip.x_m : view.now_m;
    view.way = -ask.lever_ratio[kArm];
    view.way = view.way > 0.0 ? 1.0 : view.way < 0.0 ? -1.0 : 0.0;
    ask.design = assist_design(profile(), ground.fences(), 0.0, Eigen::Vector2d::Zero(), view);
    step();
  }
};

/// Height of the design over the boom foot's pin where kStart is.
double start_height_m() { return profile().geometry.boom_foot_m.y() + kStart.y_m; }

/// At full lever over a crest and through a hollow with sides of 1:4, both ways: the edge's own
/// lag left aside it stays within 20 mm, and it is slowed for them, to no halt, and says so.
TEST(crests_and_hollows_are_followed) {
  for (const double up : {1.0, -1.0}) {
    const double kink_m = profile().geometry.boom_foot_m.x() + kStart.x_m;
    const auto height_m = [&](double x) {
      // Rounded over 5 cm to either side, as the application hands it over.
      const double off_m = std::abs(x - kink_m);
      return start_height_m() - up * 0.25 * (off_m > 0.05 ? off_m : 0.025 + off_m * off_m / 0.1);
    };
    const test::GridGround ground([&](double x, double) { return height_m(x); });
    OnSurface hand(ground);
    double most_mps = 0.0;
    for (const double side : {1.0, -1.0}) {
      hand.ask.lever_ratio[kArm] = side;
      bool slowed = false;
      for (int n = 0; n < (side > 0.0 ? 180 : 450); ++n) {
        hand.look();
        assert_int_equal(hand.want.assist, AssistState::kHolds);
        const TipPose tip = hand.tip();
        const double x_m = tip.x_m + profile().geometry.boom_foot_m.x();
        assert_near(tip.y_m + profile().geometry.boom_foot_m.y(), height_m(x_m), 0.02);
        const double speed_mps = hand.want.speed.head<2>().norm();
        most_mps = std::max(most_mps, speed_mps);
        if (std::abs(x_m - kink_m) < 0.05 && n > 0) {
          slowed = true;
          assert_true(speed_mps < 0.7);
        }
      }
      assert_true(slowed || side > 0.0);
    }
    assert_true(most_mps > 0.7);
  }
}

/// Before the border of a surface the edge stands, though the lever is on, and says what is there;
/// the way back is free. Beyond it there is no design, and each drive goes by its own lever.
TEST(at_the_border_of_a_surface_it_stops) {
  const double border_m = profile().geometry.boom_foot_m.x() + kStart.x_m + 0.9;
  const test::GridGround ground(
      [&](double x, double) { return x < border_m ? start_height_m() : std::nan(""); }, 0.0);
  OnSurface hand(ground);
  hand.ask.lever_ratio[kArm] = -1.0;
  for (int n = 0; n < 500; ++n) {
    hand.look();
    assert_int_equal(hand.want.assist, AssistState::kHolds);
  }
  const double left_m = border_m - profile().geometry.boom_foot_m.x() - hand.tip().x_m;
  assert_true(left_m > 0.05 && left_m < 0.3);
  assert_true(hand.want.speed.head<2>().norm() < 0.02);
  assert_int_equal(hand.want.cap.limit.kind, LimitKind::kAhead);
  hand.ask.lever_ratio[kArm] = 0.5;
  for (int n = 0; n < 100; ++n) {
    hand.look();
  }
  assert_true(hand.tip().x_m < border_m - profile().geometry.boom_foot_m.x() - left_m - 0.1);
  OnSurface beyond(ground, {6.2, -0.5, 1.3});
  beyond.ask.lever_ratio[kArm] = -0.5;
  for (int n = 0; n < 30; ++n) {
    beyond.look();
    assert_int_equal(beyond.want.assist, AssistState::kBeyond);
  }
  assert_false(beyond.want.leads);
  assert_true(beyond.want.wanted_mps[kArm] < 0.0);
}

/// The highest place under the edge counts, at a corner or in its middle; at another swing the
/// section is another.
TEST(a_section_is_that_of_the_whole_edge) {
  const ExcavatorProfile& of = profile();
  const double half_m = 0.5 * of.geometry.body.bucket_width_m;
  const double out_m = of.geometry.boom_foot_m.x() + kStart.x_m;
  const test::GridGround ridge([&](double, double y) { return -0.5 * std::abs(y); });
  const test::GridGround fall([&](double x, double y) { return 0.1 * y + 0.2 * x; });
  AssistView view;
  view.now_m = view.at_m = kStart.x_m;
  const auto height_m = [&](const test::GridGround& ground, double swing_rad) {
    const AssistLine line = assist_design(of, ground.fences(), swing_rad, {0.0, 0.0}, view).at;
    return (line.from_foot_m - line.up.x() * kStart.x_m) / line.up.y() +
           of.geometry.boom_foot_m.y();
  };
  assert_near(height_m(ridge, 0.0), 0.0, 0.02);
  assert_near(height_m(fall, 0.0), 0.1 * half_m + 0.2 * out_m, 2e-3);
  assert_near(height_m(fall, 0.5 * kPi), 0.2 * half_m + 0.1 * out_m, 2e-3);
  // Seen 30 mm too far outwards and 20 too high, the design seems there too.
  const auto shown_m = [&](const Eigen::Vector2d& off_m) {
    const AssistLine line = assist_design(of, fall.fences(), 0.0, off_m, view).at;
    return (line.from_foot_m - line.up.x() * kStart.x_m) / line.up.y();
  };
  assert_near(shown_m({0.03, 0.02}) - shown_m({0.0, 0.0}), 0.02 - 0.2 * 0.03, 1.5e-3);
}
