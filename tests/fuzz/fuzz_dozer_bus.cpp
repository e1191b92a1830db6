// SPDX-License-Identifier: Apache-2.0
/// The dozer's whole cycle on a bus that a script spoils: bus_script.hpp.

#include "tests/fuzz/bus_script.hpp"
#include "tests/fuzz/dozer_bus.hpp"

namespace graben::test {

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  return play<DozerBus>(data, size);
}

bool inputs_are_numbers() { return false; }

std::vector<Bytes> seed_inputs() { return script_seeds(); }

}  // namespace graben::test
