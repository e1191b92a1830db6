// SPDX-License-Identifier: Apache-2.0
#include "app/operate/operate.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/ecu/end_signals.hpp"
#include "app/operate/bus_link.hpp"
#include "app/operate/command_frames.hpp"
#include "app/operate/screen.hpp"
#include "app/operate/terminal.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"

namespace graben::operate {
namespace {

/// Another station would have been heard 25 times.
constexpr int kListenCycles = 25;
/// Of nothing, at the end.
constexpr int kLastCycles = 5;
/// About 8 a second.
constexpr int kDrawCycles = 6;
/// So many periods left out are a silence that the controller may have taken for the end.
constexpr std::uint64_t kLateCycles = 3;

class Session {
 public:
  explicit Session(const OperateOptions& options)
      : options_(options), link_(options.interface), station_(options.station) {
    if (!signals_.error().empty()) {
      throw std::runtime_error(signals_.error().c_str());
    }
    // After the signals: they give the terminal back first.
    hands_ = hands_for(options.gamepad, options.keyboard);
  }

  void run();

 private:
  void listen();
  void work();
  void send(const Request& request, TimeUs now);
  void let_go();
  void show(const Hands& hands, int cycle, TimeUs now);

  OperateOptions options_;
  BusLink link_;
  CommandFrames frames_;
  TouchFrames touch_;
  ecu::EndSignals signals_{link_.last_frames(), link_.ports()};
  std::unique_ptr<HandSource> hands_;
  Station station_;
  Display display_;
  CyclicClock clock_{CommandFrames::kPeriod_us};
  Request request_;
  TimeUs began_us_ = 0;
};

void Session::send(const Request& request, TimeUs now) {
  const CommandPair pair = frames_.next(request, link_.ecu().echo(), now);
  const CommandPair last = frames_.last_words(now);
  link_.send(pair, last);
  if (const std::optional<CanFrame> touch = touch_.next(now)) {
    link_.send(std::array<CanFrame, 1>{*touch}, last);
  }
}

void Session::listen() {
  for (int cycle = 0; cycle < kListenCycles && !stop_requested(); ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    link_.hear(now);
    static_cast<void>(hands_->read(now));
  }
  link_.refuse_other_station();
}

void Session::work() {
  began_us_ = monotonic_now_us();
  const auto limit_us = static_cast<TimeUs>(std::llround(options_.seconds * 1e6));
  bool quits = false;
  for (int cycle = 1; !stop_requested() && !quits; ++cycle) {
    const CyclicClock::Cycle at = clock_.wait();
    if (limit_us > 0 && at.now_us - began_us_ >= limit_us) {
      return;
    }
    link_.mend(at.now_us);
    link_.hear(at.now_us);
    link_.refuse_other_station();
    const Hands hands = hands_->read(at.now_us);
    const Trouble trouble =
        at.skipped >= kLateCycles ? Trouble::kStationLate : link_.trouble(at.now_us);
    request_ = station_.step(hands, {trouble, link_.ecu().mode(at.now_us)});
    if (hands.touches) {
      touch_.begin(*hands.touches, at.now_us);
    }
    send(request_, at.now_us);
    show(hands, cycle, at.now_us);
    quits = hands.quits;
  }
}

void Session::let_go() {
  for (int cycle = 0; cycle < kLastCycles; ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    link_.hear(now);
    send({}, now);
  }
}

void Session::show(const Hands& hands, int cycle, TimeUs now) {
  if (cycle % kDrawCycles != 0) {
    return;
  }
  View view;
  view.interface = options_.interface;
  view.bus = link_.state();
  view.hands = hands_->name();
  view.help = hands_->help();
  view.deadman_held = hands.deadman;
  view.trouble = station_.deadman().trouble();
  view.chosen_task = station_.chosen_task();
  view.request = request_;
  view.ecu = &link_.ecu();
  view.now_us = now;
  view.running_us = now - began_us_;
  if (display_.is_terminal()) {
    display_.draw(screen_lines(view));
  } else {
    display_.tell(static_cast<double>(view.running_us) * 1e-6, state_line(view));
  }
}

void Session::run() {
  listen();
  try {
    work();
  } catch (...) {
    // One of nothing, so that what was asked for last does not stand.
    send({}, monotonic_now_us());
    throw;
  }
  let_go();
}

}  // namespace

void run_station(const OperateOptions& options) { Session(options).run(); }

}  // namespace graben::operate
