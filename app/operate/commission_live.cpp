// SPDX-License-Identifier: Apache-2.0
#include "app/operate/commission_live.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>

#include "app/ecu/end_signals.hpp"
#include "app/operate/bus_link.hpp"
#include "app/operate/terminal.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"
#include "platform/loopback/candump_log.hpp"

namespace graben::operate {
namespace {

/// Another station would have been heard 25 times.
constexpr int kListensFor = 50;
/// Of nothing, at the end.
constexpr int kEndsFor = 10;
constexpr int kFlushEvery = 20;
/// A silence that the controller may have taken for the end.
constexpr std::uint64_t kTooLate = 4;

/// From the clock of the stamps to that of dates: as candump writes a log.
TimeUs date_offset_us() {
  const auto date = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(date).count() - monotonic_now_us();
}

template <class Lead>
class CommissionSession {
 public:
  using Progress = commission::ProgressOf<typename Lead::Options>;

  CommissionSession(const LiveOptions& options, const Progress& progress)
      : options_(options),
        progress_(progress),
        link_(options.interface, Lead::kDbcVersion),
        station_(
            {progress.options, progress.results, progress.profile_hash, options.silent_after_us}),
        log_(options.log, options.interface, CandumpLog::Form::kGrows) {
    if (!signals_.error().empty()) {
      throw std::runtime_error(signals_.error().c_str());
    }
    // After the signals: they give the terminal back first.
    hands_ = hands_for(options.gamepad, options.keyboard);
    link_.set_tap([this](const CanFrame& frame) {
      station_.hear(frame, heard_us_);
      log_.write(frame, static_cast<TimeUs>(frame.stamp_us) + offset_us_);
    });
  }

  LiveResult run();

 private:
  void listen();
  void work();
  void let_go();
  void send(const Request& request, const typename Lead::Tried& tried, TimeUs now);
  void hear(TimeUs now);
  void keep_results();
  void tell(const std::string& line, TimeUs now);

  LiveOptions options_;
  Progress progress_;
  BusLink link_;
  ecu::EndSignals signals_{link_.last_frames(), link_.ports()};
  std::unique_ptr<HandSource> hands_;
  CommissionStationOf<Lead> station_;
  typename Lead::Frames frames_;
  CandumpLog log_;
  TimeUs offset_us_ = date_offset_us();
  Display display_;
  CyclicClock clock_{CommissionStationOf<Lead>::kPeriod_us};
  TimeUs began_us_ = monotonic_now_us();
  TimeUs heard_us_ = began_us_;  ///< Of the cycle.
};

template <class Lead>
void CommissionSession<Lead>::send(const Request& request, const typename Lead::Tried& tried,
                                   TimeUs now) {
  const std::vector<CanFrame> frames = frames_.next(request, tried, link_.ecu().echo(), now);
  const auto last = frames_.last_words(now);
  link_.send(frames, last);
}

template <class Lead>
void CommissionSession<Lead>::tell(const std::string& line, TimeUs now) {
  display_.tell(static_cast<double>(now - began_us_) * 1e-6, line);
}

template <class Lead>
void CommissionSession<Lead>::hear(TimeUs now) {
  heard_us_ = now;
  link_.hear(now);
}

template <class Lead>
void CommissionSession<Lead>::listen() {
  for (int cycle = 0; cycle < kListensFor && !stop_requested(); ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    hear(now);
    static_cast<void>(hands_->read(now));
  }
  link_.refuse_other_station();
}

/// Between two steps nothing moves: what the file takes costs a pause at most.
template <class Lead>
void CommissionSession<Lead>::keep_results() {
  const auto results = station_.sequence().results();
  if (results.size() == progress_.results.size()) {
    return;
  }
  progress_.results = results;
  commission::write_progress(commission::progress_file(options_.log), progress_);
  tell(result_line(station_.lead(), results.size() - 1), monotonic_now_us());
}

template <class Lead>
void CommissionSession<Lead>::work() {
  bool quits = false;
  for (int cycle = 0; !stop_requested() && !quits && station_.end() == CommissionEnd::kNone;
       ++cycle) {
    const CyclicClock::Cycle at = clock_.wait();
    link_.mend(at.now_us);
    hear(at.now_us);
    link_.refuse_other_station();
    const Hands hands = hands_->read(at.now_us);
    const Trouble trouble =
        at.skipped >= kTooLate ? Trouble::kStationLate : link_.trouble(at.now_us);
    station_.step(hands, trouble, link_.ecu(), at.now_us);
    if (cycle % 2 == 0) {
      send(station_.request(), station_.tried(), at.now_us);
    }
    keep_results();
    tell(commission_line(station_, link_.ecu(), at.now_us), at.now_us);
    if (cycle % kFlushEvery == 0) {
      log_.flush();
    }
    quits = hands.quits;
  }
}

template <class Lead>
void CommissionSession<Lead>::let_go() {
  const auto nothing = station_.lead().tried(false);
  for (int cycle = 0; cycle < kEndsFor; ++cycle) {
    const TimeUs now = clock_.wait().now_us;
    hear(now);
    if (cycle % 2 == 0) {
      send({}, nothing, now);
    }
  }
  hear(monotonic_now_us());
}

template <class Lead>
LiveResult CommissionSession<Lead>::run() {
  listen();
  try {
    work();
  } catch (...) {
    // One of nothing, so that what was asked for last does not stand.
    send({}, {}, monotonic_now_us());
    throw;
  }
  let_go();
  log_.close();
  const auto& sequence = station_.sequence();
  return {station_.end(), station_.end_words(), sequence.results().size(), station_.lead().steps(),
          sequence.active_s()};
}

}  // namespace

LiveResult run_live_commission(const LiveOptions& options, const commission::Progress& progress) {
  return CommissionSession<ExcavatorLead>(options, progress).run();
}

LiveResult run_live_commission(const LiveOptions& options,
                               const commission::DozerProgress& progress) {
  return CommissionSession<DozerLead>(options, progress).run();
}

}  // namespace graben::operate
