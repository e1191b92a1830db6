#include "app/scope/sim/sim_source.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/scope/sim/sim_pacer.hpp"
#include "app/scope/sim/sim_session.hpp"

namespace graben::scope {
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
