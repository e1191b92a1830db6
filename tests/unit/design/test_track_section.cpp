// SPDX-License-Identifier: Apache-2.0
#include "app/design/track_section.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

/// A strip along a direction, 4 m wide, straight between its stations; how high it is says
/// `height_m` of the place along and across.
template <class Height>
design::Surface strip(const std::vector<double>& station_m, const Eigen::Vector2d& from_m,
                      double heading_rad, Height height_m) {
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  const Eigen::Vector2d left(-along.y(), along.x());
  design::Surface surface;
  for (const double x_m : station_m) {
    for (const double y_m : {2.0, -2.0}) {
      const Eigen::Vector2d at_m = from_m + x_m * along + y_m * left;
      surface.point_m.emplace_back(at_m.x(), at_m.y(), height_m(x_m, y_m));
    }
  }
  for (std::uint32_t i = 0; i + 1 < station_m.size(); ++i) {
    surface.face.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    surface.face.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  return surface;
}

const std::vector<double> kStations = {0.0, 4.0, 5.0, 9.0, 20.0};
double trench_m(double x_m, double /*y_m*/) {
  return x_m < 5.0 ? -0.35 * std::max(0.0, x_m - 4.0) : -0.35 + 0.01 * (x_m - 5.0);
}
const design::BladeAcross kBlade{2.5, 0.02};

design::Track track_of(const Eigen::Vector2d& from_m, double heading_rad, double length_m) {
  return {from_m,
          from_m + length_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad))};
}

double height_m(const std::vector<GradePoint>& corners, double x_m) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (x_m <= corners[i].x_m) {
      const double share = (x_m - corners[i - 1].x_m) / (corners[i].x_m - corners[i - 1].x_m);
      return corners[i - 1].z_m + share * (corners[i].z_m - corners[i - 1].z_m);
    }
  }
  return std::nan("");
}

/// Wherever it lies on the earth and whichever way it goes, the section is that of the strip.
TEST(the_section_is_the_surface_along_the_track) {
  for (const double heading_rad : {0.0, 0.3, 1.5707963, -2.5}) {
    const Eigen::Vector2d from_m(400123.25, 5600456.5);
    const design::Surface surface = strip(kStations, from_m, heading_rad, trench_m);
    const auto corners =
        design::along_track(surface, track_of(from_m, heading_rad, 20.0 - 1e-6), 0.0, kBlade)
            .corners;
    assert_near(corners.front().x_m, 0.0, 0.0);
    assert_near(corners.back().x_m, 20.0, 1e-4);
    for (double x_m = 0.01; x_m < 19.9; x_m += 0.37) {
      assert_near(height_m(corners, x_m), trench_m(x_m, 0.0), 1e-6);
    }
  }
}

TEST(a_track_may_begin_and_end_inside_and_count_from_a_datum) {
  const design::Surface surface = strip(kStations, {0.0, 0.0}, 0.0, [](double x_m, double y_m) {
    return 412.0 + trench_m(x_m, y_m);
  });
  const auto corners =
      design::along_track(surface, {{3.0, 0.0}, {10.0, 0.0}}, 412.0, kBlade).corners;
  assert_near(corners.front().z_m, 0.0, 1e-9);
  assert_near(height_m(corners, 2.0), -0.35, 1e-9);
  assert_near(corners.back().x_m, 7.0, 1e-9);
}

std::string refusal(const design::Surface& surface, const design::Track& track,
                    const design::BladeAcross& blade = kBlade) {
  return test::refusal_of(
      [&] { static_cast<void>(design::along_track(surface, track, 0.0, blade)); });
}

TEST(holes_and_overhangs_are_refused_with_the_place) {
  const design::Surface whole = strip(kStations, {0.0, 0.0}, 0.0, trench_m);
  const design::Track track{{0.0, 0.0}, {20.0, 0.0}};
  assert_true(refusal(whole, track).empty());
  design::Surface holed = whole;
  holed.face.erase(holed.face.begin() + 2, holed.face.begin() + 4);
  assert_true(has(refusal(holed, track), "a hole at x = 4.000 .. 5.000 m, under the track"));
  assert_true(has(refusal(whole, {{0.0, 0.0}, {22.0, 0.0}}), "a hole at x = 20.000 .. 22.000 m"));
  // The track is on it, an end of the blade is not.
  assert_true(has(refusal(whole, {{0.0, 1.0}, {20.0, 1.0}}), "1.25 m left of the track"));
  design::Surface twice = whole;
  for (const double x_m : {6.0, 8.0}) {
    for (const double y_m : {2.0, -2.0}) {
      twice.point_m.emplace_back(x_m, y_m, 0.3);
    }
  }
  twice.face.push_back({10, 11, 12});
  twice.face.push_back({11, 13, 12});
  assert_true(has(refusal(twice, track), "allowed: one height a place"));
}

/// 2 % over the half of 2.5 m are 25 mm.
TEST(a_slope_across_is_refused_beyond_the_tolerance) {
  const auto across = [](double slope) {
    return strip(kStations, {0.0, 0.0}, 0.0,
                 [slope](double x_m, double y_m) { return trench_m(x_m, 0.0) + slope * y_m; });
  };
  const design::Track track{{0.0, 0.0}, {20.0, 0.0}};
  assert_true(refusal(across(0.015), track).empty());
  const std::string refused = refusal(across(0.02), track);
  assert_true(has(refused, "0.025 m higher") && has(refused, "1.25 m left of the track"));
  assert_true(has(refused, "allowed: -0.02 .. 0.02 m") && has(refused, "no tilt"));
}

/// The slope between the ends, positive where the left one is higher; whichever way the track goes.
TEST(a_blade_that_tilts_takes_the_slope_across) {
  const design::BladeAcross tilts{2.5, 0.02, true};
  const design::Surface surface = strip(kStations, {3.0, 4.0}, 0.3, [](double x_m, double y_m) {
    return 412.0 + trench_m(x_m, 0.0) + 0.08 * y_m;
  });
  const Eigen::Vector2d begin_m(3.0, 4.0);
  const design::Track there = track_of(begin_m, 0.3, 20.0 - 1e-6);
  const machines::DesignLine line = design::along_track(surface, there, 412.0, tilts);
  assert_int_equal(line.cross.size(), line.corners.size());
  for (std::size_t i = 0; i < line.cross.size(); ++i) {
    assert_near(line.cross[i], 0.08, 1e-9);
    assert_near(line.corners[i].z_m, trench_m(line.corners[i].x_m, 0.0), 1e-6);
  }
  const machines::DesignLine back =
      design::along_track(surface, {there.to_m, there.from_m}, 412.0, tilts);
  assert_near(back.cross.front(), -0.08, 1e-9);
}

/// A straight edge makes no crown, and no blade tilts so far.
TEST(a_crown_and_a_steep_slope_across_are_refused) {
  const design::BladeAcross tilts{2.5, 0.02, true};
  design::Surface crown;
  for (const double x_m : {0.0, 20.0}) {
    for (const double y_m : {-2.0, 0.0, 2.0}) {
      crown.point_m.emplace_back(x_m, y_m, -0.03 * std::abs(y_m));
    }
  }
  crown.face = {{0, 3, 1}, {3, 4, 1}, {1, 4, 2}, {4, 5, 2}};
  const design::Track track{{0.0, 0.0}, {20.0, 0.0}};
  const std::string refused = refusal(crown, track, tilts);
  assert_true(has(refused, "0.037 m higher than straight between the ends") ||
              has(refused, "0.038 m higher than straight between the ends"));
  assert_true(has(refused, "allowed: -0.02 .. 0.02 m"));
  const auto steep =
      strip(kStations, {0.0, 0.0}, 0.0, [](double, double y_m) { return -0.35 * y_m; });
  assert_true(has(refusal(steep, track, tilts), "a slope of -0.350 across the track at x = 0.00"));
}

TEST(a_track_is_straight_and_of_a_length) {
  const auto refused = [](const std::vector<double>& corners_m) {
    return test::refusal_of([&] { static_cast<void>(design::straight_track(corners_m)); });
  };
  assert_near(design::straight_track({1.0, 2.0, 4.0, 2.0, 7.0, 2.0}).length_m(), 6.0, 1e-12);
  assert_true(has(refused({0.0, 0.0, 10.0, 0.0, 20.0, 2.0}), "bends by 0.197 rad at x = 10"));
  assert_true(has(refused({0.0, 0.0, 10.0, 0.0, 20.0, 2.0}), "with --radius"));
  assert_true(has(refused({0.0, 0.0, 10.0}), "3 numbers"));
  assert_true(has(refused({0.0, 0.0, 0.5, 0.0}), "allowed: 1 .. 1000 m"));
  assert_true(has(refused({0.0, 0.0, 1001.0, 0.0}), "allowed: 1 .. 1000 m"));
}

TEST(unless_told_it_goes_along_x_through_the_middle) {
  const design::Track track = design::middle_track(strip(kStations, {10.0, 7.0}, 0.0, trench_m));
  assert_near(track.from_m.x(), 10.0, 1e-12);
  assert_near(track.from_m.y(), 7.0, 1e-12);
  assert_near(track.to_m.x(), 30.0, 1e-12);
}
