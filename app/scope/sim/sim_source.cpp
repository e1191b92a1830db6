// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_source.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/scope/sim/sim_session.hpp"

namespace graben::scope {

void SimPacer::set_pace(double pace, Clock::time_point now) {
  constexpr std::chrono::duration<double> kCycle(0.01);
  period_ = std::chrono::round<Clock::duration>(kCycle / pace);
  next_ = std::min(next_, now + period_);
}

int SimPacer::due(Clock::time_point now) {
  if (now < next_) {
    return 0;
  }
  const auto behind = static_cast<std::uint64_t>((now - next_) / period_) + 1;
  const std::uint64_t done = std::min<std::uint64_t>(behind, kMostAtOnce);
  dropped_ += behind - done;
  next_ += static_cast<Clock::duration::rep>(behind) * period_;
  return static_cast<int>(done);
}

namespace {

using nlohmann::json;

/// Of the machines' buses.
constexpr int kBitrate = 500'000;
/// To see in time that it is to stop, or at another pace.
constexpr std::chrono::milliseconds kLongestSleep(20);

class SimSource final : public FrameSource {
 public:
  explicit SimSource(const SimOptions& options)
      : task_(options.task), session_(options, [this](const CanFrame& frame) { put(frame); }) {}

  [[nodiscard]] json setup() const override {
    return {{"source", {{"mode", "sim"}, {"name", task_}, {"bitrate", kBitrate}}},
            {"sim", session_.setup()}};
  }

  [[nodiscard]] std::string words() const override { return "simulated " + task_; }

  void run(FrameFeed& feed, const std::atomic<bool>& stop) override {
    using Clock = SimPacer::Clock;
    feed_ = &feed;
    SimPacer pacer(Clock::now());
    double pace = session_.pace();
    pacer.set_pace(pace, Clock::now());
    Clock::time_point flush = Clock::now();
    while (!stop) {
      bool changed = false;
      for (int cycles = pacer.due(Clock::now()); cycles > 0; --cycles) {
        changed = session_.step() || changed;
      }
      if (pace != session_.pace()) {
        pace = session_.pace();
        pacer.set_pace(pace, Clock::now());
      }
      if (Clock::now() >= flush) {
        feed.flush();
        flush = Clock::now() + std::chrono::microseconds(kFlushPeriodUs);
      }
      if (changed) {
        feed.wake();
      }
      std::this_thread::sleep_until(std::min(pacer.next(), Clock::now() + kLongestSleep));
    }
    feed.flush();
  }

  [[nodiscard]] std::optional<std::string> control(const json& wish) override {
    return session_.control(wish);
  }
  [[nodiscard]] std::optional<json> state(std::uint64_t& seen) const override {
    return session_.state(seen);
  }

 private:
  void put(const CanFrame& frame) { feed_->append(frame, frame.stamp_us, "vcan0"); }

  std::string task_;
  SimSession session_;
  FrameFeed* feed_ = nullptr;  ///< Of run().
};

}  // namespace

std::unique_ptr<FrameSource> make_sim_source(const SimOptions& options) {
  return std::make_unique<SimSource>(options);
}

}  // namespace graben::scope
