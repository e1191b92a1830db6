// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Freeze frames that are not written yet, on the store's thread: of each fault at most one, its
/// first, and none of a fault whose last one was written less than 10 minutes ago or that has been
/// cleared since it came.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ecu/store/freeze_frame.hpp"

namespace graben::ecu {

class WaitingFrames {
 public:
  /// Keeps what is wanted of `frame`. False if there is no room for that: it is lost.
  [[nodiscard]] bool take(const FreezeFrame& frame, TimeUs now_us);
  /// Faults cleared at that time: frames of what came before it are forgotten, those too that are
  /// taken later.
  void forget(const FaultSet& cleared, TimeUs at_us);

  /// Faults whose frame waits.
  [[nodiscard]] int count() const { return waiting_.count(); }
  /// Which is to be written next, of which fault. There is one.
  struct Next {
    const FreezeFrame* frame = nullptr;
    Fault fault = Fault::kNone;
  };
  [[nodiscard]] Next next();
  /// next() is written,
  void written(Fault fault, TimeUs now_us);
  /// or could not be: it waits on, behind the others.
  void put_off(Fault fault) { put_off_.add(fault); }

 private:
  /// As many as come at once before the first can be written, on a machine that falls apart. [-]
  static constexpr std::size_t kMostFrames = 4;

  void remove(Fault fault);

  std::array<FreezeFrame, kMostFrames> frame_{};  ///< The oldest first.
  std::size_t count_ = 0;
  FaultSet waiting_;  ///< All their faults.
  FaultSet put_off_;
  FaultSet written_;
  FaultSet cleared_;
  std::array<TimeUs, kFaultCount> written_us_{};
  std::array<TimeUs, kFaultCount> cleared_us_{};
};

}  // namespace graben::ecu
