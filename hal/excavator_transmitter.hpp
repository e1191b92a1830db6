#pragma once
/// Outputs to frames: what is due in this cycle, protected and saturated.

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"
#include "hal/can_frame.hpp"

namespace graben {

/// What goes on the bus beside the controller's outputs.
struct EcuDiagnosis {
  TimeUs cycle_time_us = 0;           ///< Of the last cycle; saturates at 64255.
  std::uint32_t rejected_frames = 0;  ///< Since the start; saturates at 250.
  std::uint32_t profile_hash = 0;
};

/// Sends SpoolCommand every 10 ms, EcuStatus, EcuMotion and EcuHydraulics every 20 ms, EcuIdentity
/// every second, counted from the first call. A call that comes up to half a control cycle early or
/// late keeps the schedule; one that comes later starts it afresh from there: nothing is sent twice
/// to catch up.
///
/// Without enable, and if any duty is not finite, SpoolCommand says Off and neutral for every
/// spool. Values beyond a signal's range are saturated; one that is not finite is sent as 'error'.
class ExcavatorTransmitter {
 public:
  static constexpr int kMessageCount = 5;
  using Frames = std::array<CanFrame, kMessageCount>;

  /// Writes the frames due at `now` into `out`, most urgent first; returns how many. To be called
  /// every 10 ms.
  [[nodiscard]] int frames(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis,
                           TimeUs now, Frames& out);

 private:
  bool started_ = false;
  std::array<TimeUs, kMessageCount> due_us_{};
  std::array<std::uint8_t, kMessageCount> counter_{};  ///< Of the next frame.
};

}  // namespace graben
