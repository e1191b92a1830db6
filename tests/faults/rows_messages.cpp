// SPDX-License-Identifier: Apache-2.0
// Rows 7 to 16: frames whose protection says that something is wrong.

#include <cmath>
#include <deque>
#include <memory>
#include <vector>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// A message of 20 ms whose frames are refused is missing 50 ms after its last good one.
constexpr TimeUs kRefused_us = 60 * kMillisecondUs;

template <class Kind>
std::vector<Fault> missing() {
  std::vector<Fault> faults = Kind::missing();
  faults.push_back(Fault::kOperatorMissing);
  faults.push_back(Fault::kMessageSequence);
  return faults;
}

/// Everything that was refused so far.
template <class Kind>
std::uint32_t refused(const Trial<Kind>& trial) {
  return rejected(trial.rig->ecu->link());
}

template <class Kind>
void one_wrong_crc(Trial<Kind>& trial) {
  trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  const std::uint32_t before = refused(trial);
  trial.rig->tamper = [id, left = 1](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id && left-- > 0) {
      corrupt(frame);
    }
    return true;
  };
  trial.expect_ignored(300 * kMillisecondUs, Kind::kLittle_m);
  trial.check(refused(trial) == before + 1, "the frame is not counted");
}

/// Every fifth frame of a message: three wrong ones within eleven, never two in a row.
template <class Kind>
void three_wrong_crcs(Trial<Kind>& trial) {
  trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  auto number = std::make_shared<int>(0);
  trial.rig->tamper = [id, number](CanFrame& frame, const LoopbackPort*) {
    if (frame.id == id && (*number)++ % 5 == 0) {
      corrupt(frame);
    }
    return true;
  };
  trial.check(trial.rig->run_until(kSecondUs, [&] { return *number >= 11; }), "no frames");
  Stop stop{trial.rig->at_us()};
  // What is wrong by the same bits each time can be right for another message.
  stop.any = {Fault::kMessageCorrupt, Fault::kMessageMasquerade};
  stop.detect_us = stop.neutral_us = kCycle_us;
  stop.cure = [&] { trial.rig->tamper = nullptr; };
  trial.expect_stop(stop);
}

template <class Kind>
void frozen_counter(Trial<Kind>& trial) {
  trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  Stop stop{trial.last_us(id), missing<Kind>(), kRefused_us, kRefused_us};
  trial.rig->tamper = [id, counter = -1](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id) {
      counter = counter < 0 ? counter_of(frame) : counter;
      protect<Kind>(frame, static_cast<std::uint8_t>(counter));
      // A sensor that is read shows another value each time.
      if (Kind::is_read(id)) {
        alter(frame);
        protect<Kind>(frame, static_cast<std::uint8_t>(counter));
      }
    }
    return true;
  };
  stop.detect_us += cycle_us_of<Kind>(id);  // its first frame is right
  stop.neutral_us = stop.detect_us;
  stop.cure = [&] { trial.rig->tamper = nullptr; };
  trial.expect_stop(stop);
}

/// Each frame's counter is 4 to 12 ahead of the last one's.
template <class Kind>
void counter_jumps(Trial<Kind>& trial) {
  trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  Stop stop{trial.last_us(id), missing<Kind>(), kRefused_us, kRefused_us};
  const std::uint32_t before = refused(trial);
  const unsigned jump = 3 + trial.any_of(8);
  trial.rig->tamper = [id, jump, ahead = 0U](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id) {
      ahead += jump;
      protect<Kind>(frame,
                    static_cast<std::uint8_t>((counter_of(frame) + ahead) % kE2eCounterCount));
    }
    return true;
  };
  stop.cure = [&] { trial.rig->tamper = nullptr; };
  trial.expect_stop(stop);
  trial.check(refused(trial) >= before + 3, "the frames are not counted");
}

/// What a controller saw as a stroke's newest value while old frames of it came.
struct Replay {
  Sensor sensor;
  unsigned axis = 0;
  std::deque<CanFrame> block;
  double live_m[2] = {0.0, 0.0};  ///< The newest live value, and the one before.
  int old_cycles = 0;

  void note_live(const CanFrame& frame) {
    live_m[1] = live_m[0];
    const dbc::Field& field = sensor.fields[0];
    live_m[0] = dbc::physical_of(field, dbc::extract(frame.data, field.start_bit, field.width));
  }
  void note_used(double stroke_m) {
    constexpr double kSame_m = 1e-6;
    const bool is_live =
        std::abs(stroke_m - live_m[0]) < kSame_m || std::abs(stroke_m - live_m[1]) < kSame_m;
    old_cycles += is_live ? 0 : 1;
  }
};

/// An old block of 8 to 20 frames, all at once or one a cycle beside the live ones. Before the
/// window trips, an old value may be the newest one for two cycles, hal/link/e2e.hpp says; it then
/// is the last one for at most one more.
template <class Kind>
void old_block_replayed(Trial<Kind>& trial) {
  auto& rig = trial.work();
  auto replay = std::make_shared<Replay>();
  replay->axis = trial.any_of(Kind::kAxes);
  replay->sensor = Kind::strokes()[replay->axis];
  const unsigned length = 8 + trial.any_of(13);
  rig.tamper = [replay, length](CanFrame& frame, const LoopbackPort*) {
    if (frame.id == replay->sensor.id && replay->block.size() < length) {
      replay->block.push_back(frame);
    }
    return true;
  };
  rig.run(length * kCycle_us);
  rig.run(trial.any_time(300 * kMillisecondUs, 700 * kMillisecondUs));
  rig.tamper = [replay, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (frame.id == replay->sensor.id && from == &rig.machine_port) {
      replay->note_live(frame);
    }
    return true;
  };
  rig.run(2 * kCycle_us);
  const bool at_once = trial.odd();
  rig.before_ecu = [replay, &rig, at_once] {
    const std::size_t count = at_once ? replay->block.size() : 1;
    for (std::size_t n = 0; n < count && !replay->block.empty(); ++n) {
      rig.bus.inject(replay->block.front());
      replay->block.pop_front();
    }
  };
  Stop stop{rig.now_us};
  const std::uint32_t before = refused(trial);
  const TimeUs until_us = rig.now_us + 300 * kMillisecondUs;
  while (rig.now_us < until_us && rig.mode() == EcuMode::kActive) {
    rig.step();
    replay->note_used(Kind::heard_stroke_m(rig.ecu->inputs(), replay->axis));
  }
  trial.check(replay->old_cycles <= 3,
              "an old value was used for " + std::to_string(replay->old_cycles) + " cycles");
  if (rig.mode() == EcuMode::kActive) {
    trial.saw("I");
  } else {
    // The one old value that may be used can be a motion that nobody asked for, or that no oil
    // made.
    stop.any = {Fault::kMessageSequence, Fault::kUncommandedMotion, Fault::kMotionImplausible};
    stop.detect_us = 120 * kMillisecondUs;
    stop.cure = [&rig] { rig.before_ecu = nullptr; };
    trial.expect_stop(stop);
  }
  trial.check(refused(trial) > before, "no frame was refused");
}

template <class Kind>
void pair_out_of_order(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  struct Held {
    int number = 0;
    CanFrame first;
  };
  auto held = std::make_shared<Held>();
  rig.tamper = [held, id](CanFrame& frame, const LoopbackPort* from) {
    if (frame.id == id && from != nullptr && held->number < 2) {
      held->first = held->number == 0 ? frame : held->first;
      return ++held->number == 2;
    }
    return true;
  };
  rig.before_ecu = [held, &rig] {
    if (held->number == 2) {
      rig.bus.inject(held->first);
      ++held->number;
    }
  };
  trial.expect_ignored(400 * kMillisecondUs, Kind::kLittle_m);
}

/// Every frame twice, the controller's too.
template <class Kind>
void duplicates(Trial<Kind>& trial) {
  auto& rig = trial.work();
  struct Sent {
    std::vector<std::pair<CanFrame, bool>> frames;  // and whether it is the controller's own
    bool again = false;
  };
  auto sent = std::make_shared<Sent>();
  rig.tamper = [sent, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (from != nullptr && !sent->again) {
      sent->frames.emplace_back(frame, rig.from_ecu(from));
    }
    return true;
  };
  rig.before_ecu = [sent, &rig] {
    sent->again = true;
    for (const auto& [frame, is_ecus] : sent->frames) {
      if (is_ecus) {  // who sends a frame does not hear it, however often it is repeated
        static_cast<void>(rig.ecu_port.send(frame));
      } else {
        rig.bus.inject(frame);
      }
    }
    sent->frames.clear();
    sent->again = false;
  };
  trial.expect_ignored(400 * kMillisecondUs, 0.0);
}

/// All that the machine says comes 200 ms late: from some time on, which is a silence first; or
/// from the start, so that nothing is missing, and only the answer to the controller's stamp tells.
template <class Kind>
void stream_late(Trial<Kind>& trial) {
  constexpr TimeUs kLate_us = 200 * kMillisecondUs;
  auto& rig = *trial.rig;
  const auto cure = [&rig] { rig.plant.faults().frames.delay_us = 0; };
  if (trial.odd()) {
    trial.work();
    Stop stop;
    stop.cure = cure;
    rig.plant.faults().frames.delay_us = kLate_us;
    stop.since_us = rig.at_us();
    stop.any = Kind::missing();
    stop.detect_us = stop.neutral_us = 50 * kMillisecondUs;
    trial.expect_stop(stop);
  } else {
    rig.plant.faults().frames.delay_us = kLate_us;
    rig.run(kSecondUs);
    rig.ask(true, Task::kNone);
    rig.run(300 * kMillisecondUs);
    rig.ask(true, Kind::kTask);
    trial.expect_refused(ArmBlock::kStreamLate, kSecondUs, cure);
  }
}

template <class Kind>
void swapped_data_ids(Trial<Kind>& trial) {
  trial.work();
  plant::FrameFaults& frames = trial.rig->plant.faults().frames;
  const std::uint32_t one = trial.any_sensor(Kind::vital()).id;
  std::uint32_t other = one;
  while (other == one) {
    other = trial.any_id(Kind::protected_ids());
    other = other == Kind::Dbc::OperatorCommand::kId ? one : other;
  }
  Stop stop{
      trial.last_us(one), {Fault::kMessageMasquerade}, 50 * kMillisecondUs, 50 * kMillisecondUs};
  frames.swapped_data_ids = {one, other};
  stop.cure = [&frames] { frames.swapped_data_ids.reset(); };
  trial.expect_stop(stop);
}

/// A second node sends a message at the same rate, with a counter of its own and another value.
template <class Kind>
void second_sender(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const std::uint32_t id = trial.any_id(Kind::protected_ids());
  struct Other {
    CanFrame frame;
    bool due = false;
    std::uint8_t counter = 0;
  };
  auto other = std::make_shared<Other>();
  other->counter = static_cast<std::uint8_t>(trial.any_of(kE2eCounterCount));
  rig.tamper = [other, id, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (frame.id == id && from != &rig.other_port) {
      other->frame = frame;
      other->due = true;
    }
    return true;
  };
  rig.before_ecu = [other, &rig] {
    if (!other->due) {
      return;
    }
    other->due = false;
    alter(other->frame);
    protect<Kind>(other->frame, other->counter);
    other->counter = e2e_next_counter(other->counter);
    static_cast<void>(rig.other_port.send(other->frame));
  };
  Stop stop{rig.at_us(), missing<Kind>(), 120 * kMillisecondUs, 120 * kMillisecondUs};
  stop.cure = [&rig] { rig.before_ecu = nullptr; };
  trial.expect_stop(stop);
}

}  // namespace

template <class Kind>
Rows<Kind> message_rows() {
  return {{7, "one wrong CRC", "I", one_wrong_crc<Kind>},
          {8, "three wrong CRCs in the window", "N L", three_wrong_crcs<Kind>},
          {9, "frozen counter", "N L", frozen_counter<Kind>},
          {10, "counter jumps beyond the step", "N L", counter_jumps<Kind>},
          {11, "old block of valid frames replayed", "I | N L", old_block_replayed<Kind>},
          {12, "pair out of order", "I", pair_out_of_order<Kind>},
          {13, "every frame twice", "I", duplicates<Kind>},
          {14, "whole stream 200 ms late", "N L | refused", stream_late<Kind>},
          {15, "two messages' data ids swapped", "N L", swapped_data_ids<Kind>},
          {16, "two senders of one id", "N L", second_sender<Kind>}};
}

template Rows<Excavator> message_rows();
template Rows<Dozer> message_rows();

}  // namespace graben::faults
