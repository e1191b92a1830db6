#pragma once
/// Random valves and inputs: 1 to 6 spools on 1 to 3 pumps, regeneration on either side or none.

#include <cstdint>

#include "firmware/mcv/mcv_machine.hpp"

namespace graben::test {

struct RandomCase {
  McvMachine machine;
  McvInput input;
};

/// The same seed gives the same case everywhere. Flows, loads and valves are drawn so wide and so
/// correlated that every limit, and gaps in the feasible set, occur often.
[[nodiscard]] RandomCase random_case(std::uint64_t seed);

}  // namespace graben::test
