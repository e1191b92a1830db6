#pragma once
/// Outputs to frames: what is due in this cycle, protected and saturated.

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"
#include "hal/can_frame.hpp"
#include "hal/dm1.hpp"

namespace graben {

/// How the process fares that the controller runs in. Counts saturate at 250 on the bus.
struct ProcessHealth {
  std::uint32_t allocations = 0;  ///< Of the process since its first cycle.
  std::uint32_t page_faults = 0;  ///< Of the control thread since its first cycle.
  std::uint32_t overruns = 0;     ///< Late cycles since the start.
  bool real_time = false;         ///< With real-time priority and locked memory.
};

/// What goes on the bus beside the controller's outputs.
struct EcuDiagnosis {
  TimeUs cycle_time_us = 0;           ///< Of the last cycle; saturates at 64255.
  std::uint32_t rejected_frames = 0;  ///< Since the start; saturates at 250.
  std::uint32_t profile_hash = 0;
  std::uint32_t dropped_frames = 0;  ///< That the bus did not take, since the start.
  ProcessHealth process;
};

/// Sends SpoolCommand every 10 ms, PumpCommand, EcuStatus, EcuMotion and EcuHydraulics every 20 ms,
/// EcuHealth every 100 ms, EcuIdentity every second, counted from the first call and spread so that
/// no call sends all; DM1 as hal/dm1.hpp has it. A call that comes up to half a control cycle early
/// or late keeps the schedule; one that comes later starts it afresh from there: nothing is sent
/// twice to catch up.
///
/// Without enable, and if any duty is not finite, SpoolCommand says Off and neutral for every
/// spool, and PumpCommand 'not available' for every pump; also for one whose swash is not finite or
/// not above 0. PilotCut is sent whatever else is. Values beyond a signal's range are saturated;
/// one that is not finite is sent as 'error'.
class ExcavatorTransmitter {
 public:
  static constexpr int kPeriodicCount = 7;
  static constexpr int kMessageCount = kPeriodicCount + 1;  ///< DM1 has its own times.
  using Frames = std::array<CanFrame, kMessageCount>;

  /// Writes the frames due at `now` into `out`, most urgent first; returns how many. To be called
  /// every 10 ms.
  [[nodiscard]] int frames(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis,
                           TimeUs now, Frames& out);

 private:
  bool started_ = false;
  std::array<TimeUs, kPeriodicCount> due_us_{};
  std::array<std::uint8_t, kPeriodicCount> counter_{};  ///< Of the next frame.
  Dm1 dm1_;
};

}  // namespace graben
