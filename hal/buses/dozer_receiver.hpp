#pragma once
/// The dozer's bus, as its controller hears it: dozer.dbc. An operator's frame whose task is none
/// of a dozer's is refused like one whose value is out of range.

#include "firmware/dozer/dozer_signals.hpp"
#include "hal/link/message_receiver.hpp"

namespace graben {

struct DozerReception {
  using Inputs = DozerInputs;
  static constexpr int kMessageCount = 11;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

using DozerReceiver = MessageReceiver<DozerReception>;

}  // namespace graben
