// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bus profile in pieces, and what reading one says.

#include <initializer_list>
#include <string>

#include "app/machines/bus_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

namespace graben::test {

/// A profile beside ours, which says the rest.
inline const std::string kHead = "bus = \"test\"\nown_frames = true\n";
inline const std::string kMessage =
    "[[receive]]\nmessage = \"Engine\"\nid = 0x123\nextended = false\nperiod = 0.02\n"
    "timeout = 0.06\nprotection = \"none\"\n";
inline const std::string kSignal =
    "[[receive.signal]]\nsignal = \"Speed\"\nstart = 8\nwidth = 16\nto = \"engine_speed\"\n"
    "scale = 0.1\nrange = [0, 250]\n";

/// Why the profile is refused; empty where it is not.
inline std::string refusal(const std::string& text) {
  const WrittenFile file("bus.toml", text);
  return refusal_of([&] { static_cast<void>(machines::load_bus(file.path())); });
}

inline void assert_says(const std::string& text, std::initializer_list<const char*> parts) {
  const std::string error = refusal(text);
  for (const char* part : parts) {
    if (!has(error, part)) {
      fail_msg("no \"%s\" in: %s", part, error.c_str());
    }
  }
}

inline std::string with(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  assert_true(at != std::string::npos);
  return text.replace(at, old.size(), now);
}

}  // namespace graben::test
