// SPDX-License-Identifier: Apache-2.0
// Which cell and draw a seed of `campaign ground` is.

#include <set>
#include <tuple>

#include "app/runs/ground_campaign.hpp"
#include "tests/unit/cmocka_cpp.hpp"

auto of(const runs::GroundCell& cell) {
  return std::make_tuple(cell.soil, cell.design, cell.engine_rpm);
}

/// 4 soils, 10 designs, 3 engine speeds: each once, then each with the next draw.
TEST(every_cell_comes_once_before_the_next_draw) {
  assert_int_equal(static_cast<int>(runs::ground_cells()), 120);
  for (std::uint64_t draw = 1; draw <= 3; ++draw) {
    std::set<decltype(of({}))> cells;
    for (std::uint64_t n = 1; n <= 120; ++n) {
      const runs::GroundDraw drawn = runs::ground_draw((draw - 1) * 120 + n);
      assert_int_equal(static_cast<int>(drawn.seed), static_cast<int>(draw));
      assert_true(drawn.cell.design < 10);
      cells.insert(of(drawn.cell));
    }
    assert_int_equal(static_cast<int>(cells.size()), 120);
  }
}

TEST(the_soil_changes_first_and_the_engine_last) {
  assert_true(of(runs::ground_draw(1).cell) == std::make_tuple("sand", 0U, 1000.0));
  assert_true(of(runs::ground_draw(2).cell) == std::make_tuple("loam", 0U, 1000.0));
  assert_true(of(runs::ground_draw(5).cell) == std::make_tuple("sand", 1U, 1000.0));
  assert_true(of(runs::ground_draw(41).cell) == std::make_tuple("sand", 0U, 1500.0));
  assert_true(of(runs::ground_draw(120).cell) == std::make_tuple("stones", 9U, 2000.0));
}
