// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/sealed.hpp"

#include <cstdint>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/flip_bit.hpp"

/// With padding, as state has it.
struct State {
  double first = 0.5;
  bool second = true;
  std::uint16_t third = 0xFFFF;
  std::array<double, 3> rest = {-0.0, 1e300, -3.0};
};

struct Begins {
  explicit Begins(double at) : value(at) {}
  double value;
};

template <class T>
std::size_t bits_of(const Sealed<T>&) {
  return 8 * sizeof(T);
}

TEST(every_bit_of_the_state_counts, Sealed<State> sealed) {
  for (std::size_t bit = 0; bit < bits_of(sealed); ++bit) {
    assert_true(sealed.intact());
    test::flip_bit(*sealed, bit);
    assert_false(sealed.intact());
    test::flip_bit(*sealed, bit);
  }
  assert_true(sealed.intact());
}

/// The seal lies behind the state.
TEST(every_bit_of_the_seal_counts, Sealed<State> sealed) {
  for (std::size_t bit = bits_of(sealed); bit < bits_of(sealed) + 8 * sizeof(std::size_t); ++bit) {
    test::flip_bit_at(&sealed, bit);
    assert_false(sealed.intact());
    test::flip_bit_at(&sealed, bit);
  }
}

TEST(what_was_written_counts_once_it_is_sealed, Sealed<State> sealed) {
  sealed->first = 0.25;
  assert_false(sealed.intact());
  sealed.seal();
  assert_true(sealed.intact());
  assert_near((*sealed).first, 0.25, 0.0);
}

/// Memory that was wiped, with zeros or with ones, is no state.
TEST(wiped_memory_is_found) {
  for (const int wipe : {0x00, 0xFF}) {
    Sealed<State> sealed;
    std::memset(static_cast<void*>(&sealed), wipe, sizeof sealed);
    assert_false(sealed.intact());
  }
}

TEST(a_copy_is_as_intact_as_what_it_is_of, Sealed<State> sealed) {
  sealed->first = 2.0;
  const Sealed<State> broken = sealed;
  assert_false(broken.intact());
  sealed.seal();
  const Sealed<State> sound = sealed;
  assert_true(sound.intact());
  assert_near(sound->first, 2.0, 0.0);
  Sealed<State> assigned;
  assigned = broken;
  assert_false(assigned.intact());
  assigned = sound;
  assert_true(assigned.intact());
  assert_near(assigned->first, 2.0, 0.0);
}

TEST(what_is_not_intact_is_made_anew) {
  Sealed<State> sealed;
  sealed->rest = {};
  sealed.seal();
  assert_true(sealed.unseal());
  assert_near(sealed->rest[1], 0.0, 0.0);
  test::flip_bit(sealed->first, 3);
  assert_false(sealed.unseal());
  sealed.seal();
  assert_true(sealed.intact());
  assert_near(sealed->rest[1], 1e300, 0.0);
  Sealed<Begins> begins(4.0);
  begins->value = 4.5;
  assert_false(begins.unseal(5.0));
  begins.seal();
  assert_near(begins->value, 5.0, 0.0);
}
