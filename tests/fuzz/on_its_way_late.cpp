// SPDX-License-Identifier: Apache-2.0
/// A canary's way to the bus: enable stays On for a cycle longer than it should. Both machine kinds
/// have the same identifier, protection and place of it.

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/link/e2e.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

CanFrame on_its_way(const CanFrame& frame, const CanFrame& last) {
  using Command = dbc::excavator::SpoolCommand;
  if (frame.id != Command::kId ||
      Command::decode(last.data).enable.value == Command::Enable::kOff) {
    return frame;
  }
  CanFrame late = last;
  e2e_protect(late.data, Command::kDataId, frame.data[1] & 0x0F);
  return late;
}

}  // namespace graben::test
