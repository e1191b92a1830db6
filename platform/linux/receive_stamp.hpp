#pragma once
/// The kernel stamps what it receives by the wall clock; here it becomes monotonic time.

#include "firmware/core/time.hpp"

namespace graben {

/// Takes from a stamp the frame's age only, and counts that back from the monotonic now. The
/// kernel offers CAN sockets no monotonic stamp. A wall clock that was stepped while a frame was
/// waiting would make its age wrong: a step is seen in the two clocks' difference, and until the
/// queue was empty once no stamp is believed. What is not believed, and an age below zero or above
/// 1 s, becomes `now`. Control uses the cycle's `now` alone; stamps are for logs and diagnosis.
class ReceiveStamp {
 public:
  /// Both clocks, read after the frames were taken from the socket.
  void set_now(TimeUs monotonic_us, TimeUs wall_us);

  /// Nothing waits that was stamped before the last set_now.
  void queue_is_empty() { believed_ = true; }

  [[nodiscard]] TimeUs now_us() const { return monotonic_us_; }

  /// Never after the now of set_now, and at most 1 s before it.
  [[nodiscard]] TimeUs monotonic_us(TimeUs wall_stamp_us) const;

 private:
  TimeUs monotonic_us_ = 0;
  TimeUs wall_us_ = 0;
  bool has_now_ = false;
  bool believed_ = true;
};

}  // namespace graben
