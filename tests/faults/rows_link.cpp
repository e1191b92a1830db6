// SPDX-License-Identifier: Apache-2.0
// Rows 53 and 56: frames that are all right and too old, and a second controller.

#include <deque>
#include <memory>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A queue on the way of some frames: a share of what goes in comes out, none is lost. What comes
/// out is handed over in the order of going in.
template <class Kind>
class SlowQueue {
 public:
  /// Takes the place of `rig`'s tamper. `of_operator` or all of the machine's; `rate` 0.9 lets nine
  /// frames of ten pass in their cycle, the whole stream alike.
  SlowQueue(Rig<Kind>& rig, bool of_operator, double rate)
      : rig_(rig), of_operator_(of_operator), rate_(rate) {
    rig.tamper = [this](CanFrame& frame, const LoopbackPort* from) {
      const LoopbackPort& port = of_operator_ ? rig_.operator_port : rig_.machine_port;
      if (from == &port) {
        waiting_.push_back({rig_.now_us, frame});
      }
      return from != &port;
    };
    rig.before_ecu = [this] { drain(); };
    begin_us_ = rig.now_us;
    base_us_ = rig.now_us;
  }
  /// How old the newest frame is that has come out.
  [[nodiscard]] TimeUs lag_us() const { return lag_us_; }
  /// From now on it drains at twice the rate at which it is filled.
  void speed_up() {
    begin_us_ = rig_.now_us - lag_us_;
    base_us_ = rig_.now_us;
    rate_ = 2.0;
  }

 private:
  void drain() {
    // By the queue's clock, which is that of the sender slowed down.
    const auto until_us =
        begin_us_ + static_cast<TimeUs>(rate_ * static_cast<double>(rig_.now_us - base_us_));
    while (!waiting_.empty() && waiting_.front().first <= until_us) {
      lag_us_ = rig_.now_us - waiting_.front().first;
      const CanFrame frame = waiting_.front().second;
      waiting_.pop_front();
      rig_.bus.inject(frame);
    }
  }

  Rig<Kind>& rig_;
  bool of_operator_;
  double rate_;
  TimeUs begin_us_ = 0;  ///< Of the frames that came out at `base_us_`.
  TimeUs base_us_ = 0;
  TimeUs lag_us_ = 0;
  std::deque<std::pair<TimeUs, CanFrame>> waiting_;
};

/// A queue that drains at 90 to 99 % of the rate, of the machine's frames or of the operator's, who
/// lets go while it grows: neutral when the lag is 60 ms, and what the drift of clocks hides of it.
template <class Kind>
void slow_queue(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const bool of_operator = trial.any_of(2) == 1;
  const double slow = 0.01 + 0.01 * trial.any_of(10);
  SlowQueue<Kind> queue(rig, of_operator, 1.0 - slow);
  rig.run_until(12 * kSecondUs, [&] {
    return queue.lag_us() > 60 * kMillisecondUs || rig.mode() != EcuMode::kActive;
  });
  trial.check(rig.mode() == EcuMode::kActive || queue.lag_us() >= 30 * kMillisecondUs,
              "stopped before anything was late");
  Stop stop{rig.at_us()};
  // A dozer's pose that is late does not fit its rates either.
  stop.any = {Fault::kStreamLate, Fault::kPoseDisagrees};
  stop.detect_us = stop.neutral_us = 110 * kMillisecondUs;
  if (slow < 0.015) {  // 0.1 % of the 1 % passes for the clocks': 67 ms of lag, 0.7 s later
    stop.detect_us = stop.neutral_us = 900 * kMillisecondUs;
  }
  stop.cure = [&queue] { queue.speed_up(); };
  trial.expect_stop(stop);
  rig.tamper = nullptr;
  rig.before_ecu = nullptr;
}

/// All that a station sends is late from its power-on by the same time, whole periods of the
/// counter and of the stamps too: nothing arms.
template <class Kind>
void late_from_the_start(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  constexpr TimeUs kLate_us[] = {80'000, 100'000, 150'000, 300'000, 500'000, 1'000'000, 2'000'000};
  const TimeUs late_us = kLate_us[trial.any_of(7)];
  const bool of_operator = trial.any_of(2) == 1;
  plant::FrameFaults& frames = of_operator ? rig.driver.faults() : rig.plant.faults().frames;
  frames.delay_us = late_us;
  rig.run(2500 * kMillisecondUs);
  rig.ask(true, Task::kNone);
  rig.run(300 * kMillisecondUs);
  rig.ask(true, Kind::kTask);
  trial.expect_refused(ArmBlock::kStreamLate, 2500 * kMillisecondUs,
                       [&frames] { frames.delay_us = 0; });
}

template <class Kind>
void frames_late(Trial<Kind>& trial) {
  trial.odd() ? slow_queue(trial) : late_from_the_start(trial);
}

/// A second controller of the same kind on the bus, or the replay of our own commands of just now.
template <class Kind>
void second_controller(Trial<Kind>& trial) {
  auto& rig = *trial.rig;
  struct Other {
    std::deque<CanFrame> log;
    std::optional<typename Kind::Ecu> ecu;
    bool plays = false;
  };
  auto other = std::make_shared<Other>();
  const bool is_replay = trial.odd();
  rig.tamper = [other, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (rig.from_ecu(from) && !other->plays && other->log.size() < 400) {
      other->log.push_back(frame);
    }
    return true;
  };
  trial.work();
  const TimeUs since_us = rig.now_us;
  other->plays = true;
  if (is_replay) {
    rig.before_all = [other, &rig] {
      for (const TimeUs of_cycle_us = other->log.empty() ? 0 : other->log.front().stamp_us;
           !other->log.empty() && other->log.front().stamp_us == of_cycle_us;
           other->log.pop_front()) {
        static_cast<void>(rig.other_port.send(other->log.front()));
      }
    };
  } else {
    other->ecu.emplace(rig.machine.profile, rig.machine.hash, rig.other_port);
    rig.before_all = [other, &rig] { other->ecu->step(rig.now_us, 0); };
  }
  Stop stop{since_us, {Fault::kSecondController}, 20 * kMillisecondUs, 20 * kMillisecondUs};
  stop.cure = [&rig, other] {
    rig.before_all = nullptr;
    other->ecu.reset();
  };
  trial.expect_stop(stop);
  rig.tamper = nullptr;
}

}  // namespace

template <class Kind>
Rows<Kind> link_rows() {
  return {
      {53, "frames through a slow queue; late from the start", "N L | refused", frames_late<Kind>},
      {56, "a second controller; replayed commands", "N L", second_controller<Kind>}};
}

template Rows<Excavator> link_rows();
template Rows<Dozer> link_rows();

}  // namespace graben::faults
