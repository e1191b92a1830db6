// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A source that does what a test says, and a server of it on a free port.

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "app/scope/server/live_show.hpp"
#include "app/scope/server/scope_server.hpp"

namespace graben::test {

inline CanFrame numbered_frame(std::uint32_t number) {
  CanFrame frame;
  frame.id = 0x18FF2080U;
  frame.length = 4;
  for (unsigned i = 0; i < 4; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(number >> (24U - 8U * i));
  }
  return frame;
}

/// Feeds numbered frames, as many as are set every 4 ms: a server's thread that had to wait for a
/// processor has a second until its pages miss some.
class ScriptedSource : public scope::FrameSource {
 public:
  explicit ScriptedSource(int frames_per_block) : frames_per_block_(frames_per_block) {}

  [[nodiscard]] nlohmann::json setup() const override {
    return {{"source", {{"mode", "sim"}, {"name", "script"}, {"bitrate", 500000}}}};
  }
  [[nodiscard]] std::string words() const override { return "a script"; }

  void run(scope::FrameFeed& feed, const std::atomic<bool>& stop) override {
    const std::string interface = "vcan0";
    for (std::uint32_t number = 0; !stop;) {
      for (int i = 0; i < frames_per_block_; ++i) {
        feed.append(numbered_frame(number), TimeUs{number}, interface);
        ++number;
      }
      feed.flush();
      if (revision_ != told_) {
        told_ = revision_.load();
        feed.wake();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
  }

  /// Takes {"do": "stop"} alone; each changes the state.
  [[nodiscard]] std::optional<std::string> control(const nlohmann::json& wish) override {
    ++wishes_;
    if (wish.at("do") != "stop") {
      return "only stop is known";
    }
    ++revision_;
    return std::nullopt;
  }

  [[nodiscard]] std::optional<nlohmann::json> state(std::uint64_t& seen) const override {
    if (seen == revision_) {
      return std::nullopt;
    }
    seen = revision_;
    return nlohmann::json{{"kind", "sim"}, {"revision", seen}};
  }

  void set_frames_per_block(int frames) { frames_per_block_ = frames; }
  /// That got so far.
  [[nodiscard]] std::uint64_t wishes() const { return wishes_; }

 private:
  std::atomic<int> frames_per_block_;
  std::atomic<std::uint64_t> revision_{1};
  std::atomic<std::uint64_t> wishes_{0};
  std::uint64_t told_ = 1;
};

/// A server of a show on a thread of its own, until it goes.
class ServedShow {
 public:
  explicit ServedShow(scope::Show& show, std::string_view page = "<!doctype html><title>t</title>")
      : server_({"127.0.0.1", 0}, page, show),
        thread_([this] { server_.run([this] { return stop_.load(); }); }) {}
  ServedShow(const ServedShow&) = delete;
  ServedShow& operator=(const ServedShow&) = delete;
  ~ServedShow() { stop(); }

  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  [[nodiscard]] scope::ScopeServer& server() { return server_; }
  [[nodiscard]] int port() const { return server_.port(); }

 private:
  std::atomic<bool> stop_{false};
  scope::ScopeServer server_;
  std::thread thread_;
};

/// Both, at work.
class LiveRig {
 public:
  explicit LiveRig(ScriptedSource& source)
      : source_(source), show_(source_, nlohmann::json::object()), served_(show_) {
    show_.start([this] { served_.server().wake(); });
  }
  LiveRig(const LiveRig&) = delete;
  LiveRig& operator=(const LiveRig&) = delete;
  ~LiveRig() { show_.stop(); }

  [[nodiscard]] ScriptedSource& source() { return source_; }
  [[nodiscard]] int port() const { return served_.port(); }

 private:
  ScriptedSource& source_;
  scope::LiveShow show_;
  ServedShow served_;
};

}  // namespace graben::test
