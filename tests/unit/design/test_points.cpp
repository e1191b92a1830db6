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

design::Surface read_as(const std::string& text, const std::string& columns,
                        const std::string& units = "") {
  const test::WrittenFile file("points.txt", text);
  return design::read_points(file.path(), {columns, design::metres_of_unit(units)});
}

Eigen::Vector3d last_of(const design::Surface& surface) { return surface.point_m.back(); }

const Eigen::Vector3d kFar(1040.0, 2020.0, 50.8);

/// What spreadsheets and instruments put round numbers.
TEST(marks_pluses_ends_and_blank_rows_are_no_numbers) {
  for (const char* const text :
       {"\xEF\xBB\xBF"
        "1000,2000,50\n1040,2000,50.8\n1040,2020,50.8\n",
        "+1000.0 +2000.0 +50\r\n+1040.0 2000 50.8\r\n1040 2020 50.8\r\n\r\n",
        "\"1000\",\"2000\",\"50\"\n1040,2000,50.8,,\n1040,2020,50.8\n,,\n,,,\n",
        "1000; 2000; 50\n1040;2000;50.8\n1040;2020;50.8",
        "1000\t2000\t50\n1040\t2000\t50.8\n1040\t2020\t50.8\t\n"}) {
    assert_near((last_of(read(text)) - kFar).norm(), 0.0, 1e-4);
  }
}

TEST(columns_and_units_as_told) {
  const char* const pnezd =
      "1,2000,1000,50,GRD\nTP-2,2000,1040,50.8,\"edge, of slab\"\n3,2020,1040,50.8\n";
  assert_near((last_of(read_as(pnezd, "PNEZD")) - kFar).norm(), 0.0, 1e-4);
  assert_near(
      (last_of(read_as("2000 1000 50 a b\n2000 1040 50.8\n2020 1040 50.8 c\n", "nezd")) - kFar)
          .norm(),
      0.0, 1e-4);
  assert_near(last_of(read_as(pnezd, "PNEZD", "ft")).x(), 1040.0 * 0.3048, 1e-4);
  assert_near(last_of(read_as(pnezd, "PNEZD", "us-ft")).y(), 2020.0 * 1200.0 / 3937.0, 1e-4);
  assert_true(has(refusal(pnezd), "more columns or another order by --columns, as PNEZD"));
  const auto refused = [](const char* columns, const char* units) {
    return test::refusal_of([&] { static_cast<void>(read_as("1 2 3\n", columns, units)); });
  };
  assert_true(has(refused("PNQ", ""), "--columns PNQ: 'Q'; allowed: P, N, E, X, Y, Z, D"));
  assert_true(has(refused("PNE", ""), "no column for z"));
  assert_true(has(refused("XYNZ", ""), "two columns for y"));
  assert_true(has(refused("", "yd"), "--units yd; allowed: m, ft, us-ft"));
  assert_true(has(test::refusal_of([&] { static_cast<void>(read_as("1,2\n", "PNEZD")); }),
                  "line 1: column 3: an empty cell"));
}

TEST(a_header_says_the_columns) {
  const char* const rows = "1,2000,1000,50,GRD\n2,2000,1040,50.8\n3,2020,1040,50.8\n";
  const auto with = [&](const std::string& header) { return header + "\n" + rows; };
  assert_near(
      (last_of(read(with("Point,Northing (m),Easting (m),Elevation (m),Description"))) - kFar)
          .norm(),
      0.0, 1e-4);
  assert_near((last_of(read_as(with("Nr;a;b;c"), "PNEZD")) - kFar).norm(), 0.0, 1e-4);
  assert_true(has(refusal(with("Point,Northing,Easting,Code")), "line 1: no column for z"));
  assert_true(
      has(refusal(with("P,N (ft),E (ft),Z (ft)")), "line 1: 'N (ft)' against a unit of 1 m"));
}

TEST(what_only_looks_like_a_number_is_named) {
  assert_true(has(refusal("1000,5;2000,5;50,1\n"), "line 1: '1000,5' has a decimal comma"));
  assert_true(has(refusal("1000,5 2000,5 50,1\n"), "two words between commas"));
  assert_true(has(refusal("1000,5,2000,5,50,1\n"), "line 1: 6 numbers, as a decimal comma makes"));
  // Cells beyond those that are named are passed over, and these are no such cells.
  const auto halves = [](const char* text, const char* columns) {
    return has(test::refusal_of([&] { static_cast<void>(read_as(text, columns)); }),
               " numbers, as a decimal comma makes");
  };
  assert_true(halves("1,2000,5,1000,5,50,1\n", "PNEZD"));
  assert_true(halves("1,2000,5,1000,5,50,1,7\n", "PNEZD"));
  assert_true(halves("1000,5,2000,5,50,1\n", "ENZ"));
  assert_true(has(refusal("P,N,E,Z\n1,2000,5,1000,5,50,1\n"), "line 2: 7 numbers, as a decimal"));
  // Colours behind a point of whole numbers are none.
  assert_near(
      (last_of(read("X,Y,Z\n0,0,1,255,255,255\n0.5,40,1,255,255,255\n1040,2020,50.8,1,2,3\n")) -
       kFar)
          .head<2>()
          .norm(),
      0.0, 1e-4);
  assert_near((last_of(read("N,E,Z\n2000,1000,50,9\n2000,1040,50,9\n2020,1040,50,9\n")) - kFar)
                  .head<2>()
                  .norm(),
              0.0, 1e-4);
  assert_near(
      (last_of(read_as("2000,1000,50,1,2\n2000,1040,50,1,2\n2020,1040,50,1,2\n", "NEZ")) - kFar)
          .head<2>()
          .norm(),
      0.0, 1e-4);
  assert_true(has(refusal("1000.5,2000.5,50.1,7\n"), "line 1: 4 numbers; allowed: 3"));
  assert_true(has(refusal("1 2 \xE2\x88\x92"
                          "3\n"),
                  "(U+2212), a typographic minus"));
  assert_true(has(refusal("1 2 \xE2\x80\x9C"
                          "3\xE2\x80\x9D\n"),
                  "(U+201C), a typographic quote"));
  assert_true(has(refusal("1 2 3\xB0\n"), "the byte 0xB0, as Latin-1 has it; allowed: UTF-8"));
  assert_true(has(refusal(std::string("\xFF\xFE"
                                      "1\0 \0",
                                      6)),
                  "is UTF-16; allowed: UTF-8"));
  assert_true(has(refusal("1,,3\n"), "line 1: an empty cell; allowed: x, y and z"));
}
