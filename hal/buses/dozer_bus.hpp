// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's bus (dozer.dbc): which signal is in which frame.

#include "firmware/dozer/dozer_signals.hpp"
#include "hal/link/message_receiver.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

/// What the controller receives. An operator's frame whose task is none of a dozer's is refused
/// like one whose value is out of range.
struct DozerReception {
  using Inputs = DozerInputs;
  static constexpr int kMessageCount = 17;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

using DozerReceiver = MessageReceiver<DozerReception>;

/// What the controller sends.
///
///   SpoolCommand                                        10 ms
///   PumpDisplacementCommand, MotorDisplacementCommand   10 ms
///   EcuStatus, EcuMotion, EcuGrade                      20 ms
///   EcuHealth                                          100 ms
///   EcuIdentity, EcuChecks                               1 s
///   DM1                                                as hal/link/dm1.hpp says
///
/// What they say of the tilt is not available where the machine has none.
///
/// Without enable, and if any number that is commanded is not finite, SpoolCommand says Off and
/// neutral, every pump is sent to 0 and every motor to full displacement. Brake and PilotCut are
/// sent whatever else is.
struct DozerTransmission {
  using Outputs = DozerOutputs;
  static constexpr int kPeriodicCount = 9;
  [[nodiscard]] static const SendTable<Outputs, kPeriodicCount>& table();
};

using DozerTransmitter = MessageTransmitter<DozerTransmission>;

}  // namespace graben
