// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One or more CAN interfaces, real or virtual, which are only heard.

#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scope/server/can_listener.hpp"
#include "app/scope/server/frame_source.hpp"

namespace graben::scope {

class CanSource : public FrameSource {
 public:
  /// Throws std::runtime_error for a list that is empty or names an interface twice, and for an
  /// interface that this machine does not have. One that is down is waited for.
  CanSource(const std::vector<std::string>& interfaces, int bitrate_bps,
            CanListener::Opener opener = &open_can_socket);

  [[nodiscard]] nlohmann::json setup() const override;
  [[nodiscard]] std::string words() const override { return "CAN " + name_; }
  void run(FrameFeed& feed, const std::atomic<bool>& stop) override;
  [[nodiscard]] std::optional<nlohmann::json> state(std::uint64_t& seen) const override;

 private:
  struct Heard {
    CanFrame frame;
    const CanListener* from = nullptr;
  };

  void hear(FrameFeed& feed);
  void open_what_is_closed();
  void tell_state(const FrameFeed& feed);

  std::string name_;
  int bitrate_bps_;
  std::vector<CanListener> listeners_;
  std::vector<Heard> heard_;  ///< And not fed yet.

  mutable std::mutex mutex_;
  nlohmann::json state_;  ///< A `bus` message.
  std::uint64_t revision_ = 1;
};

}  // namespace graben::scope
