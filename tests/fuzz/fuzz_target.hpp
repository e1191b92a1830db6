// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a fuzz target is made of; one source file gives both functions. `drive_fuzz.cpp` runs it on
/// a fixed series of inputs, `libfuzzer_entry.cpp` puts it under libFuzzer.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace graben::test {

using Bytes = std::vector<std::uint8_t>;

/// Runs the code under test on any bytes; empty, or what was wrong with its result.
[[nodiscard]] std::string check_bytes(const std::uint8_t* data, std::size_t size);

/// Sound inputs to start from.
[[nodiscard]] std::vector<Bytes> seed_inputs();

/// Whether inputs are numbers side by side; else they are bytes, each with a meaning of its own.
[[nodiscard]] bool inputs_are_numbers();

/// What a run has been through, for its last line; a target may count what it likes.
inline std::map<std::string, std::uint64_t>& tallies() {
  static std::map<std::string, std::uint64_t> counts;
  return counts;
}
inline std::uint64_t& tally(const std::string& name) { return tallies()[name]; }

/// A struct of plain numbers from bytes; what is missing stays 0.
template <class Raw>
Raw raw_from_bytes(const std::uint8_t* data, std::size_t size) {
  static_assert(std::is_trivially_copyable_v<Raw>);
  Raw raw{};
  if (size > 0) {
    std::memcpy(static_cast<void*>(&raw), data, size < sizeof(Raw) ? size : sizeof(Raw));
  }
  return raw;
}

template <class Raw>
Bytes bytes_from_raw(const Raw& raw) {
  static_assert(std::is_trivially_copyable_v<Raw>);
  Bytes bytes(sizeof(Raw));
  std::memcpy(bytes.data(), &raw, sizeof(Raw));
  return bytes;
}

}  // namespace graben::test
