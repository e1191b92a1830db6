// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tells the service manager how we are: systemd's sd_notify protocol, a datagram a message to the
/// socket that $NOTIFY_SOCKET names. So few lines that libsystemd is not worth its dependency.

#include <sys/types.h>

#include "firmware/core/time.hpp"

namespace graben {

/// Nothing here blocks, and nothing fails but by being lost: a message that the manager's queue has
/// no room for is dropped, and the next one says the same.
class ServiceNotify {
 public:
  /// The socket: a path, or '@' and an abstract name. Null or empty: nobody listens, and every call
  /// is false at no cost.
  explicit ServiceNotify(const char* socket_name);
  ~ServiceNotify();
  ServiceNotify(const ServiceNotify&) = delete;
  ServiceNotify& operator=(const ServiceNotify&) = delete;

  /// Somebody listens.
  [[nodiscard]] bool connected() const { return socket_ >= 0; }

  // Each returns false if it was not delivered.
  bool ready();
  bool stopping();
  /// To be sent only when a cycle was completed: the manager restarts what stops saying this.
  bool watchdog();
  /// One line for `systemctl status`; cut at 200 bytes.
  bool status(const char* line);

 private:
  bool send(const char* message);

  int socket_ = -1;
};

/// How often the manager wants to hear watchdog(), at the latest; 0 when it does not. From
/// $WATCHDOG_USEC and $WATCHDOG_PID, which may be null; the latter, if there, must be our own.
[[nodiscard]] TimeUs watchdog_interval_us(const char* watchdog_usec, const char* watchdog_pid,
                                          pid_t own_pid);

}  // namespace graben
