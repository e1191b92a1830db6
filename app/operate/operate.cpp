#include "app/operate/operate.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <stdexcept>

#include "app/ecu/end_signals.hpp"
#include "app/ecu/last_frames.hpp"
#include "app/operate/command_frames.hpp"
#include "app/operate/ecu_listener.hpp"
#include "app/operate/gamepad.hpp"
#include "app/operate/screen.hpp"
#include "app/operate/terminal.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::operate {
namespace {

/// Another station would have been heard 25 times.
constexpr int kListenCycles = 25;
/// Of nothing, at the end.
constexpr int kLastCycles = 5;
constexpr int kReopenCycles = 25;
/// About 8 a second.
constexpr int kDrawCycles = 6;
/// So many periods left out are a silence that the controller may have taken for the end.
constexpr std::uint64_t kLateCycles = 3;
/// Of one cycle; what a bus can carry in a second.
constexpr int kMostReads = 128;

std::unique_ptr<HandSource> hands_for(const OperateOptions& options) {
  if (options.keyboard) {
    return std::make_unique<Keyboard>();
  }
  return std::make_unique<Gamepad>(options.gamepad.empty() ? only_gamepad(find_gamepads())
                                                           : options.gamepad);
}

/// The bus, and what is known of the other end.
class Link {
 public:
  explicit Link(const std::string& interface) {
    ports_.emplace_back(interface, std::vector<std::uint32_t>{});
    if (!port().open()) {
      throw std::runtime_error(port().last_error());
    }
  }

  void hear(TimeUs now);
  void send(const Request& request, TimeUs now);
  /// Tries to open an interface that is down or a bus that does not come back, now and then.
  void mend(int cycle);
  [[nodiscard]] Trouble trouble(TimeUs now) const;
  [[nodiscard]] const EcuListener& ecu() const { return ecu_; }
  [[nodiscard]] CanPortState state() const { return ports_.front().state(); }
  [[nodiscard]] const ecu::LastFrames& last_frames() const { return last_; }
  [[nodiscard]] const std::deque<SocketCanPort>& ports() const { return ports_; }

 private:
  SocketCanPort& port() { return ports_.front(); }

  std::deque<SocketCanPort> ports_;
  EcuListener ecu_;
  CommandFrames frames_;
  ecu::LastFrames last_;
};

void Link::hear(TimeUs now) {
  constexpr int kFramesPerRead = 64;
  std::array<CanFrame, kFramesPerRead> frames;
  for (int read = 0; read < kMostReads; ++read) {
    const int count = port().receive(frames.data(), kFramesPerRead);
    for (int i = 0; i < count; ++i) {
      ecu_.hear(frames[static_cast<std::size_t>(i)], now);
    }
    if (count < kFramesPerRead) {
      return;
    }
  }
}

void Link::send(const Request& request, TimeUs now) {
  const CommandPair pair = frames_.next(request, ecu_.echo(), now);
  const CommandPair last = frames_.last_words(now);
  last_.put(last.data(), last.size());
  for (const CanFrame& frame : pair) {
    // What is not taken is not sent again: the next one comes soon, and says more.
    static_cast<void>(port().send(frame));
  }
}

void Link::mend(int cycle) {
  if (cycle % kReopenCycles == 0 && state() != CanPortState::kActive) {
    // Still away: tried again in a moment.
    static_cast<void>(port().open());
  }
}

Trouble Link::trouble(TimeUs now) const {
  if (state() != CanPortState::kActive) {
    return Trouble::kBus;
  }
  if (!ecu_.hears_ecu(now)) {
    return Trouble::kEcuSilent;
  }
  return ecu_.other_version() ? Trouble::kOtherDbc : Trouble::kNone;
}

void refuse_other_station(const EcuListener& ecu, const std::string& interface) {
  if (const auto other = ecu.other_station()) {
    throw std::runtime_error(
        fmt::format("{}: another station sends OperatorCommand (source address {}); two at a time "
                    "are none. Nothing more is sent from here",
                    interface, *other));
  }
}

class Session {
 public:
  explicit Session(const OperateOptions& options)
      : options_(options), link_(options.interface), station_(options.station) {
    if (!signals_.error().empty()) {
      throw std::runtime_error(signals_.error().c_str());
    }
    // After the signals: they give the terminal back first.
    hands_ = hands_for(options);
  }

  void run();

 private:
  void listen();
  void work();
  void let_go();
  void show(const Hands& hands, int cycle, TimeUs now);

  OperateOptions options_;
  Link link_;
  ecu::EndSignals signals_{link_.last_frames(), link_.ports()};
  std::unique_ptr<HandSource> hands_;
  Station station_;
  Display display_;
  CyclicClock clock_{CommandFrames::kPeriod_us};
  Request request_;
  TimeUs began_us_ = 0;
};

void Session::listen() {
  for (int cycle = 0; cycle < kListenCycles && !stop_requested(); ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    link_.hear(now);
    static_cast<void>(hands_->read(now));
  }
  refuse_other_station(link_.ecu(), options_.interface);
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
    link_.mend(cycle);
    link_.hear(at.now_us);
    refuse_other_station(link_.ecu(), options_.interface);
    const Hands hands = hands_->read(at.now_us);
    const Trouble trouble =
        at.skipped >= kLateCycles ? Trouble::kStationLate : link_.trouble(at.now_us);
    request_ = station_.step(hands, {trouble, link_.ecu().mode(at.now_us)});
    link_.send(request_, at.now_us);
    show(hands, cycle, at.now_us);
    quits = hands.quits;
  }
}

void Session::let_go() {
  for (int cycle = 0; cycle < kLastCycles; ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    link_.hear(now);
    link_.send({}, now);
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
    link_.send({}, monotonic_now_us());
    throw;
  }
  let_go();
}

}  // namespace

void run_station(const OperateOptions& options) { Session(options).run(); }

}  // namespace graben::operate
