#pragma once
/// What the bus lets a controller do, and when its port is opened again.

#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/can_port.hpp"

namespace graben::ecu {

/// Watches a port through a cycle of 10 ms: begin, the port is read, judge, frames are sent, end.
/// A port that is off the bus or down is opened again at most every 200 ms, and that discards what
/// is queued; every such state is seen for one cycle at least. The caller owns the port.
class BusWatch {
 public:
  explicit BusWatch(CanPort& port) : port_(port) {}

  /// True if what is queued is not fresh: it waited through a stall or a lost bus.
  [[nodiscard]] bool begin(TimeUs now_us);
  [[nodiscard]] BusState judge(TimeUs now_us);
  /// May wait for the kernel: what has to be sent must not wait for it.
  void end(TimeUs now_us);

 private:
  CanPort& port_;
  BusState before_ = BusState::kDown;  ///< Before the port was read.
  BusState bus_ = BusState::kDown;
  bool needs_open_ = false;  ///< It was off the bus and has not been opened since.
  TimeUs open_from_us_ = 0;  ///< Not to be opened again before.
  bool stalled_ = false;
  TimeUs last_us_ = 0;
  bool has_begun_ = false;
};

}  // namespace graben::ecu
