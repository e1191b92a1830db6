// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The storing half of stored faults, on the store's thread: counts what came and writes it within
/// the wear budget.
///
/// A history is written 1 s after something has changed, at most every 5 s, and every 10 minutes
/// for the hours of operation; of a fault at most one freeze frame in 10 minutes. Each is one write
/// of the budget (wear_budget.hpp), which keeps the last 8 for histories. What a history writes as
/// left is without the frames that follow it, so that no end at any time brings a write back.
///
/// Where the disk comes later, or another one in its place, the history on it goes on: what has
/// been counted since the process began is added to it.

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

#include "app/ecu/store/fault_history.hpp"
#include "app/ecu/store/fault_recorder.hpp"
#include "app/ecu/store/found_faults.hpp"
#include "app/ecu/store/store.hpp"
#include "app/ecu/store/store_thread.hpp"
#include "app/ecu/store/waiting_frames.hpp"
#include "app/ecu/store/wear_budget.hpp"

namespace graben::ecu {

class FaultKeeper : public StoreWork {
 public:
  /// Says a line to whoever runs the process; must not allocate.
  using Say = void (*)(const char* line);

  /// All three outlive it.
  FaultKeeper(Store& store, FaultRings& rings, SampleKind kind, Say say)
      : store_(store), rings_(rings), kind_(kind), say_(say) {}

  /// Reads what there is, before the thread begins; what was read, what is new and what is damaged,
  /// in words. `boot` is boot_mark(): another one, or 0, is another power cycle.
  [[nodiscard]] std::string begin(TimeUs now_us, std::uint32_t boot);

  void work(TimeUs now_us, std::uint32_t unix_s) override;
  void finish(TimeUs now_us, std::uint32_t unix_s) override;

  /// As they are read at the start; afterwards the thread's.
  [[nodiscard]] const FaultHistory& history() const { return history_; }

  // For the statistics, from any thread.
  [[nodiscard]] std::uint32_t writes() const { return writes_; }
  [[nodiscard]] std::uint32_t failures() const { return failures_; }
  [[nodiscard]] bool is_failing() const { return is_failing_; }
  /// Events and frames that came while the queue was full.
  [[nodiscard]] std::uint32_t dropped() const {
    return rings_.events.dropped() + rings_.frames.dropped() + frames_lost_;
  }

 private:
  /// Of a place that histories were written to.
  struct Known {
    FaultHistory base;                        ///< What was there before this process.
    std::array<std::uint32_t, 2> checksum{};  ///< Of the last two that it has tried to write.
  };

  void go_on_from(FaultHistory base);
  void adopt(TimeUs now_us);
  /// Null if this process did not write that.
  [[nodiscard]] const Known* written_here(std::uint32_t checksum) const;
  [[nodiscard]] Place reach(TimeUs now_us);
  void forget(const FaultEvent& event);
  void drain(TimeUs now_us, std::uint32_t unix_s);
  [[nodiscard]] std::uint32_t operation_s(TimeUs now_us) const;
  void write_next_frame(TimeUs now_us, std::uint32_t unix_s);
  void write_history_now(TimeUs now_us, bool is_last);
  [[nodiscard]] bool put(RecordKey key, std::size_t length);
  void say_failure(const char* what_follows) const;
  void history_failed(TimeUs now_us);
  void frame_failed(TimeUs now_us);
  void changed(TimeUs now_us);

  Store& store_;
  FaultRings& rings_;
  SampleKind kind_;
  Say say_;
  FaultHistory history_;
  FaultHistory own_;  ///< Of it, what this process has counted, in seconds since it began.
  FaultSet cleared_;  ///< By this process.
  std::uint32_t boot_ = 0;
  std::array<Known, 4> known_{};
  std::size_t place_ = 0;  ///< Of those, the present one.
  WearBudget budget_;
  StoredFrame frame_;
  std::array<std::uint8_t, kMostPayloadBytes> payload_{};

  TimeUs begin_us_ = 0;
  std::uint32_t begin_s_ = 0;  ///< Operation before.
  std::uint32_t lost_before_ = 0;
  bool has_changed_ = false;
  TimeUs changed_us_ = 0;
  TimeUs written_us_ = 0;  ///< When a history was written last, or tried.
  bool has_tried_ = false;
  int granted_ = 0;  ///< Frames that the last history has paid for.
  WaitingFrames waiting_;
  TimeUs retry_us_ = 0;
  TimeUs frame_retry_us_ = 0;
  bool history_fails_ = false;
  bool frame_fails_ = false;
  bool has_said_ = false;
  bool has_said_frame_ = false;
  std::atomic<std::uint32_t> frames_lost_{0};
  std::atomic<std::uint32_t> writes_{0};
  std::atomic<std::uint32_t> failures_{0};
  std::atomic<bool> is_failing_{false};
};

}  // namespace graben::ecu
