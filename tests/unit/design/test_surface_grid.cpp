// SPDX-License-Identifier: Apache-2.0
#include "app/design/surface_grid.hpp"

#include <algorithm>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"
#include "tests/unit/refusal.hpp"

using design::GridCut;
using design::Surface;

/// Rows of points, `step_m` apart, on a wave; two triangles between each four.
Surface wave(std::uint32_t side, double step_m) {
  Surface surface;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const double x_m = step_m * column;
      const double y_m = step_m * row;
      surface.point_m.emplace_back(500.0 + x_m, 900.0 + y_m, 40.0 + std::sin(x_m) + 0.2 * y_m);
      if (row > 0 && column > 0) {
        const std::uint32_t here = row * side + column;
        surface.face.push_back({here, here - 1, here - side - 1});
        surface.face.push_back({here, here - side - 1, here - side});
      }
    }
  }
  return surface;
}

/// Every height is that of the triangle it lies on, also on an edge of it; what has no triangle has
/// none.
TEST(heights_are_those_of_the_triangles) {
  const Surface surface = wave(9, 0.7);
  const machines::HeightGrid grid = design::grid_of(surface, {0.05, {}});
  assert_near(grid.first_m.x(), 500.0, 1e-9);
  assert_int_equal(grid.columns, 113);
  for (int row = 1; row + 1 < grid.rows; row += 7) {
    for (int column = 1; column + 1 < grid.columns; column += 5) {
      const Eigen::Vector2d at_m = grid.first_m + 0.05 * Eigen::Vector2d(column, row);
      assert_near(grid.at(column, row), design::height_at(surface, at_m), 1e-9);
    }
  }
  Surface holed = surface;
  holed.face.erase(holed.face.begin() + 60);
  const machines::HeightGrid with_hole = design::grid_of(holed, {0.05, {}});
  const auto unknown = [](const machines::HeightGrid& of) {
    return std::count_if(of.height_m.begin(), of.height_m.end(),
                         [](double height_m) { return std::isnan(height_m); });
  };
  assert_int_equal(unknown(grid), 0);
  assert_true(unknown(with_hole) > 70 && unknown(with_hole) < 100);
}

/// A square about the machine has the same heights as the whole.
TEST(a_cut_is_a_part_of_the_whole) {
  const Surface surface = wave(9, 0.7);
  const machines::HeightGrid whole = design::grid_of(surface, {0.05, {}});
  const machines::HeightGrid part =
      design::grid_of(surface, {0.05, Eigen::Vector2d(502.0, 903.0), 1.0});
  assert_int_equal(part.columns, 41);
  assert_int_equal(part.rows, 41);
  assert_near(part.at(3, 5), whole.at(23, 45), 1e-12);
  test::expect_refusal(
      [&] {
        return design::grid_of(surface, {0.05, Eigen::Vector2d(520.0, 903.0), 1.0});
      },
      "it reaches from 500.00 m east, 900.00 m north to 505.60, 905.60");
  test::expect_refusal(
      [&] {
        return design::grid_of(wave(9, 500.0), {0.05, {}});
      },
      "allowed: 4000000 in all");
}

TEST(two_heights_at_a_place_are_refused) {
  Surface surface = wave(3, 1.0);
  const auto first = static_cast<std::uint32_t>(surface.point_m.size());
  for (const Eigen::Vector3d& at_m :
       {Eigen::Vector3d(500.2, 900.2, 41.0), Eigen::Vector3d(500.8, 900.2, 41.0),
        Eigen::Vector3d(500.2, 900.8, 41.0)}) {
    surface.point_m.push_back(at_m);
  }
  surface.face.push_back({first, first + 1, first + 2});
  test::expect_refusal(
      [&] {
        return design::grid_of(surface, {0.05, {}});
      },
      "m high at 500.20 m east, 900.20 m north; allowed: one height a place");
}

/// What is written is read as it was, a hundredth of a millimetre left aside.
TEST(a_grid_that_is_written_is_read) {
  Surface holed = wave(9, 0.7);
  holed.face.erase(holed.face.begin() + 60);
  const machines::HeightGrid grid = design::grid_of(holed, {0.1, {}});
  const test::WrittenFile file("wave.asc", design::ascii_grid_text(grid));
  const machines::HeightGrid read = machines::read_ascii_grid(file.path());
  assert_int_equal(read.columns, grid.columns);
  assert_int_equal(read.rows, grid.rows);
  assert_near((read.first_m - grid.first_m).norm(), 0.0, 1e-4);
  for (std::size_t i = 0; i < grid.height_m.size(); ++i) {
    assert_int_equal(std::isnan(read.height_m[i]), std::isnan(grid.height_m[i]));
    assert_true(std::isnan(read.height_m[i]) ||
                std::abs(read.height_m[i] - grid.height_m[i]) < 1e-4);
  }
}
