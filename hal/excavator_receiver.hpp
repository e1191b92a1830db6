#pragma once
/// The excavator's bus, as its controller hears it: excavator.dbc.

#include "firmware/signals/excavator_signals.hpp"
#include "hal/message_receiver.hpp"

namespace graben {

struct ExcavatorReception {
  using Inputs = ExcavatorInputs;
  static constexpr int kMessageCount = 11;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

using ExcavatorReceiver = MessageReceiver<ExcavatorReception>;

}  // namespace graben
