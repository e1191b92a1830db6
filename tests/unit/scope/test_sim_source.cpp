// SPDX-License-Identifier: Apache-2.0
// A simulation in real time: as fast as it is asked to be, and over when it is told so.

#include "app/scope/sim/sim_source.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

#include "tests/unit/cmocka_cpp.hpp"

using scope::FrameFeed;
using Clock = std::chrono::steady_clock;
using nlohmann::json;
using std::chrono::milliseconds;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A source at work, and how far its frames have come.
class Running {
 public:
  explicit Running(double pace)
      : source(scope::make_sim_source({})), reader_(feed_), begin_(Clock::now()) {
    feed_.on_change([this] { ++woken; });
    const json wish = {{"do", "pace"}, {"value", pace}};
    assert_false(source->control(wish).has_value());
    thread_ = std::thread([this] { source->run(feed_, stop_); });
  }
  ~Running() { stop(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  /// Simulated time of the newest frame, s.
  double simulated_s() {
    while (const auto block = reader_.next()) {
      if (first.empty()) {
        first = block->text.substr(0, block->text.find('\n'));
      }
      frames += block->frames;
      ++blocks;
      const std::size_t line = block->text.rfind('(');
      newest_s_ = std::stod(block->text.substr(line + 1));
    }
    return newest_s_;
  }
  [[nodiscard]] double real_s() const { return seconds_since(begin_); }

  std::unique_ptr<scope::FrameSource> source;
  std::string first;
  std::uint64_t frames = 0;
  int blocks = 0;
  std::atomic<int> woken = 0;

 private:
  FrameFeed feed_;
  scope::FrameReader reader_;
  std::atomic<bool> stop_ = false;
  Clock::time_point begin_;
  double newest_s_ = 0.0;
  std::thread thread_;
};

/// A machine that is busy may lag: the lower bound is a wide one.
void runs_at(double pace, double real_s) {
  Running running(pace);
  while (running.simulated_s() < pace * real_s && running.real_s() < 10.0 * real_s) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  running.stop();
  const double simulated_s = running.simulated_s();
  const double most_s = pace * running.real_s() + 0.06;
  if (!(simulated_s >= pace * real_s && simulated_s <= most_s)) {
    print_error("%g s in %g s at pace %g\n", simulated_s, running.real_s(), pace);
  }
  assert_true(simulated_s >= pace * real_s && simulated_s <= most_s);
  assert_true(running.frames > 0);
  assert_true(running.first.rfind("(0000000000.000000) vcan0 ", 0) == 0);
}

TEST(is_as_fast_as_it_is_asked_to_be) {
  runs_at(1.0, 0.4);
  runs_at(0.2, 0.4);
  runs_at(5.0, 0.4);
}

/// The fastest of many: the others may have waited for the processor.
TEST(ends_when_it_is_told_so) {
  for (const double pace : {0.1, 1.0}) {
    double least_s = 1e9;
    for (int i = 0; i < 50 && least_s >= 0.1; ++i) {
      Running running(pace);
      std::this_thread::sleep_for(milliseconds(10));
      const Clock::time_point begin = Clock::now();
      running.stop();
      least_s = std::min(least_s, seconds_since(begin));
    }
    assert_true(least_s < 0.1);
  }
}

TEST(tells_of_another_state) {
  Running running(1.0);
  std::uint64_t seen = 0;
  std::optional<json> state;
  const auto waits_for = [&](const std::function<bool()>& done) {
    bool is_done = done();
    for (; !is_done && running.real_s() < 30.0; is_done = done()) {
      std::this_thread::sleep_for(milliseconds(5));
    }
    return is_done;
  };
  assert_true(waits_for([&] { return running.simulated_s() > 0.1; }));
  static_cast<void>(running.source->state(seen));
  assert_false(running.source->control({{"do", "stop"}}).has_value());
  assert_true(waits_for([&] {
    state = running.source->state(seen);
    return state.has_value();
  }));
  assert_true((*state)["kind"] == "sim" && (*state)["running"] == false);
  running.stop();
  static_cast<void>(running.simulated_s());
  // Once for each block, and once for the state.
  assert_int_equal(running.woken, running.blocks + 1);
  assert_true(running.source->control({{"do", "dig"}}).has_value());
}

TEST(says_what_it_is) {
  scope::SimOptions options;
  options.task = "grade";
  const auto source = scope::make_sim_source(options);
  const json setup = source->setup();
  assert_true(setup["source"] ==
              json::parse(R"({"mode": "sim", "name": "grade", "bitrate": 500000})"));
  assert_true(setup["sim"]["task"] == "grade" && setup["sim"]["faults"].size() > 30);
  assert_string_equal(source->words().c_str(), "simulated grade");
}
