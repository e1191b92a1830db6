// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A workshop's tool on an interface.

#include <cstdint>
#include <string>

#include "app/workshop/enquiry.hpp"

namespace graben::workshop {

struct Answered {
  Answer answer = Answer::kNone;
  j1939::LongMessage message;
};

/// Asks and waits, 6 s at most; kNone if told to stop (stop_requested) before. Sends nothing but
/// the request and what a connection takes. Throws std::runtime_error, with the reason, if there is
/// no bus.
[[nodiscard]] Answered ask(const std::string& interface, std::uint32_t pgn, std::uint8_t ecu);

}  // namespace graben::workshop
