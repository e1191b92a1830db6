#pragma once
/// The excavator's bus, as its controller speaks on it: excavator.dbc.

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

/// SpoolCommand every 10 ms, PumpCommand, EcuStatus, EcuMotion and EcuHydraulics every 20 ms,
/// EcuHealth every 100 ms, EcuIdentity every second. A machine with a swing drive also sends
/// SwingCommand every 10 ms and TaskStatus every 20 ms.
///
/// Without enable, and if any duty is not finite, SpoolCommand and SwingCommand say Off and neutral
/// for every spool, and PumpCommand 'not available' for every pump; also for one whose swash is not
/// finite or not above 0. PilotCut is sent whatever else is.
struct ExcavatorTransmission {
  using Outputs = ExcavatorOutputs;
  static constexpr int kPeriodicCount = 9;
  [[nodiscard]] static const SendTable<Outputs, kPeriodicCount>& table();
};

using ExcavatorTransmitter = MessageTransmitter<ExcavatorTransmission>;

}  // namespace graben
