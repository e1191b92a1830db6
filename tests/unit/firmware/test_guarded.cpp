// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/guarded.hpp"

#include <limits>
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/flip_bit.hpp"

struct Small {
  unsigned char first = 3;
  bool second = true;
  unsigned char third = 0xFF;
};

/// Each bit of the value and each of its complement, one at a time.
template <class T>
void every_flip_is_found(const T& value) {
  static_assert(sizeof(Guarded<T>) == 2 * sizeof(T));
  Guarded<T> guarded(value);
  for (std::size_t bit = 0; bit < 8 * sizeof guarded; ++bit) {
    assert_true(guarded.intact());
    test::flip_bit(guarded, bit);
    assert_false(guarded.intact());
    test::flip_bit(guarded, bit);
  }
  assert_true(guarded.intact());
}

TEST(every_bit_is_guarded) {
  for (const double value : {0.0, -0.0, 1.0, -0.37, std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    every_flip_is_found(value);
  }
  every_flip_is_found(Small{});
  every_flip_is_found(static_cast<unsigned char>(0x5A));
}

/// Memory that was wiped, with zeros or with ones, is no stored value.
TEST(wiped_memory_is_found) {
  for (const int wipe : {0x00, 0xFF}) {
    Guarded<double> guarded(0.5);
    std::memset(static_cast<void*>(&guarded), wipe, sizeof guarded);
    assert_false(guarded.intact());
  }
}

TEST(what_is_stored_is_read, Guarded<double> guarded) {
  assert_true(guarded.intact());
  assert_near(guarded.value(), 0.0, 0.0);
  guarded = -0.25;
  assert_true(guarded.intact());
  assert_near(guarded.value(), -0.25, 0.0);
  const Guarded<double> copy = guarded;
  assert_true(copy.intact());
  assert_near(copy.value(), -0.25, 0.0);
  const Guarded<Small> small;
  assert_true(small.intact());
  assert_int_equal(small.value().first, 3);
  assert_int_equal(small.value().third, 0xFF);
}

/// A copy keeps the damage; a new value ends it.
TEST(damage_is_not_copied_away) {
  Guarded<double> guarded(0.5);
  test::flip_bit(guarded, 0);
  const Guarded<double> copy = guarded;
  assert_false(copy.intact());
  guarded = 0.5;
  assert_true(guarded.intact());
}
