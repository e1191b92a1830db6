#pragma once
/// The excavator's bus, as its controller hears it: excavator.dbc. The swing's messages are those
/// of a machine with a swing drive. An operator's frame whose task is a dozer's is refused like one
/// whose value is out of range.

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/link/message_receiver.hpp"

namespace graben {

struct ExcavatorReception {
  using Inputs = ExcavatorInputs;
  static constexpr int kMessageCount = 13;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

using ExcavatorReceiver = MessageReceiver<ExcavatorReception>;

}  // namespace graben
