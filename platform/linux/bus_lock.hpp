// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One controller a bus, as far as one machine's processes go: who comes second is refused before
/// it has sent a frame. Across machines hal/link/message_links.hpp hears the other one.

#include <string>

#include "platform/linux/process.hpp"

namespace graben {

/// Held as long as the object lives, and no longer than the process whatever ends it. It is a name
/// in the network namespace, as the interface is; nothing is left in the file system.
class BusLock {
 public:
  explicit BusLock(const std::string& interface);
  ~BusLock();
  BusLock(const BusLock&) = delete;
  BusLock& operator=(const BusLock&) = delete;

  /// Why it is not held, in words; empty if it is.
  [[nodiscard]] const ErrorText& error() const { return error_; }

 private:
  int fd_ = -1;
  ErrorText error_;
};

}  // namespace graben
