// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Every signal that would end the process brings neutral first.
///
/// A signal that asks for the end (SIGTERM, SIGINT, SIGHUP, SIGQUIT, and all that would end a
/// process that does not expect them, as SIGUSR1, SIGPIPE, SIGALRM) only makes stop_requested()
/// true: the cycle goes on to send neutral. A second one of the same kind, for a process that no
/// longer looks, and what tells that the process has failed (SIGSEGV, SIGBUS, SIGFPE, SIGILL,
/// SIGABRT, SIGSYS, SIGTRAP, SIGXCPU) puts the neutral frames of LastFrames on the bus that each is
/// for, or on all, then does what it does by default.
///
/// SIGKILL and SIGSTOP cannot be caught, SIGTSTP, SIGTTIN and SIGTTOU are not: there the valve side
/// closes after 100 ms without a command.

#include <deque>

#include "app/ecu/last_frames.hpp"
#include "platform/linux/process.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::ecu {

/// For the thread that runs the cycles, in a process without any other; one at a time. Frames and
/// ports outlive it; the ports are in the order of the buses' numbers, and more than a CanPortGroup
/// takes are an error. After it the signals are caught still, and nothing is sent any more.
class EndSignals {
 public:
  EndSignals(const LastFrames& frames, const std::deque<SocketCanPort>& ports);
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  /// Empty if every signal is caught, for every port.
  [[nodiscard]] const ErrorText& error() const { return error_; }

 private:
  ErrorText error_;
};

}  // namespace graben::ecu
