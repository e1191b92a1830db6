// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A queue from one thread to another, of fixed size, without a lock: neither end ever waits.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace graben::ecu {

/// One thread puts, one takes; the rest may be asked by both. What does not fit is dropped and
/// counted. `kSize` is a power of two.
template <class T, std::size_t kSize>
class SpscRing {
  static_assert((kSize & (kSize - 1)) == 0 && kSize > 0, "a power of two");
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "or an end could wait");

 public:
  /// Where the next one is to be filled in, of the end that puts: what is there is an older one.
  /// Null if the queue is full, which is counted.
  [[nodiscard]] T* place() {
    const std::uint32_t put = put_.load(std::memory_order_relaxed);
    if (!has_room()) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return nullptr;
    }
    return &slot_[put % kSize];
  }
  /// Whether place() would be one.
  [[nodiscard]] bool has_room() const {
    return put_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_acquire) < kSize;
  }
  /// Hands over what has been filled in at place().
  void put() { put_.store(put_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
  /// Both at once.
  bool put(const T& value) {
    T* const at = place();
    if (at == nullptr) {
      return false;
    }
    *at = value;
    put();
    return true;
  }

  /// The oldest one, of the end that takes, until take(); null if there is none.
  [[nodiscard]] const T* front() const {
    const std::uint32_t taken = taken_.load(std::memory_order_relaxed);
    return taken == put_.load(std::memory_order_acquire) ? nullptr : &slot_[taken % kSize];
  }
  void take() {
    taken_.store(taken_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  [[nodiscard]] std::uint32_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::array<T, kSize> slot_{};
  std::atomic<std::uint32_t> put_{0};
  std::atomic<std::uint32_t> taken_{0};
  std::atomic<std::uint32_t> dropped_{0};
};

}  // namespace graben::ecu
