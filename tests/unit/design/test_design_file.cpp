// SPDX-License-Identifier: Apache-2.0
#include "app/machines/design_file.hpp"

#include <cmath>

#include "app/design/design_source.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "firmware/dozer/grade_profile.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"
#include "tests/unit/firmware/tilting_dozer.hpp"

using test::has;

std::vector<GradePoint> shipped() {
  const GradeDesign& grade = test::dozer().profile.grade;
  return {grade.point.begin(), grade.point.begin() + grade.count};
}

/// The same corners, as points with rounding and as heights on a grid, are the same design.
TEST(heights_are_the_points_with_their_rounding) {
  const machines::DesignHeights heights = machines::heights_of(shipped(), 0.3);
  GradeDesign on_grid = test::dozer().profile.grade;
  on_grid.count = 0;
  on_grid.heights = {heights.height_m->data(), nullptr, static_cast<int>(heights.height_m->size()),
                     heights.from_m};
  const GradeProfile of_points(test::dozer().profile.grade);
  const GradeProfile of_heights(on_grid);
  assert_near(on_grid.end_m(), 27.0, 1e-9);
  for (double x_m = -2.0; x_m < 30.0; x_m += 0.013) {
    assert_near(of_heights.at(x_m).height_m, of_points.at(x_m).height_m, 2e-4);
    assert_near(of_heights.at(x_m).slope, of_points.at(x_m).slope, 0.02);
  }
}

void read(const std::string& text) {
  const test::WrittenFile file("design.txt", text);
  static_cast<void>(machines::read_design(file.path()));
}

TEST(what_is_malformed_is_refused_with_its_line) {
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { read(text); });
  };
  assert_true(refusal("# two\n0 0\n 5; -0.1\n").empty());
  assert_true(has(refusal("0 0\n5 0\n5 -0.1\n"), "line 3: x = 5 m; allowed: more than the line"));
  assert_true(has(refusal("0 0\n1001 0\n"), "line 2: x = 1001 m; allowed: -1000 .. 1000 m"));
  assert_true(has(refusal("0 0\n1 101\n"), "allowed: -100 .. 100 m"));
  assert_true(has(refusal("0 0 0 0 0\n"), "line 1: 5 numbers; allowed: 2 .. 4, x along the track"));
  assert_true(refusal("0 0 0 0\n5 0 0 0.1\n").empty());
  assert_true(has(refusal("0 0 0 0\n5 0 0\n"), "line 2: allowed: a curvature in every line"));
  assert_true(has(refusal("0 0 0 0.6\n5 0 0 0\n"), "line 1: a curvature of 0.6; allowed: -0.5"));
  assert_true(refusal("0 0 0.1\n5 0 -0.1\n").empty());
  assert_true(has(refusal("0 0 0.1\n5 0\n"), "line 2: allowed: a slope across in every line"));
  assert_true(has(refusal("0 0\n5 0 0.1\n"), "line 2: allowed: a slope across in every line"));
  assert_true(has(refusal("0 0 0.31\n5 0 0\n"), "line 1: a slope across of 0.31; allowed: -0.3"));
  assert_true(has(refusal("0 0\n"), "1 lines over 0 m"));
  assert_true(has(refusal("-1000 0\n1000 0\n"), "over 2000 m; allowed"));
}

/// A cell without a number is one: what stands behind it is not moved up.
TEST(an_empty_cell_is_a_cell) {
  const test::WrittenFile file("design.txt",
                               "0,-0.2,,0.02\r\n10,-0.2,,0.02\r\n20,-0.2,,0.02\r\n,,,\r\n");
  const machines::DesignLine line = machines::read_design(file.path());
  assert_int_equal(line.corners.size(), 3);
  assert_near(line.curvature[1], 0.02, 0.0);
  assert_near(line.cross[1], 0.0, 0.0);
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { read(text); });
  };
  assert_true(has(refusal("0 0\n, 5\n"), "line 2: an empty cell"));
  assert_true(has(refusal("0,5 -0,2\n9,5 -0,2\n"), "two words between commas"));
  assert_true(refusal("x;height\n0;0\n+5;-0.1\n").empty());
  assert_true(has(refusal("height x\n0 0\n5 0\n"),
                  "line 1: column 1: 'height'; allowed: numbers, or as names x"));
}

design::DesignSource named(const std::filesystem::path& file, const std::string& columns = "") {
  design::DesignSource source;
  source.file = file;
  source.columns = columns;
  return source;
}

/// By what it contains; the ending decides only between numbers and numbers, in whatever letters.
TEST(a_file_is_what_it_contains) {
  const auto kind = [](const std::string& name, const std::string& text,
                       const std::string& columns = "") {
    const test::WrittenFile file(name, text);
    return design::kind_of(named(file.path(), columns));
  };
  for (const char* const name : {"a.XML", "a.xml", "a.txt", "a", "a.csv"}) {
    assert_true(kind(name, "\xEF\xBB\xBF\r\n<?xml?>") == design::DesignKind::kLandXml);
  }
  assert_true(kind("a.XYZ", "0 0 0\n") == design::DesignKind::kPoints);
  assert_true(kind("a.Csv", "0 0 0\n") == design::DesignKind::kPoints);
  assert_true(kind("a.txt", "1 0 0 0\n", "PNEZ") == design::DesignKind::kPoints);
  assert_true(kind("a.TXT", "0 0\n") == design::DesignKind::kLine);
  const std::string refused = test::refusal_of([&] { static_cast<void>(kind("a.dat", "0 0\n")); });
  assert_true(has(refused, "a.dat: is no LandXML and no DXF, and its ending '.dat' does not say"));
}

TEST(an_alignment_may_be_in_another_file) {
  const std::string units = "<LandXML><Units><Metric linearUnit=\"meter\"/></Units>";
  const test::WrittenFile points("a.csv", "0,-9,1\n0,9,1\n40,-9,1\n40,9,1\n");
  const test::WrittenFile way("way.xml",
                              units +
                                  "<Alignments><Alignment name=\"CL\"><CoordGeom><Line><Start>0 "
                                  "5</Start><End>0 35</End></Line>"
                                  "</CoordGeom></Alignment></Alignments></LandXML>");
  design::DesignSource source = named(points.path());
  source.alignment_file = way.path();
  source.datum_m = 1.0;
  const machines::DesignLine line = design::line_of(source, {3.0, 0.02, false});
  assert_near(line.corners.back().x_m - line.corners.front().x_m, 30.0, 1e-6);
  source.alignment = "EL";
  const std::string refused = test::refusal_of([&] {
    static_cast<void>(design::line_of(source, {3.0, 0.02, false}));
  });
  assert_true(has(refused, "way.xml") && has(refused, "alignment 'EL' is there 0 times"));
}

TEST(what_is_written_is_read_again) {
  const test::WrittenFile file("out.txt", "");
  for (const double slope : {0.0, 0.04}) {
    machines::DesignLine line = shipped();
    line.cross.assign(slope != 0.0 ? line.corners.size() : 0, slope);
    machines::write_design(file.path(), line);
    const machines::DesignLine again = machines::read_design(file.path());
    assert_int_equal(again.corners.size(), shipped().size());
    assert_int_equal(again.cross.size(), line.cross.size());
    for (std::size_t i = 0; i < again.corners.size(); ++i) {
      assert_near(again.corners[i].x_m, shipped()[i].x_m, 1e-9);
      assert_near(again.corners[i].z_m, shipped()[i].z_m, 1e-9);
      assert_near(slope != 0.0 ? again.cross[i] : 0.0, slope, 1e-9);
    }
  }
}

machines::DesignLine across(const std::vector<double>& slopes) {
  return {{{0.0, 0.0}, {5.0, 0.0}, {8.0, -0.2}, {20.0, -0.2}}, slopes};
}

/// With the same rounding as heights; part of the hash; and only of a machine whose blade tilts.
TEST(a_slope_across_is_part_of_the_design) {
  const auto machine =
      machines::with_design(test::tilting_dozer(), across({0.0, 0.0, 0.03, 0.03}), 0.3, "x");
  const GradeProfile design(machine.profile.grade);
  assert_near(design.cross_at(6.5).slope, 0.015, 1e-9);
  assert_near(design.cross_at(6.5).change_pm, 0.01, 1e-9);
  assert_near(design.cross_at(5.0).slope, 0.00075, 1e-5);  // 0.01 / m times 0.3 m / 4.
  assert_near(design.cross_at(30.0).slope, 0.03, 1e-12);
  const auto other =
      machines::with_design(test::tilting_dozer(), across({0.0, 0.0, 0.03, 0.031}), 0.3, "x");
  const auto level = machines::with_design(test::tilting_dozer(), across({}), 0.3, "x");
  assert_true(machine.hash != other.hash && machine.hash != level.hash);
}

TEST(a_slope_across_that_it_cannot_make_is_refused) {
  const auto refusal = [](const machines::SimulatedDozer& machine,
                          const std::vector<double>& slopes) {
    return test::refusal_of(
        [&] { static_cast<void>(machines::with_design(machine, across(slopes), 0.0, "bank")); });
  };
  assert_true(has(refusal(test::dozer(), {0.0, 0.0, 0.06, 0.06}), "has no [tilt]"));
  const std::string twists = refusal(test::tilting_dozer(), {0.0, 0.0, 0.07, 0.07});
  assert_true(has(twists, "changes by 0.05") && has(twists, "from end to end of its tracks"));
  assert_true(has(twists, "allowed: -0.048 .. 0.048"));
  machines::SimulatedDozer narrow = test::tilting_dozer();
  narrow.profile.tilt.angle_most_rad = 0.01;
  assert_true(has(refusal(narrow, {0.0, 0.0, 0.03, 0.03}), "-0.01 .. 0.01 rad"));
}

TEST(a_curvature_is_part_of_the_design) {
  machines::DesignLine line = across({0.0, 0.0, 0.0, 0.0});
  line.curvature = {0.0, 0.0, 0.05, 0.05};
  const test::WrittenFile file("curve.txt", "");
  machines::write_design(file.path(), line);
  const machines::DesignLine again = machines::read_design(file.path());
  assert_int_equal(again.curvature.size(), line.curvature.size());
  assert_near(again.curvature[2], 0.05, 1e-9);
  const machines::SimulatedDozer machine =
      machines::with_design(test::tilting_dozer(), again, 0.0, "curve");
  const GradeProfile design(machine.profile.grade);
  assert_true(design.curves());
  assert_near(design.curvature_at(line.corners[2].x_m + 1.0), 0.05, 1e-9);
  assert_near(design.curvature_at(line.corners.back().x_m + 1.0), 0.0, 0.0);
  line.curvature = {};
  const auto straight = machines::with_design(test::tilting_dozer(), line, 0.0, "curve");
  assert_true(straight.hash != machine.hash);
  const auto refusal = [&](const machines::SimulatedDozer& of, double curvature_pm) {
    line.curvature = {0.0, 0.0, curvature_pm, curvature_pm};
    return test::refusal_of([&] { static_cast<void>(machines::with_design(of, line, 0.0, "c")); });
  };
  assert_true(has(refusal(test::tilting_dozer(), -0.2), "the track has a radius of"));
  assert_true(has(refusal(test::tilting_dozer(), -0.2), "allowed: at least 8.90"));
}

std::vector<GradePoint> corners(double last_m) {
  return {{0.0, 0.0}, {8.0, 0.0}, {12.0, -0.2}, {20.0, last_m}};
}

/// The machine with it: in both ends, in the hash, as long as it is.
/// Rounding makes a slope of a wall, which is then no more what the file has: that is said.
TEST(a_wall_is_said_with_its_place) {
  const std::vector<GradePoint> stepped = {{0.0, 0.0},   {4.0, 0.0},  {4.01, -0.08}, {4.02, -0.15},
                                           {9.0, -0.15}, {9.1, -0.1}, {27.0, 0.0}};
  assert_string_equal(machines::wall_note({stepped}, 0.3).c_str(),
                      "the design has a wall of -0.150 m at x = 4.01 m: it is judged and graded as "
                      "rounded by grade.rounding, 0.3 m to either side");
  const std::vector<GradePoint> ramp = {{0.0, 0.0}, {4.0, 0.0}, {5.0, -0.6}, {27.0, -0.6}};
  assert_string_equal(machines::wall_note({ramp}, 0.3).c_str(), "");
}

TEST(a_machine_takes_a_design) {
  const machines::SimulatedDozer machine =
      machines::with_design(test::dozer(), corners(-0.2), 0.3, "x");
  assert_near(machine.experiment.length_m, 20.0, 1e-9);
  assert_ptr_equal(machine.plant.machine.grade.heights.height_m,
                   machine.profile.grade.heights.height_m);
  assert_near(GradeProfile(machine.profile.grade).at(18.0).height_m, -0.2, 1e-9);
  const auto other = machines::with_design(test::dozer(), corners(-0.201), 0.3, "x");
  assert_true(machine.hash != test::dozer().hash && machine.hash != other.hash);
}

TEST(what_the_machine_cannot_make_is_refused_with_the_place) {
  const auto refusal = [](const std::vector<GradePoint>& corners) {
    return test::refusal_of(
        [&] { static_cast<void>(machines::with_design(test::dozer(), corners, 0.3, "wall.xml")); });
  };
  const std::string steep = refusal({{0.0, 0.0}, {5.0, 0.0}, {6.0, -0.8}, {20.0, -0.8}});
  assert_true(has(steep, "wall.xml") && has(steep, "a slope of -0.800 at x = 5."));
  assert_true(has(steep, "allowed: -0.6 .. 0.6"));
  const std::string tips =
      refusal({{0.0, 0.0}, {5.0, 0.0}, {5.7, -0.4}, {8.0, -0.4}, {20.0, -0.4}});
  assert_true(has(tips, "with the body at x ="));
}
