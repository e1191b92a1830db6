// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's bus (excavator.dbc): which signal is in which frame.

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/link/message_receiver.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

/// What the controller receives. The swing's messages are those of a machine with a swing drive. An
/// operator's frame whose task is a dozer's is refused like one whose value is out of range.
struct ExcavatorReception {
  using Inputs = ExcavatorInputs;
  static constexpr int kMessageCount = 16;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

using ExcavatorReceiver = MessageReceiver<ExcavatorReception>;

/// What the controller sends.
///
///   SpoolCommand                                        10 ms
///   SwingCommand, with a swing drive                    10 ms
///   PumpCommand, EcuStatus, EcuMotion, EcuHydraulics    20 ms
///   TaskStatus, with a swing drive                      20 ms
///   EcuHealth, EcuLearntValves, EcuTipLoad             100 ms
///   EcuIdentity                                          1 s
///   DM1                                                as hal/link/dm1.hpp says
///
/// Without enable, and if any duty is not finite, SpoolCommand and SwingCommand say Off and neutral
/// for every spool, and PumpCommand 'not available' for every pump; also for one whose swash is not
/// finite or not above 0. PilotCut is sent whatever else is.
struct ExcavatorTransmission {
  using Outputs = ExcavatorOutputs;
  static constexpr int kPeriodicCount = 11;
  [[nodiscard]] static const SendTable<Outputs, kPeriodicCount>& table();
};

using ExcavatorTransmitter = MessageTransmitter<ExcavatorTransmission>;

}  // namespace graben
