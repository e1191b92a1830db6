// SPDX-License-Identifier: Apache-2.0
// What the receiver makes of several wrong frames of a message.

#include "tests/unit/hal/bus_frames.hpp"
#include "tests/unit/hal/seen_inputs.hpp"

using namespace graben::test;
namespace bus = dbc::excavator;

// The message's own faults and no other's: three of them, until good frames have pushed them out.
TEST(three_wrong_frames_are_a_fault) {
  struct Wrong {
    Fault fault;
    void (*spoil)(CanFrame&);
  };
  const Wrong wrongs[] = {
      {Fault::kMessageCorrupt,
       [](CanFrame& f) { f.data[2] = static_cast<std::uint8_t>(f.data[2] ^ 0x10U); }},
      {Fault::kMessageMasquerade,
       [](CanFrame& f) { e2e_protect(f.data, bus::ArmStroke::kDataId, f.data[1] & 0x0FU); }},
      {Fault::kMessageSequence,
       [](CanFrame& f) { e2e_protect(f.data, bus::BoomStroke::kDataId, 15); }},
  };
  for (const Wrong& wrong : wrongs) {
    ExcavatorReceiver receiver;
    TimeUs now = synchronise<bus::BoomStroke>(receiver);
    std::uint8_t counter = 2;
    const auto next = [&](bool good) {
      now += 10 * kMillisecondUs;
      counter = e2e_next_counter(counter);
      CanFrame frame = frame_of(filled<bus::BoomStroke>(2000), counter);
      if (!good) {
        wrong.spoil(frame);
      }
      receiver.accept(frame, now);
      const FaultSet faults = receiver.message_faults(now);
      assert_int_equal(faults.after(faults.first()), Fault::kNone);
      return faults.first();
    };
    assert_int_equal(next(false), Fault::kNone);
    assert_int_equal(next(true), Fault::kNone);
    assert_int_equal(next(false), Fault::kNone);
    assert_int_equal(next(false), wrong.fault);
    repeat(11, [&] { assert_int_equal(next(true), wrong.fault); });
    assert_int_equal(next(true), wrong.fault);
    assert_int_equal(next(true), Fault::kNone);
  }
}

// Whichever message it is.
TEST_FOR_EACH(every_messages_window_counts, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    typename Bus::Receiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    for (int i = 0; i < 3; ++i) {
      assert_true(receiver.message_faults(now).empty());
      CanFrame frame = frame_of(filled<Message>(2000), 3);
      frame.data[2] ^= 0x10;
      receiver.accept(frame, now);
    }
    assert_true(receiver.message_faults(now).has(Fault::kMessageCorrupt));
  });
}

// One wrong frame in each of several messages is no fault; a repeated one never is.
TEST_FOR_EACH(windows_are_each_messages_own, Bus, ExcavatorBus, DozerBus) {
  typename Bus::Receiver receiver;
  TimeUs now = kFirstFrameUs;
  for_each(typename Bus::Protected{}, [&](auto type) {
    using Message = decltype(type);
    now = synchronise<Message>(receiver);
    CanFrame frame = frame_of(filled<Message>(2000), 3);
    frame.data[2] ^= 0x10;
    receiver.accept(frame, now);
    repeat(5, [&] { receiver.accept(frame_of(filled<Message>(1000), 2), now); });
  });
  const int messages = count_of(typename Bus::Protected{});
  assert_int_equal(receiver.total().wrong_crc, messages);
  assert_int_equal(receiver.total().wrong_counter, messages * 5);
  assert_true(receiver.message_faults(now).empty());
}

// Two senders: every second frame conflicts, the first sender's values stay.
TEST(two_senders_of_one_message_are_a_fault, ExcavatorReceiver receiver) {
  TimeUs now = synchronise<bus::BoomStroke>(receiver);
  for (std::uint8_t counter = 3; counter < 6; ++counter) {
    assert_true(receiver.message_faults(now).empty());
    now += 10 * kMillisecondUs;
    receiver.accept(frame_of(filled<bus::BoomStroke>(1000), counter), now);
    receiver.accept(frame_of(filled<bus::BoomStroke>(2000), counter), now);
    assert_near(receiver.inputs().axis[0].stroke_m.value, 0.05, 1e-9);
  }
  assert_true(receiver.message_faults(now).has(Fault::kMessageSequence));
}

TEST(a_burst_of_one_message_is_cut, ExcavatorReceiver receiver) {
  const TimeUs now = synchronise<bus::PumpState>(receiver) + 20 * kMillisecondUs;
  for (std::uint8_t counter = 3; counter < 13; ++counter) {
    receiver.accept(frame_of(filled<bus::PumpState>(1000U + counter), counter), now);
  }
  assert_int_equal(receiver.link(bus::PumpState::kId).accepted, 1 + 2);
  assert_int_equal(receiver.link(bus::PumpState::kId).wrong_counter, 5);
  assert_int_equal(receiver.link(bus::PumpState::kId).surplus, 3);
  assert_true(receiver.message_faults(now).has(Fault::kMessageSequence));
}

// A babbling sender costs a cycle seven frames: what it says beyond is not looked at, however good
// it is, and three of it are a fault. In the next cycle its frames are looked at again.
TEST_FOR_EACH(surplus_is_refused_unseen, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    typename Bus::Receiver receiver;
    TimeUs now = synchronise<Message>(receiver);
    now += Message::kCycleTimeMs * kMillisecondUs;
    CanFrame repeated = frame_of(filled<Message>(1000), 2);
    repeat(MessageLinks::kMostAtOnce, [&] { receiver.accept(repeated, now); });
    const LinkCounters before = receiver.link(Message::kId);
    for (int surplus = 1; surplus <= 3; ++surplus) {
      assert_true(receiver.message_faults(now).empty());
      receiver.accept(frame_of(filled<Message>(2000), 3), now);
      assert_int_equal(receiver.link(Message::kId).surplus, surplus);
    }
    assert_true(receiver.message_faults(now).has(Fault::kMessageSequence));
    assert_int_equal(receiver.link(Message::kId).accepted, before.accepted);
    assert_int_equal(rejected(receiver.link(Message::kId)), rejected(before) + 3);
    receiver.finish(now);
    assert_int_equal(receiver.link(Message::kId).accepted, before.accepted);
    receiver.accept(frame_of(filled<Message>(2000), 3), now + 1);
    assert_int_equal(receiver.link(Message::kId).accepted, before.accepted + 1);
  });
}

// However many there are: the wrong CRCs are still named beside them.
TEST(surplus_hides_nothing, ExcavatorReceiver receiver) {
  const TimeUs now = synchronise<bus::BoomStroke>(receiver) + 10 * kMillisecondUs;
  CanFrame frame = frame_of(filled<bus::BoomStroke>(2000), 3);
  frame.data[2] ^= 0x10;
  repeat(300, [&] { receiver.accept(frame, now); });
  assert_int_equal(receiver.link(bus::BoomStroke::kId).wrong_crc, MessageLinks::kMostAtOnce);
  assert_int_equal(receiver.total().surplus, 300 - MessageLinks::kMostAtOnce);
  assert_true(receiver.message_faults(now).has(Fault::kMessageCorrupt));
  assert_true(receiver.message_faults(now).has(Fault::kMessageSequence));
}

// Nothing tells which of an unprotected message's frames is right: the newest counts, as ever.
TEST_FOR_EACH(the_newest_of_an_unprotected_surplus_counts, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Unprotected{}, [](auto type) {
    using Message = decltype(type);
    constexpr int kFrames = 20;
    typename Bus::Receiver flooded;
    typename Bus::Receiver quiet;
    for (int i = 0; i < kFrames; ++i) {
      flooded.accept(frame_of(filled<Message>(1000U + static_cast<unsigned>(i)), 0), kFirstFrameUs);
    }
    flooded.finish(kFirstFrameUs);
    quiet.accept(frame_of(filled<Message>(1000U + kFrames - 1), 0), kFirstFrameUs);
    assert_true(seen_by(flooded) == seen_by(quiet));
    assert_int_equal(flooded.link(Message::kId).accepted, MessageLinks::kMostAtOnce + 1);
    assert_int_equal(flooded.total().surplus, kFrames - MessageLinks::kMostAtOnce - 1);
    assert_true(flooded.message_faults(kFirstFrameUs).empty());
    const Seen seen = seen_by(flooded);
    flooded.finish(kFirstFrameUs + 1);
    assert_true(seen_by(flooded) == seen);
  });
}
