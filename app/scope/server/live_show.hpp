// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames as they come, from a source with a thread of its own.

#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <thread>

#include "app/scope/server/frame_feed.hpp"
#include "app/scope/server/frame_source.hpp"
#include "app/scope/server/show.hpp"

namespace graben::scope {

class LiveShow : public Show {
 public:
  /// `parts`: what of Setup is the same for every source ("machines", "words"). The source must
  /// outlive this.
  LiveShow(FrameSource& source, const nlohmann::json& parts);
  ~LiveShow() override;

  /// Starts the source. `on_change`, called from its thread, is told that there is something new.
  void start(std::function<void()> on_change);
  /// Stops it, and waits for it.
  void stop();
  /// Whether the source has ended, by itself or by what it threw, which stop_and_rethrow() throws.
  [[nodiscard]] bool has_ended() const { return ended_; }
  void stop_and_rethrow();

  [[nodiscard]] const std::string& setup() const override { return setup_; }
  [[nodiscard]] std::string words() const override { return source_.words(); }
  [[nodiscard]] std::unique_ptr<ClientStream> open() const override;
  /// Some two seconds of a full bus: what waits there is late when it comes, but is not lost.
  [[nodiscard]] int send_buffer_bytes() const override { return 128 * 1024; }
  [[nodiscard]] std::optional<std::string> control(const nlohmann::json& wish) override {
    return source_.control(wish);
  }
  [[nodiscard]] std::optional<nlohmann::json> state(std::uint64_t& seen) const override {
    return source_.state(seen);
  }

 private:
  void run();

  FrameSource& source_;
  std::string setup_;
  FrameFeed feed_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> ended_{false};
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace graben::scope
