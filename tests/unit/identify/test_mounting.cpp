// SPDX-License-Identifier: Apache-2.0
// How IMUs sit on their links, from touches of a peg: gravity in each IMU is computed here from the
// links' angles, with turns that the fit is not told.

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>

#include "app/identify/imus/mounting_fit.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/profile_file.hpp"
#include "app/plant/linkage_geometry.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

constexpr double kHeight_m = -1.4;
const Eigen::Vector3d kTurned(0.02, -0.03, 0.025);

ExcavatorProfile profile_with_imus(bool on_rocker) {
  ExcavatorProfile profile =
      machines::load_excavator(machines::find_profile("excavator_22t")).profile;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    profile.imu.mount[axis].address = static_cast<std::uint8_t>(226 + axis);
    profile.imu.mount[axis].turn_rad = 0.1;
  }
  profile.imu.mount[kBucket].on_rocker = on_rocker;
  return profile;
}

struct Site {
  ExcavatorProfile profile;
  Eigen::Vector3d turned = kTurned;
  double noise_rad = 0.0;
  double touch_m = 0.0;
  std::mt19937_64 random{7};

  double normal() { return std::normal_distribution<double>(0.0, 1.0)(random); }

  /// What the IMUs show with the edge on the peg; the attitude is that of the bucket.
  Rest rest(double ahead_m, double attitude_rad, double begin_s) {
    const ExcavatorKinematics kinematics(profile.geometry);
    const JointResult joints = kinematics.joints_from_pose(
        {ahead_m + touch_m * normal(), kHeight_m + touch_m * normal(), attitude_rad});
    assert_int_equal(static_cast<int>(joints.status), static_cast<int>(ReachStatus::kOk));
    const plant::LinkageGeometry linkage(profile.geometry);
    Rest rest;
    rest.begin_s = begin_s;
    rest.line = static_cast<std::size_t>(100.0 * begin_s);
    double link_rad = 0.0;
    for (int axis = 0; axis < kAxisCount; ++axis) {
      const double under_rad = link_rad;
      link_rad += joints.joints_rad[axis];
      const bool rocker = axis == kBucket && profile.imu.mount[kBucket].on_rocker;
      const double body_rad =
          rocker ? under_rad + linkage.rocker_angle(joints.joints_rad[axis]) : link_rad;
      const auto at = static_cast<std::size_t>(axis);
      // A sensor that looks up by so much more than its profile says shows so much more.
      rest.angle_rad[at] = body_rad + turned[axis] + noise_rad * normal();
      rest.deviation_rad[at] = std::max(1e-5, noise_rad);
    }
    return rest;
  }

  MountingAsk ask(int each) {
    MountingAsk ask;
    ask.pegs.resize(2);
    for (int n = 0; n < each; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(each);
      ask.pegs[0].touches.push_back(rest(8.0, 1.45 + 1.05 * share, 10.0 + n));
      ask.pegs[1].touches.push_back(rest(3.5, 5.0 + 1.2 * share, 40.0 + n));
    }
    ask.pegs[0].height_m = kHeight_m;
    ask.rise_m = 0.0;
    return ask;
  }
};

std::string refusal(const std::function<void()>& act) {
  const std::string said = graben::test::refusal_of(act);
  assert_false(said.empty());
  return said;
}

void assert_says(const std::string& text, const std::string& words) {
  if (text.find(words) == std::string::npos) {
    fail_msg("\"%s\" is not in \"%s\"", words.c_str(), text.c_str());
  }
}

TEST(turns_are_found) {
  for (const bool on_rocker : {false, true}) {
    Site site{profile_with_imus(on_rocker)};
    const MountingFit fit = fit_mounting(site.profile, site.ask(8));
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      assert_near(fit.turn_rad[axis], 0.1 + kTurned[static_cast<int>(axis)], 2e-5);
    }
    assert_near(fit.peg_m[0].x(), 8.0, 1e-3);
    assert_near(fit.peg_m[1].y(), kHeight_m, 1e-3);
    assert_true(fit.most_m() < 1e-4);
    assert_true(fit.touches[0].before_m > 5e-3);
  }
}

/// On average over many sites it is as far off as it says.
TEST(deviations_are_what_they_say) {
  constexpr int kSites = 150;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (int n = 0; n < kSites; ++n) {
    Site site{profile_with_imus(false)};
    site.random.seed(static_cast<std::uint64_t>(100 + n));
    site.noise_rad = 1e-3;
    site.touch_m = 0.005;
    MountingAsk ask = site.ask(8);
    ask.pegs[0].height_m = kHeight_m + ask.level_m * site.normal();
    ask.rise_m = ask.level_m * site.normal();
    const MountingFit fit = fit_mounting(site.profile, ask);
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      const auto at = static_cast<int>(axis);
      squares[at] +=
          std::pow((fit.turn_rad[axis] - 0.1 - kTurned[at]) / fit.deviation_rad[axis], 2) / kSites;
    }
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    assert_near(std::sqrt(squares[axis]), 0.95, 0.25);
  }
}

/// All three turned alike: heights, or an IMU that sits right, tell it from a peg elsewhere.
TEST(a_common_turn_wants_a_reference) {
  Site site{profile_with_imus(false)};
  site.turned = {0.02, 0.02, 0.02};
  MountingAsk ask = site.ask(8);
  ask.pegs[0].height_m.reset();
  ask.rise_m.reset();
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }), "--height");
  ask.rise_m = 0.0;
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "Missing: the height of the peg");
  ask.touch_m = 0.002;
  ask.level_m = 0.001;
  assert_near(fit_mounting(site.profile, ask).turn_rad[kBoom], 0.12, 5e-5);
  site.turned = {0.0, 0.02, -0.01};
  ask = site.ask(8);
  ask.pegs[0].height_m.reset();
  ask.rise_m.reset();
  ask.kept = kBoom;
  ask.touch_m = 0.002;
  assert_near(fit_mounting(site.profile, ask).turn_rad[kArm], 0.12, 1e-3);
}

TEST(postures_too_much_alike_are_refused_with_what_is_missing) {
  Site site{profile_with_imus(false)};
  site.noise_rad = 1e-3;
  MountingAsk ask = site.ask(8);
  ask.pegs.resize(1);
  ask.rise_m.reset();
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "the arm turned by");
  ask.pegs[0].touches.clear();
  for (int n = 0; n < 6; ++n) {
    ask.pegs[0].touches.push_back(site.rest(8.0, 1.6 + 0.02 * n, 10.0 + n));
  }
  const std::string words = refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); });
  assert_says(words, "too much alike");
  assert_says(words, "the bucket turned by");
  ask.pegs[0].touches.resize(3);
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "3 touches of the peg; at least 4");
}

TEST(what_is_no_touch_is_named) {
  Site site{profile_with_imus(false)};
  MountingAsk ask = site.ask(8);
  ask.pegs[0].touches[2] = site.rest(8.4, 1.6, 12.0);
  const std::string stray = refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); });
  assert_says(stray, "the rest at 12.0 s (line 1200)");
  ask = site.ask(8);
  ask.pegs[1].touches[3].turned_rad[kArm] = 0.02;
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "the arm turned by 1.15 deg in it");
  ask = site.ask(8);
  std::swap(ask.pegs[0].touches[1], ask.pegs[1].touches[1]);
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "no common point");
  site.turned = {0.0, 0.5, 0.0};
  ask = site.ask(8);
  assert_says(refusal([&] { static_cast<void>(fit_mounting(site.profile, ask)); }),
              "the arm's IMU would be turned by 29 deg");
}
