#pragma once
/// The dozer's bus, as its controller speaks on it: dozer.dbc.

#include "firmware/dozer/dozer_signals.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

/// SpoolCommand, PumpDisplacementCommand and MotorDisplacementCommand every 10 ms, EcuStatus,
/// EcuMotion and EcuGrade every 20 ms, EcuHealth every 100 ms, EcuIdentity every second.
///
/// Without enable, and if any number that is commanded is not finite, SpoolCommand says Off and
/// neutral, every pump is sent to 0 and every motor to full displacement. Brake and PilotCut are
/// sent whatever else is.
struct DozerTransmission {
  using Outputs = DozerOutputs;
  static constexpr int kPeriodicCount = 8;
  [[nodiscard]] static const SendTable<Outputs, kPeriodicCount>& table();
};

using DozerTransmitter = MessageTransmitter<DozerTransmission>;

}  // namespace graben
