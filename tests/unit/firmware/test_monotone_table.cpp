// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "firmware/numeric/monotone_table.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using graben::MonotoneTable;
using Fill = MonotoneTable::Fill;

TEST(reads_both_ways) {
  const double x[] = {0.0, 1.0, 3.0};
  const double y[] = {10.0, 20.0, 21.0};
  MonotoneTable table;
  assert_int_equal(table.fill(x, y, 3), Fill::kOk);
  assert_near(table.at(0.5), 15.0, 1e-12);
  assert_near(table.at(2.0), 20.5, 1e-12);
  assert_near(table.inverse(20.5), 2.0, 1e-12);
  assert_near(table.at(-1.0), 10.0, 0.0);
  assert_near(table.at(9.0), 21.0, 0.0);
  assert_near(table.inverse(0.0), 0.0, 0.0);
  assert_near(table.inverse(99.0), 3.0, 0.0);
}

/// A full table: the bounded search must find every segment.
TEST(a_full_table_finds_every_segment) {
  double x[MonotoneTable::capacity()];
  double y[MonotoneTable::capacity()];
  for (int i = 0; i < MonotoneTable::capacity(); ++i) {
    x[i] = i;
    y[i] = std::pow(static_cast<double>(i), 1.6);
  }
  for (int count = 2; count <= MonotoneTable::capacity(); ++count) {
    MonotoneTable table;
    assert_int_equal(table.fill(x, y, count), Fill::kOk);
    for (int i = 0; i + 1 < count; ++i) {
      assert_near(table.at(i + 0.25), 0.75 * y[i] + 0.25 * y[i + 1], 1e-12);
      assert_near(table.inverse(table.at(i + 0.25)), i + 0.25, 1e-12);
    }
  }
}

TEST(refuses_what_is_no_table) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double x[] = {0.0, 1.0, 2.0};
  const double flat[] = {0.0, 1.0, 1.0};
  const double holed[] = {0.0, nan, 2.0};
  MonotoneTable table;
  assert_int_equal(table.fill(x, x, 1), Fill::kTooFew);
  assert_int_equal(table.fill(x, x, MonotoneTable::capacity() + 1), Fill::kTooMany);
  assert_int_equal(table.fill(x, flat, 3), Fill::kNotIncreasing);
  assert_int_equal(table.fill(flat, x, 3), Fill::kNotIncreasing);
  assert_int_equal(table.fill(x, holed, 3), Fill::kNotFinite);
  assert_int_equal(table.size(), 0);
}
