// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/address_note.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>

#include "hal/link/message_rules.hpp"

namespace graben::ecu {

void AddressNote::look() {
  if (has_said_ || !claim_.is_lost()) {
    return;
  }
  has_said_ = true;
  const std::uint64_t theirs = claim_.rival().name;
  const std::uint64_t ours = claim_.name();
  std::array<char, 192> line{};
  static_cast<void>(
      std::snprintf(line.data(), line.size(),
                    "SILENT: address %u is claimed by another station, NAME %016" PRIx64
                    ", %s ours, %016" PRIx64 "; take it off the bus, then start again",
                    static_cast<unsigned>(kOwnAddress), theirs,
                    theirs == ours ? "the same as" : "lower than", ours));
  static_cast<void>(manager_.status(line.data()));
  std::fprintf(stderr, "graben-ecu: %s\n", line.data());
}

}  // namespace graben::ecu
