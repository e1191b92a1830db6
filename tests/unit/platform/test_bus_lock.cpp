// SPDX-License-Identifier: Apache-2.0
/// Who comes second to a bus.

#include "platform/linux/bus_lock.hpp"

#include <unistd.h>

#include <cstring>
#include <optional>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

/// Tests run beside each other, in one network namespace.
std::string own_name(const char* name) { return name + std::to_string(getpid()); }

TEST(the_second_is_refused_in_words) {
  std::optional<BusLock> first(own_name("a"));
  assert_true(first->error().empty());
  const BusLock second(own_name("a"));
  assert_non_null(std::strstr(second.error().c_str(), "another graben-ecu controls this bus"));
  const BusLock elsewhere(own_name("b"));
  assert_true(elsewhere.error().empty());
  first.reset();
  const BusLock after(own_name("a"));
  assert_true(after.error().empty());
}

TEST(a_name_that_is_too_long_is_told) {
  const BusLock lock(std::string(200, 'x'));
  assert_non_null(std::strstr(lock.error().c_str(), "too long"));
}
