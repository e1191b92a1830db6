// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <sstream>

#include "app/design/surface.hpp"
#include "app/design/track_section.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

design::Surface read(const std::string& text) {
  const test::WrittenFile file("points.xyz", text);
  return design::read_points(file.path());
}

std::string refusal(const std::string& text) {
  return test::refusal_of([&] { static_cast<void>(read(text)); });
}

double area_m2(const design::Surface& surface) {
  double sum_m2 = 0.0;
  for (const auto& face : surface.face) {
    const Eigen::Vector2d a = (surface.point_m[face[1]] - surface.point_m[face[0]]).head<2>();
    const Eigen::Vector2d b = (surface.point_m[face[2]] - surface.point_m[face[0]]).head<2>();
    sum_m2 += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return sum_m2;
}

/// An even grid is the worst of all: every four points lie on a circle.
TEST(a_grid_is_covered_once) {
  std::ostringstream text;
  text.precision(12);
  text << "# a ramp\n";
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 6; ++j) {
      text << 500000.5 + i << "; " << 4000.0 + j << "; " << 0.1 * i << "\n";
    }
  }
  const design::Surface surface = read(text.str());
  assert_int_equal(surface.point_m.size(), 21 * 7);
  assert_int_equal(surface.face.size(), 2 * 20 * 6);
  assert_near(area_m2(surface), 120.0, 1e-6);
  const auto corners =
      design::along_track(surface, design::middle_track(surface), 0.0, {2.0, 0.02}).corners;
  assert_near(corners.back().z_m - corners.front().z_m, 2.0, 1e-9);
}

/// Delaunay's: of a flat rhombus the short diagonal.
TEST(triangles_are_delaunays) {
  const design::Surface surface = read("0 0 0\n5 1 0\n10 0 0\n5 -1 0\n5 1 0\n");
  assert_int_equal(surface.point_m.size(), 4);
  assert_int_equal(surface.face.size(), 2);
  for (const auto& face : surface.face) {
    int on_short = 0;
    for (const std::uint32_t point : face) {
      on_short += surface.point_m[point].x() > 4.0 && surface.point_m[point].x() < 6.0 ? 1 : 0;
    }
    assert_int_equal(on_short, 2);
  }
}

TEST(what_is_malformed_is_refused_with_its_line) {
  assert_true(has(refusal("1 2 3\n1 2\n"), "line 2: 2 numbers; allowed: 3, x, y and z, m"));
  assert_true(has(refusal("1 2 3\n\n1 2 x\n"), "line 3: 'x' is no finite number"));
  assert_true(has(refusal("1 2 inf\n"), "line 1: 'inf' is no finite number"));
  assert_true(has(refusal("1 2 3e5\n"), "line 1: z = 300000 m; allowed: -10000 .. 10000 m"));
  assert_true(has(refusal("0 0 0\n1 0 0\n2 0 0\n"), "make no triangle"));
  assert_true(has(refusal(""), "0 points make no triangle"));
  assert_true(has(refusal("0 0 0\n1 0 0\n0 1 0\n0 0 1\n"), "allowed: one height a place"));
  assert_true(has(refusal("0 0 0\n1e6 0 0\n0 1 0\n"), "reaches over 1000000 m"));
}
