// SPDX-License-Identifier: Apache-2.0
// The place that a machine has left: in the store, and by what it is known again.

#include "app/ecu/store/site_mark.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/fault_process.hpp"

using namespace graben::test::stored;

/// Written as soon as what changes is, kept by later runs that say nothing of it, and of one
/// profile.
TEST(the_place_that_was_left_comes_back) {
  MemoryDisk disk;
  {
    Process process(disk);
    process.run(10.0);
    assert_int_equal(stored(disk).history.left_site, 0);
    assert_true(process.rings().left_site.put(0xC0FFEE01U));
    // The power goes without an end.
    process.run(2.0);
  }
  for (int run = 0; run < 2; ++run) {
    Process again(disk);
    assert_int_equal(again.keeper().history().left_site, 0xC0FFEE01U);
    again.run(1.0);
    again.end();
  }
  Process other(disk, 1, kProfile + 1);
  assert_int_equal(other.keeper().history().left_site, 0);
}

TEST(a_place_is_known_by_its_points_else_by_its_designs) {
  TaskBook book;
  book.count = 1;
  book.program[0].fences.count = 1;
  DesignPlane plane;
  book.program[0].fences.fence[0] = plane.fence();
  const std::uint32_t first = site_mark(book);
  assert_int_equal(site_mark(book), first);
  plane.through_m.z() = -0.001;
  book.program[0].fences.fence[0] = plane.fence();
  const std::uint32_t lower = site_mark(book);
  assert_int_not_equal(lower, first);
  // Another design of the same site lies at the same place.
  book.site.can_touch = true;
  const std::uint32_t touched = site_mark(book);
  book.program[0].fences.count = 0;
  assert_int_equal(site_mark(book), touched);
  book.site.second_m.x() = 4.0;
  assert_int_not_equal(site_mark(book), touched);
  std::array<std::int16_t, 4> height{};
  DesignSurface surface;
  surface.height = height.data();
  surface.columns = surface.rows = 2;
  book.site.can_touch = false;
  book.program[0].fences.count = 1;
  book.program[0].fences.fence[0] = surface_fence(surface);
  const std::uint32_t level = site_mark(book);
  height[3] = 1;
  assert_int_not_equal(site_mark(book), level);
}
