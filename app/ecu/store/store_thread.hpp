// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The thread that waits for disks, so that the control thread does not.

#include <pthread.h>

#include <atomic>

#include "firmware/core/time.hpp"
#include "platform/linux/process.hpp"

namespace graben::ecu {

/// Work of that thread. Neither call allocates.
class StoreWork {
 public:
  StoreWork() = default;
  virtual ~StoreWork() = default;
  StoreWork(const StoreWork&) = delete;
  StoreWork& operator=(const StoreWork&) = delete;

  /// Every 100 ms; takes what has come and writes at most one record. `now_us` is on the clock of
  /// the cycles, `unix_s` the seconds since 1970; 0: not known.
  virtual void work(TimeUs now_us, std::uint32_t unix_s) = 0;
  /// Once, after the last cycle.
  virtual void finish(TimeUs now_us, std::uint32_t unix_s) = 0;
};

/// Seconds since 1970 by the system's clock; 0 where it stands before this was written, as it does
/// on a computer that has neither battery nor network.
[[nodiscard]] std::uint32_t wall_clock_s();

/// Of normal priority, whatever that of its maker. Its stack is 32 KiB, so that locked memory does
/// not grow by the megabytes that a thread has otherwise. Signals that ask for the end are left to
/// the thread that cycles.
class StoreThread {
 public:
  /// `work` outlives the thread: see end().
  explicit StoreThread(StoreWork& work) : work_(work) {}
  /// Waits for it, however long that takes, where end() has not ended it.
  ~StoreThread();
  StoreThread(const StoreThread&) = delete;
  StoreThread& operator=(const StoreThread&) = delete;

  /// To be called before the first cycle and before memory is locked.
  [[nodiscard]] ErrorText start();
  /// Lets it finish. False where a disk keeps it for longer than `most_us`: then both this and the
  /// work have to stay until the process has ended.
  [[nodiscard]] bool end(TimeUs most_us);

 private:
  static void* run(void* self);

  StoreWork& work_;
  pthread_t thread_{};
  bool has_started_ = false;
  std::atomic<bool> is_to_end_{false};
};

}  // namespace graben::ecu
