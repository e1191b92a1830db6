#pragma once
/// How a simulated machine says what it is.

#include <cstdint>

#include "app/plant/node_faults.hpp"
#include "can_dbc/codec.hpp"

namespace graben::plant {

/// MachineIdentity as the machine kind's DBC has it.
template <class Message>
[[nodiscard]] Message identity_of(std::uint32_t profile_hash, std::uint32_t dbc_version,
                                  const NodeFaults& faults) {
  Message message;
  message.profile_hash = {faults.wrong_identity ? ~profile_hash : profile_hash,
                          dbc::RawState::kValid};
  message.dbc_version = {dbc_version, dbc::RawState::kValid};
  return message;
}

}  // namespace graben::plant
