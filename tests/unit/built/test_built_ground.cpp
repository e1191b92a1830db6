// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/built/built_files.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

/// Over x = 0 .. 1, y = 0 .. 0.5 at this height; cells of 0.25 m.
ground::EdgeStep over(double height_m, double time_s) {
  ground::EdgeStep step;
  step.from.left_m = {0.0, 0.5, height_m};
  step.from.right_m = {0.0, 0.0, height_m};
  step.to.left_m = {1.0, 0.5, height_m};
  step.to.right_m = {1.0, 0.0, height_m};
  step.to.at_work = true;
  step.time_s = time_s;
  return step;
}

built::BuiltGround ground(built::BuiltHeight height = built::BuiltHeight::kLowest) {
  built::CellGrid grid(0.25);
  grid.add(over(-0.5, 1.0e9));
  ground::EdgeStep shorter = over(-0.4, 1.0e9 + 60.25);
  shorter.to.left_m.x() = shorter.to.right_m.x() = 0.5;
  grid.add(shorter);
  return built::built_ground(grid, height);
}

design::Surface plane(double x0_m, double x1_m, double height_m, double slope) {
  design::Surface surface;
  for (const auto& [x_m, y_m] :
       {std::pair(x0_m, -1.0), std::pair(x1_m, -1.0), std::pair(x1_m, 1.0), std::pair(x0_m, 1.0)}) {
    surface.point_m.emplace_back(x_m, y_m, height_m + slope * x_m);
  }
  surface.face = {{0, 1, 2}, {0, 2, 3}};
  return surface;
}

TEST(neighbours_are_joined_from_above_against_the_clock) {
  const built::BuiltGround built = ground();
  assert_int_equal(built.point.size(), 8);
  assert_int_equal(built.face.size(), 2 * 3);
  for (const auto& face : built.face) {
    const Eigen::Vector3d a = built.point[face[1]].at_m - built.point[face[0]].at_m;
    const Eigen::Vector3d b = built.point[face[2]].at_m - built.point[face[0]].at_m;
    assert_near(a.x() * b.y() - a.y() * b.x(), 0.25 * 0.25, 1e-12);
  }
}

TEST(three_of_a_square_make_one_triangle) {
  // Each corner of a square of four cells is missing once.
  for (int missing = 0; missing < 4; ++missing) {
    built::CellGrid grid(1.0);
    for (int n = 0; n < 4; ++n) {
      const double x_m = n % 2;
      const double y_m = n / 2;
      ground::EdgeStep cell;
      cell.from.left_m = {x_m + 0.1, y_m + 0.9, 0.0};
      cell.from.right_m = {x_m + 0.1, y_m + 0.1, 0.0};
      cell.to.left_m = {x_m + 0.9, y_m + 0.9, 0.0};
      cell.to.right_m = {x_m + 0.9, y_m + 0.1, 0.0};
      cell.to.at_work = n != missing;
      grid.add(cell);
    }
    const built::BuiltGround built = built::built_ground(grid, built::BuiltHeight::kLowest);
    assert_int_equal(built.point.size(), 3);
    assert_int_equal(built.face.size(), 1);
  }
}

TEST(lowest_or_newest_counts_and_what_fell_in_is_counted) {
  assert_near(ground().point[0].at_m.z(), -0.5, 1e-12);
  const built::BuiltGround newest = ground(built::BuiltHeight::kNewest);
  assert_near(newest.point[0].at_m.z(), -0.4, 1e-12);
  assert_near(newest.point[0].time_s, 1.0e9 + 60.25, 1e-3);
  assert_near(newest.point[3].at_m.z(), -0.5, 1e-12);
  assert_int_equal(built::fallen_in(ground()), 4);
}

TEST(cut_and_fill_against_a_design) {
  built::BuiltGround built = ground(built::BuiltHeight::kNewest);
  built::lay_over(plane(-1.0, 0.75, -0.42, 0.0), built);
  const built::DesignFigures figures = built::design_figures(built, 0.03);
  assert_int_equal(figures.cells, 6);
  assert_near(figures.area_m2, 6 * 0.0625, 1e-12);
  assert_near(figures.outside_m2, 2 * 0.0625, 1e-12);
  assert_near(figures.highest_m, 0.02, 1e-12);
  assert_near(figures.lowest_m, -0.08, 1e-12);
  assert_near(figures.rms_m, std::sqrt((4 * 0.0004 + 2 * 0.0064) / 6.0), 1e-12);
  assert_near(figures.p95_m, 0.08, 1e-12);
  assert_near(figures.within_ratio, 4.0 / 6.0, 1e-12);
  assert_near(figures.cut_m3, 4 * 0.0625 * 0.02, 1e-12);
  assert_near(figures.fill_m3, 2 * 0.0625 * 0.08, 1e-12);
}

TEST(a_design_elsewhere_or_with_two_heights_is_refused) {
  built::BuiltGround built = ground();
  test::expect_refusal([&] { built::lay_over(plane(5.0, 6.0, 0.0, 0.0), built); },
                       "does not lie under the machine: it reaches from x = 5.0, y = -1.0");
  design::Surface twice = plane(-1.0, 2.0, 0.0, 0.0);
  const design::Surface other = plane(-1.0, 2.0, 0.5, 0.0);
  for (const auto& face : other.face) {
    twice.face.push_back({face[0] + 4, face[1] + 4, face[2] + 4});
  }
  twice.point_m.insert(twice.point_m.end(), other.point_m.begin(), other.point_m.end());
  test::expect_refusal([&] { built::lay_over(twice, built); }, "two heights at x = 0.88, y = 0.12");
}

built::BuiltHead head() {
  built::BuiltHead head;
  head.machine = "mine (profile 0123abcd)";
  head.project = "A & B \"<1>\"\nnext";
  head.version = "1.2";
  head.from_s = 1.0e9;
  head.until_s = 1.0e9 + 90.0;
  return head;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(times_are_utc) {
  assert_string_equal(built::utc_text(1.0e9).c_str(), "2001-09-09T01:46:40Z");
  assert_string_equal(built::utc_text(1.0e9 + 0.996, 2).c_str(), "2001-09-09T01:46:41.00Z");
}

/// Names are escaped; north is y.
TEST(landxml_says_unit_date_machine_and_project) {
  const std::string text = built::landxml_text(ground(), head());
  assert_true(has(text, "version=\"1.2\" date=\"2001-09-09\" time=\"01:48:10\""));
  assert_true(has(text, "linearUnit=\"meter\""));
  assert_true(has(text,
                  "<Project name=\"A &amp; B &quot;&lt;1&gt;&quot; next\" desc=\"As built by "
                  "mine (profile 0123abcd), 2001-09-09T01:46:40Z to"));
  assert_true(has(text, "<P id=\"2\">0.1250 0.3750 -0.5000</P>"));
  assert_true(has(text, "<F>1 2 6</F>"));
}

TEST(points_have_their_time_and_both_heights) {
  const std::string text = built::points_text(ground(built::BuiltHeight::kNewest), head());
  assert_true(has(text, "# A & B \"<1>\" next: as built by mine"));
  assert_true(has(text,
                  "\nx,y,z,time,passes,lowest,newest\n0.1250,0.1250,-0.4000,"
                  "2001-09-09T01:47:40.25Z,2,-0.5000,-0.4000\n"));
}

/// The most northern row first; cells between that nobody has made are no data.
TEST(an_ascii_grid_has_its_rows_from_the_north) {
  built::BuiltGround built = ground(built::BuiltHeight::kNewest);
  built.point.erase(built.point.begin() + 1);
  const std::string text = built::ascii_text(built);
  assert_string_equal(text.c_str(),
                      "ncols 4\nnrows 2\nxllcorner 0.0000\nyllcorner 0.0000\ncellsize 0.25\n"
                      "NODATA_value -9999\n-0.4000 -0.4000 -0.5000 -0.5000\n"
                      "-0.4000 -9999 -0.5000 -0.5000\n");
}
