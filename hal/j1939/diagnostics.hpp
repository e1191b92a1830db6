// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a workshop's tool asks an ECU on J1939, and what it is answered (J1939-21, -73):
///
/// - *DM1*, active codes: while there are several, all of them by BAM each second and as soon as
///   they change, in place of the single ones in turns (hal/link/dm1.hpp), which stay for one and
///   none. On request too.
/// - *DM2*, codes that are stored and not active: on request.
/// - *DM3, DM11*: clear the stored records of codes that are not active, or are. Nothing else: what
///   is active stays so, and no stop or latch ends. Not while the machine is armed or active.
/// - *DM24, DM25*: the parameters of a freeze frame, and that of the last fault
/// (frozen_sample.hpp).
/// - A request to us alone is answered, by a connection where it is long; for a group that we do
///   not have, or may not clear, with a negative acknowledgment. One to all is never acknowledged.
///
/// What that takes of a bus is planned (README.md of can_dbc): frames of the transport are 60 ms
/// apart, 5 requests a second are answered. Up to 8 wait for their turn, for 1.25 s, the same one
/// once; more are dropped. A cycle sends three frames at most.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/j1939/frozen_sample.hpp"
#include "hal/j1939/transport.hpp"
#include "hal/j1939/trouble_codes.hpp"

namespace graben::j1939 {

/// The controller's state in a cycle.
struct DiagnosticState {
  FaultSet active;
  EcuMode mode = EcuMode::kSilent;
  Occurrences stored{};  ///< 0: it is not stored.
  FrozenSample sample;
  bool can_clear = false;  ///< What is cleared now will be taken.
};

/// What a cycle is to do.
struct DiagnosticWork {
  static constexpr std::size_t kMostFrames = 3;
  std::array<CanFrame, kMostFrames> frame{};
  std::size_t count = 0;
  FaultSet cleared;  ///< Records that are to be forgotten.
};

class Diagnostics {
 public:
  /// `ids` are those of all that is sent by itself, which a request does not ask in vain; they
  /// outlive this.
  Diagnostics(std::uint8_t own_address, const std::uint32_t* ids, std::size_t count);

  /// Any frame; takes requests and connections that are for us.
  void hear(const CanFrame& frame, TimeUs now);
  /// True if `frame`, which is about to be sent, is a DM1: whether it goes is then for step().
  [[nodiscard]] bool holds(const CanFrame& frame);
  /// Once a cycle, after it.
  [[nodiscard]] DiagnosticWork step(const DiagnosticState& state, TimeUs now);

  /// Requests that found no room.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  struct Request {
    std::uint32_t pgn = 0;
    std::uint8_t sender = 0;
    bool to_all = false;
    TimeUs since_us = 0;
  };
  static constexpr std::size_t kMostRequests = 8;
  static constexpr std::size_t kAnswersASecond = 5;

  void count_active(const FaultSet& active);
  void send_active(const DiagnosticState& state, TimeUs now, DiagnosticWork& work);
  [[nodiscard]] bool may_answer(TimeUs now) const;
  void drop_request(std::size_t at);
  void answer(const DiagnosticState& state, TimeUs now, DiagnosticWork& work);
  /// True if the request is done; else it waits.
  bool answer_one(const Request& request, const DiagnosticState& state, TimeUs now,
                  DiagnosticWork& work);
  bool answer_codes(const Request& request, const DiagnosticState& state, TimeUs now,
                    DiagnosticWork& work);
  void clear(const Request& request, const DiagnosticState& state, TimeUs now,
             DiagnosticWork& work);
  void acknowledge(std::uint8_t control, const Request& request, TimeUs now, DiagnosticWork& work);
  [[nodiscard]] LongMessage codes(std::uint32_t pgn, const DiagnosticState& state) const;
  [[nodiscard]] bool is_sent_by_itself(std::uint32_t pgn) const;
  /// A code has come or gone that has not in the second before (J1939-73): one that comes and goes
  /// all the time must not fill the bus.
  [[nodiscard]] bool has_news(const FaultSet& active, TimeUs now) const;
  void begin_active(const DiagnosticState& state, TimeUs now);
  /// The frame of a transport that is due, if one is.
  [[nodiscard]] bool next_of_transport(TimeUs now, CanFrame& frame);

  std::uint8_t own_;
  const std::uint32_t* ids_;
  std::size_t id_count_;
  BamSender bam_;
  ConnectionSender connection_;
  std::array<Request, kMostRequests> request_{};
  std::size_t requests_ = 0;
  std::uint32_t dropped_ = 0;
  std::array<TimeUs, kAnswersASecond> answered_us_{};  ///< The last ones, in a ring.
  std::size_t answers_ = 0;
  TimeUs transport_us_ = 0;   ///< When its last frame was sent,
  TimeUs connection_us_ = 0;  ///< and the last one to a tool alone.

  FaultSet active_;            ///< In the last cycle.
  Occurrences since_start_{};  ///< Of active codes, as single ones have it.
  FaultSet said_;              ///< By the last BAM of DM1.
  TimeUs said_us_ = 0;
  bool has_said_ = false;
  /// When it was last said that a code has come or gone; 0: not yet.
  std::array<TimeUs, kFaultCount> news_us_{};
  TimeUs active_done_us_ = 0;  ///< When the last BAM of DM1 has ended.
  CanFrame held_;
  bool has_held_ = false;
  bool owes_single_ = false;  ///< After several, that there is one or none.
};

}  // namespace graben::j1939
