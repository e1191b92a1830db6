// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One CAN interface that is heard and never spoken to. There is no call in here, nor in
/// can_source.cpp, that could send a frame (tests/unit/scope/check_silent.py looks at the symbols);
/// the controller still acknowledges what it hears unless it was set up as listen-only.
/// A raw CAN socket needs no privilege.

#include <cstdint>
#include <functional>
#include <string>

#include "hal/can_frame.hpp"
#include "platform/linux/can_socket.hpp"

namespace graben::scope {

class CanListener {
 public:
  using Opener = OpenedCanSocket (*)(const CanSocketConfig& config);

  explicit CanListener(std::string interface, Opener opener = &open_can_socket)
      : interface_(std::move(interface)), opener_(opener) {}
  CanListener(CanListener&& other) noexcept;
  CanListener(const CanListener&) = delete;
  CanListener& operator=(const CanListener&) = delete;
  ~CanListener();

  /// Opens the interface, again if it is open. False, with last_error(), if it is not to be had.
  bool open();
  /// Hands over every frame that waits, reports of the controller too, with the kernel's receive
  /// stamp in us since 1970. An interface that has gone away or down is not open any more.
  void hear(const std::function<void(const CanFrame&)>& frame);

  [[nodiscard]] const std::string& interface() const { return interface_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  [[nodiscard]] const char* last_error() const { return error_.c_str(); }
  /// Frames that the kernel had no room for, since it was opened first.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  void close();

  std::string interface_;
  Opener opener_;
  int fd_ = -1;
  std::uint64_t lost_ = 0;
  std::uint32_t socket_lost_ = 0;  ///< As the socket counts, which begins anew with each.
  ErrorText error_;
};

}  // namespace graben::scope
