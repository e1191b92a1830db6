// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/design/design_source.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/foreign/foreign_file.hpp"
#include "tests/unit/design/written_file.hpp"

using test::ForeignFile;

/// What is wrong with a surface that was read; empty: nothing.
std::string wrong_of(const design::Surface& surface, const ForeignFile& row) {
  double area = 0.0;
  for (const auto& face : surface.face) {
    std::array<Eigen::Vector3d, 3> at;
    for (unsigned i = 0; i < 3; ++i) {
      at[i] = surface.point_m[face[i]] / row.metres;
      const double x = at[i].x() - 1000.0;
      const double y = at[i].y() - 2000.0;
      if (std::abs(at[i].z() - (50.0 + 0.02 * x + 0.1 * y)) > 1e-6 || x < -1e-6 || x > 10.000001 ||
          y < -1e-6 || y > 6.000001) {
        return "a corner is off the ground";
      }
    }
    area += 0.5 * std::abs((at[1] - at[0]).cross(at[2] - at[0]).z());
  }
  // Points are rounded to 0.1 mm.
  return std::abs(area - row.area) < 1e-3
             ? ""
             : "its area is " + std::to_string(area) + ", not " + std::to_string(row.area);
}

void expect_rows(const std::vector<ForeignFile>& rows, std::size_t at_least) {
  assert_true(rows.size() >= at_least);
  bool sound = true;
  for (const ForeignFile& row : rows) {
    const test::WrittenFile file(row.name, row.text);
    design::DesignSource source;
    source.file = file.path();
    source.surface = row.surface;
    source.columns = row.columns;
    source.units = row.units;
    std::string wrong;
    const std::string said = test::refusal_of([&] {
      const design::Surface surface = design::surface_of(source);
      wrong = row.refused.empty() ? wrong_of(surface, row) : "is read";
    });
    if (!said.empty() && row.refused.empty()) {
      wrong = said;
    }
    for (const std::string& word : row.refused) {
      if (!said.empty() && !test::has(said, word)) {
        wrong = "'" + word + "' is not in: " + said;
      }
    }
    if (!wrong.empty()) {
      print_error("%s: %s\n", row.what, wrong.c_str());
      sound = false;
    }
  }
  assert_true(sound);
}

TEST(landxml_of_others) { expect_rows(test::landxml_files(), 18); }

TEST(points_of_others) { expect_rows(test::point_files(), 19); }

TEST(dxf_of_others) { expect_rows(test::dxf_files(), 33); }
