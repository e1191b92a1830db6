// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames of a bus that a table describes, to signals.
///
/// Of what admission has let through (hal/link/message_links.hpp), a frame is refused as a whole
///
///   whose counter stands still, or went on by more than the table allows
///   that comes sooner than 0.8 of its period after the one before: two senders; its signals are
///     then 'error'
///   of which a value is out of its range, or changed faster than it can
///
/// What a sender says of its own values, the figure of merit of a sensor, makes all values of its
/// message 'error' where it is out of its range.
///
/// A message of a node of CANopen counts while that node is operational, no longer; while it has an
/// emergency, its signals are 'error'.
///
/// A message that is silent for longer than its own time-out is 'not available'. What comes slower
/// than the core asks of a signal counts as fresh up to there: the table's time-out is then the one
/// that holds.
///
/// A limit from outside takes the place of our own ExternalLimit: a machine has one of the two.

#include <array>
#include <cstdint>

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/buses/bus_table.hpp"
#include "hal/buses/canopen_nodes.hpp"
#include "hal/buses/link_slopes.hpp"
#include "hal/link/message_links.hpp"
#include "hal/link/pace.hpp"

namespace graben {

class TableReceiver {
 public:
  /// Null: there is none. The table outlives it.
  explicit TableReceiver(const BusTable* table);

  [[nodiscard]] bool active() const { return table_ != nullptr; }

  /// True if the frame has an id of the table's, received or sent: then it is nobody else's. Its
  /// values go to their places unless it is refused. A frame that only we send is another
  /// controller's.
  [[nodiscard]] bool take(const CanFrame& frame, TimeUs now, ExcavatorInputs& to) {
    return active() && !frame.error && take_known(frame, now, to);
  }
  /// After the last frame of a cycle.
  void finish(TimeUs now, ExcavatorInputs& to) {
    if (active()) {
      finish_known(now, to);
    }
  }

  /// The node of CANopen that is to be told to start in this cycle.
  [[nodiscard]] NodeStart take_start(TimeUs now) {
    return active() ? nodes_.take_start(now) : NodeStart{};
  }

  [[nodiscard]] NodeEmergency emergency() const {
    return active() ? nodes_.emergency() : NodeEmergency{};
  }

  [[nodiscard]] FaultSet faults(TimeUs now) const;
  [[nodiscard]] bool take_out_of_range() { return links_.take_out_of_range(); }
  [[nodiscard]] LinkCounters counters() const;

 private:
  /// Of a message.
  struct Heard {
    bool any = false;  ///< Since it was silent for too long.
    TimeUs last_us = 0;
    Pace pace;
    bool counts = false;  ///< Its counter is known.
    std::int64_t counter = 0;
  };
  /// Of a source.
  struct Shown {
    double value = 0.0;
    bool valid = false;  ///< It was, in its message's last frame.
  };

  [[nodiscard]] bool take_known(const CanFrame& frame, TimeUs now, ExcavatorInputs& to);
  void finish_known(TimeUs now, ExcavatorInputs& to);
  [[nodiscard]] int received(const CanFrame& frame) const;
  [[nodiscard]] bool is_sent(const CanFrame& frame) const;
  [[nodiscard]] bool goes_on(std::size_t message, const CanFrame& frame);
  void decode(std::size_t message, const dbc::Payload& data, TimeUs now, ExcavatorInputs& to);
  [[nodiscard]] bool is_possible(const TableSource& source, const Signal<double>& shown,
                                 const Shown& before, double passed_s) const;
  [[nodiscard]] bool is_trusted(const TableMessage& message, const dbc::Payload& data) const;
  /// Where a source's value is kept; null: nowhere, it is judged at once.
  [[nodiscard]] Signal<double>* kept(const TableSource& source, ExcavatorInputs& to);
  void mark(std::size_t message, Validity validity, ExcavatorInputs& to);
  void keep_fresh(std::size_t message, TimeUs now, ExcavatorInputs& to);
  void judge_conditions(ExcavatorInputs& to) const;
  void tell_limit(ExcavatorInputs& to) const;

  const BusTable* table_;
  MessageLinks links_;
  std::array<Heard, kMostTableReceived> heard_{};
  std::array<Shown, kMostTableSources> shown_{};
  LinkSlopes slopes_;
  Signal<double> limit_ratio_;  ///< As of kSpeedLimit.
  CanopenNodes nodes_;
  std::uint32_t wrong_counter_ = 0;
  std::uint32_t early_ = 0;
  bool own_heard_ = false;
  TimeUs own_us_ = 0;
};

}  // namespace graben
