// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The collecting half of stored faults, on the control thread: sees every cycle, and hands over
/// what came. Plain structs of fixed size; no allocation, no lock, no clock; a cycle copies at most
/// one freeze frame (3 KiB).

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ecu/store/fault_history.hpp"
#include "app/ecu/store/freeze_frame.hpp"
#include "app/ecu/store/spsc_ring.hpp"
#include "firmware/core/fault_set.hpp"

namespace graben::ecu {

/// One for the storing half.
struct FaultEvent {
  Fault fault = Fault::kNone;  ///< It came; none: `cleared` are to be forgotten.
  TimeUs now_us = 0;
  FaultSet cleared;
};

/// How often each fault is stored as, up to 126 as J1939 has it.
using Occurrences = std::array<std::uint8_t, kFaultCount>;
[[nodiscard]] Occurrences occurrences_of(const FaultHistory& history);

/// From the control thread to the store's,
struct FaultRings {
  SpscRing<FaultEvent, 128> events;
  SpscRing<FreezeFrame, 2> frames;
  /// and back: what was on a disk that came later, in the place of what begin() was given.
  SpscRing<Occurrences, 4> found;
  /// To the store's thread, what has been learnt so far.
  SpscRing<LearntRecord, 2> learnt;
  /// To it, site_mark() of the place that the machine has left.
  SpscRing<std::uint32_t, 2> left_site;
};

/// The cycle in which a fault came.
struct FaultSample {
  Fault fault = Fault::kNone;
  CycleSample sample;
};

class FaultRecorder {
 public:
  /// `rings` outlives it; null: there is no store, and what is counted ends with the process.
  explicit FaultRecorder(FaultRings* rings) : rings_(rings) {}

  /// With what is stored, before the first cycle.
  void begin(const FaultHistory& history);

  /// Once a cycle, with the faults that are there. One that is there while the controller has not
  /// been ready yet counts after 10 s: at power-on every node is missing for a while. None counts
  /// once the process was told to end.
  void look(const CycleSample& sample, const FaultSet& faults);

  [[nodiscard]] const Occurrences& stored() const { return stored_; }
  /// Whether what is forgotten now will be so on the disk too.
  [[nodiscard]] bool can_forget() { return rings_ == nullptr || rings_->events.has_room(); }
  /// As the last fault came that is stored; with no fault, there was none since the start.
  [[nodiscard]] const FaultSample& last() const { return last_; }
  void forget(const FaultSet& cleared, TimeUs now_us);

 private:
  void go_on_from(const Occurrences& found);
  void keep(const CycleSample& sample);
  void note(const FaultSet& faults, const CycleSample& sample);
  void hand_over_due(TimeUs now_us);

  FaultRings* rings_;
  Occurrences stored_{};
  Occurrences own_{};  ///< Of them, those of this process.
  FaultSet cleared_;   ///< By this process: what is found of them does not count.
  std::array<CycleSample, kFrameSamples> kept_{};  ///< A ring.
  std::size_t next_ = 0;                           ///< Place of the next one.
  std::size_t count_ = 0;
  int until_sample_ = 0;  ///< Cycles.
  FaultSample last_;
  FaultSet there_;    ///< In the last cycle.
  FaultSet waiting_;  ///< Whose frame is not whole yet.
  std::array<TimeUs, kFaultCount> came_us_{};
  TimeUs start_us_ = 0;
  bool has_started_ = false;
  bool counts_ = false;
};

}  // namespace graben::ecu
