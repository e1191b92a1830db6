// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The neutral commands that would be next on the bus, for whoever has to send them in place of a
/// controller that is just ending.

#include <array>
#include <atomic>
#include <cstddef>

#include "hal/can_frame.hpp"

namespace graben::ecu {

/// Written once a cycle, before the cycle's own frames are sent: whenever the process ends, the
/// counters are ahead of what is on the bus by no more than a lost frame. A signal handler of the
/// thread that writes may read between any two instructions: it sees the last frames that are
/// whole.
class LastFrames {
 public:
  /// Of whoever puts frames here the compiler knows whether they fit.
  static constexpr std::size_t kMost = 32;
  struct Frames {
    std::array<CanFrame, kMost> frame{};
    std::size_t count = 0;
  };

  /// The first `count` of `frames`.
  template <std::size_t size>
  void put(const std::array<CanFrame, size>& frames, std::size_t count = size) {
    static_assert(size <= kMost, "none is left out");
    const unsigned other = 1U - current_.load(std::memory_order_relaxed);
    Frames& to = slot_[other];
    to.count = count;
    for (std::size_t i = 0; i < to.count; ++i) {
      to.frame[i] = frames[i];
    }
    current_.store(other, std::memory_order_release);
  }
  /// None from now on, whatever is put.
  void end() { has_ended_.store(true, std::memory_order_release); }
  [[nodiscard]] const Frames& get() const {
    return has_ended_.load(std::memory_order_acquire)
               ? none_
               : slot_[current_.load(std::memory_order_acquire)];
  }

 private:
  std::array<Frames, 2> slot_{};
  Frames none_;
  std::atomic<bool> has_ended_{false};
  std::atomic<unsigned> current_{0};
  static_assert(std::atomic<unsigned>::is_always_lock_free, "or a handler could not read it");
};

}  // namespace graben::ecu
