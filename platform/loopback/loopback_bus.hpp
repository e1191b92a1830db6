// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A CAN bus in memory: what one port sends, every other receives at once, in the order of sending.
/// Arbitration, bit timing and acknowledgement are not modelled. Deterministic: no thread, no
/// clock. Not for the control path: it allocates.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/can_port.hpp"

namespace graben {

class LoopbackBus;

/// One node's access to the bus. The bus owns it.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class LoopbackPort final : public CanPort {
 public:
  LoopbackPort(LoopbackBus& bus, std::size_t queue_capacity)
      : bus_(bus), queue_capacity_(queue_capacity) {}

  /// Discards the queue; false while the node is set down.
  [[nodiscard]] bool open() override;
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override;
  /// False unless the state is kActive or kErrorPassive, while the queue is set full, and for what
  /// a babbling node keeps off the bus.
  [[nodiscard]] bool send(const CanFrame& frame) override;
  [[nodiscard]] CanPortState state() const override { return state_; }

  /// Plays a fault of this node's controller. Bus-off, down and closed neither send nor receive,
  /// and a node that is down cannot be opened until it is set kClosed.
  void set_state(CanPortState state) { state_ = state; }

  /// Plays a transmit queue that is full (ENOBUFS): nothing can be sent; reception goes on.
  void set_send_fails(bool fails) { send_fails_ = fails; }

  /// Frames lost because the queue was full; the oldest ones are kept, as a socket does.
  [[nodiscard]] std::uint64_t overflow_count() const { return overflow_count_; }

 private:
  friend class LoopbackBus;
  [[nodiscard]] bool on_bus() const;
  void deliver(const CanFrame& frame);

  LoopbackBus& bus_;
  std::size_t queue_capacity_;
  std::deque<CanFrame> queue_;
  CanPortState state_ = CanPortState::kClosed;
  bool send_fails_ = false;
  std::uint64_t overflow_count_ = 0;
};

class LoopbackBus {
 public:
  static constexpr std::size_t kQueueCapacity = 256;

  /// Sees each frame as it is on the bus, its stamp the bus's time.
  using Tap = std::function<void(const CanFrame&)>;
  /// May alter the frame; false drops it. `from` is null for an injected frame. Must not send.
  using FaultHook = std::function<bool(CanFrame&, const LoopbackPort* from)>;

  LoopbackBus() = default;
  ~LoopbackBus() = default;
  LoopbackBus(const LoopbackBus&) = delete;
  LoopbackBus& operator=(const LoopbackBus&) = delete;

  /// A new node, closed; lives as long as the bus.
  LoopbackPort& attach(std::size_t queue_capacity = kQueueCapacity);

  /// The stamp of frames from here on; it is also the time that a log of the tap has.
  void set_time(TimeUs now) { now_ = now; }
  [[nodiscard]] TimeUs time() const { return now_; }

  /// Plays a node that fills the bus with frames of this 29-bit id: no port's frame of lower
  /// priority gets through, nothing of the babble itself is delivered. Injected frames are not held
  /// up.
  void set_babble(std::optional<std::uint32_t> id) { babble_id_ = id; }

  void set_tap(Tap tap) { tap_ = std::move(tap); }
  void set_fault_hook(FaultHook hook) { fault_hook_ = std::move(hook); }

  /// Puts a frame on the bus that no port sent: for nodes and faults that a test plays. Every port
  /// receives it.
  void inject(const CanFrame& frame) { transmit(frame, nullptr); }

 private:
  friend class LoopbackPort;
  void transmit(CanFrame frame, const LoopbackPort* from);
  [[nodiscard]] bool loses_arbitration(const CanFrame& frame) const;

  std::vector<std::unique_ptr<LoopbackPort>> ports_;
  Tap tap_;
  FaultHook fault_hook_;
  std::optional<std::uint32_t> babble_id_;
  TimeUs now_ = 0;
};

}  // namespace graben
