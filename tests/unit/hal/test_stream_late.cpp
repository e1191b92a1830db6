// SPDX-License-Identifier: Apache-2.0
// What a receiver makes of frames that come later and later, and of its own that others send.

#include <algorithm>

#include "tests/unit/hal/bus_frames.hpp"

using namespace graben::test;

constexpr TimeUs kCycleUs = 10'000;

// Frames in order through a queue that takes `passed_us` for what was sent in a cycle. Returns the
// true lag, in us, of the frame that was refused first; -1: none in an hour.
template <class Message, class Receiver>
TimeUs refused_at(TimeUs passed_us) {
  constexpr TimeUs kMessageCycleUs = Message::kCycleTimeMs * kMillisecondUs;
  Receiver receiver;
  TimeUs now = synchronise<Message>(receiver);
  const TimeUs start_us = now;
  std::uint8_t counter = 2;
  for (TimeUs sent_us = 0; now - start_us < 3600 * kSecondUs;) {
    now += passed_us;
    sent_us += kMessageCycleUs;
    counter = e2e_next_counter(counter);
    const std::uint32_t before = receiver.link(Message::kId).accepted;
    receiver.accept(frame_of(filled<Message>(1000), counter), now);
    const bool refused = receiver.link(Message::kId).accepted == before;
    assert_true(receiver.message_faults(now).has(Fault::kStreamLate) == refused);
    if (refused) {
      assert_int_equal(receiver.link(Message::kId).wrong_counter, 1);
      return now - start_us - sent_us;
    }
  }
  return -1;
}

TEST_FOR_EACH(a_slow_queue_is_seen, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    constexpr TimeUs kMessageCycleUs = Message::kCycleTimeMs * kMillisecondUs;
    // 90, 95, 99 and 99.8 % of the rate; at 99.9 % it could be the sender's clock.
    for (const auto& [percent, least, most] :
         {std::array<TimeUs, 3>{1100, 60'000, 64'000}, std::array<TimeUs, 3>{1050, 60'000, 64'000},
          std::array<TimeUs, 3>{1010, 60'000, 70'000},
          std::array<TimeUs, 3>{1002, 110'000, 130'000}}) {
      const TimeUs lag_us =
          refused_at<Message, typename Bus::Receiver>(kMessageCycleUs * percent / 1000);
      // Late by whole frames: one of 50 or 100 ms is found later.
      const TimeUs step_us = kMessageCycleUs * (percent - 1000) / 1000;
      assert_in_range(lag_us, least, std::max({most, least + step_us, 6 * kMessageCycleUs / 5}));
    }
    assert_int_equal((refused_at<Message, typename Bus::Receiver>(kMessageCycleUs * 1001 / 1000)),
                     -1);
  });
}

// One message of an excavator's, frame by frame.
struct Stream {
  using Message = dbc::excavator::BoomStroke;
  ExcavatorReceiver receiver;
  TimeUs now = synchronise<Message>(receiver);
  std::uint8_t counter = 2;

  bool is_late(TimeUs passed_us, unsigned steps) {
    now += passed_us;
    counter = static_cast<std::uint8_t>((counter + steps) % kE2eCounterCount);
    receiver.accept(frame_of(filled<Message>(1000), counter), now);
    return receiver.message_faults(now).has(Fault::kStreamLate);
  }
};

// Lost frames, a sender that pauses, one that starts anew; 70 ms in all.
TEST(what_is_lost_or_begins_anew_is_no_lag) {
  Stream stream;
  const auto next = [&](TimeUs passed_us, unsigned steps) {
    assert_false(stream.is_late(passed_us, steps));
  };
  repeat(20, [&] { next(3 * kCycleUs, 3); });  // two of three are lost
  repeat(6, [&] { next(2 * kCycleUs, 1); });   // it leaves out six cycles
  next(50'000, 1);                             // a pause, after which it synchronises
  next(kCycleUs, 1);
  next(kCycleUs, 1);
  repeat(6, [&] { next(2 * kCycleUs, 1); });
  assert_int_equal(stream.receiver.link(Stream::Message::kId).wrong_counter, 0);
}

// A queue that is worked off is fresh again; one that falls silent is no longer late but missing.
TEST(lag_ends_with_the_queue_or_in_silence) {
  Stream stream;
  repeat(6, [&] { assert_false(stream.is_late(2 * kCycleUs, 1)); });
  assert_true(stream.is_late(2 * kCycleUs, 1));
  assert_true(stream.receiver.message_faults(stream.now + 40'000).has(Fault::kStreamLate));
  assert_false(stream.receiver.message_faults(stream.now + 40'001).has(Fault::kStreamLate));
  assert_false(stream.is_late(kCycleUs, 3));
  assert_int_equal(stream.receiver.link(Stream::Message::kId).wrong_counter, 1);
}

// Whatever a controller of the kind sends.
TEST_FOR_EACH(own_ids_are_another_controllers, Bus, ExcavatorBus, DozerBus) {
  for (const std::uint32_t id : Bus::Transmitter::ids()) {
    typename Bus::Receiver receiver;
    CanFrame frame;
    frame.id = id;
    frame.length = 8;
    receiver.accept(frame, kFirstFrameUs);
    assert_true(receiver.message_faults(kFirstFrameUs).has(Fault::kSecondController));
    assert_true(receiver.message_faults(kFirstFrameUs + 1'200'000).has(Fault::kSecondController));
    assert_true(receiver.message_faults(kFirstFrameUs + 1'200'001).empty());
    assert_int_equal(rejected(receiver.total()), 1);
    assert_int_equal(receiver.foreign(), 0);
    assert_int_equal(receiver.link(id).accepted, 0);
    assert_int_equal(receiver.link_check(id, kFirstFrameUs), E2eCheck::kNoNewData);
  }
}

// Others' frames are not, nor what asks for ours.
TEST(other_ids_are_no_controllers, DozerReceiver receiver) {
  CanFrame frame;
  frame.length = 8;
  frame.id = dbc::dozer::SpoolCommand::kId + 1;
  receiver.accept(frame, kFirstFrameUs);
  assert_int_equal(receiver.foreign(), 1);
  frame.id = dbc::dozer::SpoolCommand::kId;
  frame.remote = true;
  receiver.accept(frame, kFirstFrameUs);
  assert_true(receiver.message_faults(kFirstFrameUs).empty());
  assert_int_equal(receiver.total().wrong_kind, 1);
}
