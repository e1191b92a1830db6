// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's bus (excavator.dbc): which signal is in which frame.

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/buses/link_imus.hpp"
#include "hal/buses/table_receiver.hpp"
#include "hal/buses/table_transmitter.hpp"
#include "hal/link/message_receiver.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

/// What the controller receives. The swing's messages are those of a machine with a swing drive,
/// second sensors' of one whose profile has them. An operator's frame whose task is a dozer's is
/// refused like one whose value is out of range.
struct ExcavatorReception {
  using Inputs = ExcavatorInputs;
  static constexpr int kMessageCount = 20;
  [[nodiscard]] static const ReceiveTable<Inputs, kMessageCount>& table();
};

/// With the IMUs of a machine that has them, whose frames are those of a standard, and with the bus
/// of a machine that does not speak ours, which a table describes.
class ExcavatorReceiver : public MessageReceiver<ExcavatorReception> {
 public:
  explicit ExcavatorReceiver(const BusParts& parts = {})
      : MessageReceiver(parts), imus_(parts.imu), table_(parts.table) {}

  void accept(const CanFrame& frame, TimeUs now) {
    if (!table_.take(frame, now, writable()) && !imus_.take(frame, now, writable().imu)) {
      MessageReceiver::accept(frame, now);
    }
  }
  void finish(TimeUs now) {
    MessageReceiver::finish(now);
    table_.finish(now, writable());
  }

  [[nodiscard]] FaultSet message_faults(TimeUs now) const {
    FaultSet faults = MessageReceiver::message_faults(now);
    if (table_.active()) {
      faults.add(table_.faults(now));
    }
    return faults;
  }
  [[nodiscard]] bool take_out_of_range() {
    const bool of_table = table_.active() && table_.take_out_of_range();
    return MessageReceiver::take_out_of_range() || of_table;
  }

  [[nodiscard]] NodeStart take_start(TimeUs now) { return table_.take_start(now); }
  [[nodiscard]] NodeEmergency emergency() const { return table_.emergency(); }

  [[nodiscard]] const LinkCounters& imus() const { return imus_.counters(); }
  [[nodiscard]] LinkCounters table() const { return table_.counters(); }

 private:
  LinkImus imus_;
  TableReceiver table_;
};

/// What the controller sends.
///
///   SpoolCommand                                        10 ms
///   SwingCommand, with a swing drive                    10 ms
///   PumpCommand, EcuStatus, EcuMotion, EcuHydraulics    20 ms
///   TaskStatus                                          20 ms
///   EcuHealth, EcuLearntValves, EcuTipLoad             100 ms
///   EcuIdentity, EcuChecks                               1 s
///   DM1                                                as hal/link/dm1.hpp says
///
/// Without enable, and if any duty is not finite, SpoolCommand and SwingCommand say Off and neutral
/// for every spool, and PumpCommand 'not available' for every pump; also for one whose swash is not
/// finite or not above 0. PilotCut is sent whatever else is.
struct ExcavatorTransmission {
  using Outputs = ExcavatorOutputs;
  static constexpr int kPeriodicCount = 12;
  [[nodiscard]] static const SendTable<Outputs, kPeriodicCount>& table();
};

/// With what a table says beside it. What is ours is sent on every bus: stations and logs go by it.
class ExcavatorTransmitter : public MessageTransmitter<ExcavatorTransmission> {
 public:
  static constexpr int kMessageCount =
      MessageTransmitter::kMessageCount + TableTransmitter::kMostFrames;
  using Frames = std::array<CanFrame, kMessageCount>;

  explicit ExcavatorTransmitter(const BusParts& parts = {})
      : MessageTransmitter(parts), table_(parts.table) {}

  /// Whether a table sends commands in messages of this id.
  [[nodiscard]] bool is_table_command(std::uint32_t id) const { return table_.is_command(id); }

  void start_node(const NodeStart& start) { table_.start_node(start); }

  [[nodiscard]] int frames(const Outputs& outputs, const EcuDiagnosis& diagnosis, TimeUs now,
                           Frames& out) {
    const int count = MessageTransmitter::frames(outputs, diagnosis, now, out);
    return table_.active() ? with_table(outputs, now, count, out) : count;
  }
  template <class Wanted>
  [[nodiscard]] int next_frames(const Outputs& outputs, const Wanted& wanted, TimeUs now,
                                Frames& out) const {
    const int count = MessageTransmitter::next_frames(outputs, wanted, now, out);
    return table_.active() ? with_commands(outputs, now, count, out) : count;
  }

 private:
  [[nodiscard]] int with_table(const Outputs& outputs, TimeUs now, int count, Frames& out);
  /// The table's first: they are what moves the machine.
  [[nodiscard]] int with_commands(const Outputs& outputs, TimeUs now, int count, Frames& out) const;

  TableTransmitter table_;
};

}  // namespace graben
