// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The collecting half of stored faults, on the control thread: sees every cycle, and hands over
/// what came. Plain structs of fixed size; no allocation, no lock, no clock; a cycle copies at most
/// one freeze frame (3 KiB).

#include <array>
#include <cstddef>

#include "app/ecu/store/freeze_frame.hpp"
#include "app/ecu/store/spsc_ring.hpp"
#include "firmware/core/fault_set.hpp"

namespace graben::ecu {

/// One for the storing half.
struct FaultEvent {
  Fault fault = Fault::kNone;  ///< It came.
  TimeUs now_us = 0;
};

/// From the control thread to the store's.
struct FaultRings {
  SpscRing<FaultEvent, 128> events;
  SpscRing<FreezeFrame, 8> frames;
};

class FaultRecorder {
 public:
  /// `rings` outlives it.
  explicit FaultRecorder(FaultRings& rings) : rings_(rings) {}

  /// Once a cycle, with the faults that are there. One that is there while the controller has not
  /// been ready yet counts after 10 s: at power-on every node is missing for a while. None counts
  /// once the process was told to end.
  void look(const CycleSample& sample, const FaultSet& faults);

 private:
  void keep(const CycleSample& sample);
  void note(const FaultSet& faults, TimeUs now_us);
  void hand_over_due(TimeUs now_us);

  FaultRings& rings_;
  std::array<CycleSample, kFrameSamples> kept_{};  ///< A ring.
  std::size_t next_ = 0;                           ///< Place of the next one.
  std::size_t count_ = 0;
  int until_sample_ = 0;  ///< Cycles.
  FaultSet there_;        ///< In the last cycle.
  FaultSet waiting_;      ///< Whose frame is not whole yet.
  std::array<TimeUs, kFaultCount> came_us_{};
  TimeUs start_us_ = 0;
  bool has_started_ = false;
  bool counts_ = false;
};

}  // namespace graben::ecu
