// SPDX-License-Identifier: Apache-2.0
#include "app/built/cell_grid.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

/// Two metres wide across x, at this x and height.
ground::EdgePlace edge(double x_m, double height_m, bool at_work) {
  ground::EdgePlace place;
  place.left_m = {x_m, 1.0, height_m};
  place.right_m = {x_m, -1.0, height_m};
  place.at_work = at_work;
  return place;
}

ground::EdgeStep step(double from_x_m, double to_x_m, double height_m, double time_s,
                      bool at_work = true) {
  return {edge(from_x_m, height_m, at_work), edge(to_x_m, height_m, at_work), time_s};
}

TEST(a_way_makes_the_cells_whose_centres_it_passes) {
  built::CellGrid grid(0.1);
  grid.add(step(0.0, 1.0, -0.5, 1.0));
  assert_int_equal(grid.size(), 10 * 20);
  const auto cells = grid.sorted();
  assert_int_equal(cells.front().first.i, 0);
  assert_int_equal(cells.front().first.j, -10);
  assert_int_equal(cells.back().first.i, 9);
  assert_int_equal(cells.back().first.j, 9);
  assert_near(grid.centre_m(cells.front().first).x(), 0.05, 1e-12);
  assert_near(grid.centre_m(cells.front().first).y(), -0.95, 1e-12);
  assert_near(cells.front().second.lowest_m, -0.5, 1e-12);
}

/// No bias by the cell's size: of a slope each centre has its own height.
TEST(heights_are_those_of_the_centres) {
  built::CellGrid grid(0.5);
  ground::EdgeStep down = step(0.0, 2.0, 0.0, 1.0);
  down.to.left_m.z() = -2.0;
  down.to.right_m.z() = -2.0;
  grid.add(down);
  assert_int_equal(grid.size(), 4 * 4);
  for (const auto& [place, cell] : grid.sorted()) {
    assert_near(cell.lowest_m, -grid.centre_m(place).x(), 1e-12);
  }
}

/// Both ends of an edge that is tilted count.
TEST(an_edge_that_is_tilted_makes_a_slope_across) {
  built::CellGrid grid(0.1);
  ground::EdgeStep tilted = step(0.0, 1.0, 0.0, 1.0);
  tilted.from.left_m.z() = tilted.to.left_m.z() = 0.2;
  tilted.from.right_m.z() = tilted.to.right_m.z() = -0.2;
  grid.add(tilted);
  for (const auto& [place, cell] : grid.sorted()) {
    assert_near(cell.lowest_m, 0.2 * grid.centre_m(place).y(), 1e-12);
  }
}

TEST(newest_and_lowest_passes_are_told_apart) {
  built::CellGrid grid(0.1);
  grid.add(step(0.0, 1.0, -0.5, 1.0));
  grid.add(step(1.0, 0.0, -0.7, 1.5));  // The same pass: it has just been there.
  grid.add(step(0.0, 1.0, -0.6, 10.0));
  const built::Cell* cell = grid.at({4, 4});
  assert_non_null(cell);
  assert_near(cell->lowest_m, -0.7, 1e-12);
  assert_near(cell->lowest_s, 1.5, 1e-12);
  assert_near(cell->newest_m, -0.6, 1e-12);
  assert_near(cell->newest_s, 10.0, 1e-12);
  assert_int_equal(cell->passes, 2);
}

/// In the air it makes nothing, but under ground that is known it can only have cut.
TEST(an_edge_that_is_not_at_work_counts_under_known_ground_alone) {
  built::CellGrid grid(0.1);
  grid.add(step(0.0, 1.0, -0.9, 1.0, false));
  assert_int_equal(grid.size(), 0);
  grid.add(step(0.0, 1.0, -0.5, 2.0));
  grid.add(step(0.0, 2.0, -0.4, 4.0, false));
  assert_near(grid.at({4, 4})->newest_m, -0.5, 1e-12);
  grid.add(step(0.0, 2.0, -0.6, 6.0, false));
  assert_near(grid.at({4, 4})->lowest_m, -0.6, 1e-12);
  assert_null(grid.at({14, 4}));
}

TEST(an_edge_that_only_rises_makes_nothing) {
  built::CellGrid grid(0.1);
  ground::EdgeStep up = step(0.5, 0.5, 0.0, 1.0);
  up.to.left_m.z() = up.to.right_m.z() = 1.0;
  grid.add(up);
  assert_int_equal(grid.size(), 0);
}

TEST(too_many_cells_are_refused) {
  built::CellGrid grid(0.02);
  ground::EdgeStep wide = step(0.0, 500.0, 0.0, 1.0);
  test::expect_refusal([&] { grid.add(wide); }, "more than 1000000 cells of 0.02 m");
}
