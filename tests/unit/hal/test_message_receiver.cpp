// SPDX-License-Identifier: Apache-2.0
// Every kind of bad frame is counted and changes nothing, on either bus.

#include "tests/unit/hal/bus_frames.hpp"
#include "tests/unit/hal/seen_inputs.hpp"

using namespace graben::test;

// Gives the frame to the receiver; exactly the expected counter goes up by one, in the message's
// link and in the total, and the inputs stay.
template <class Receiver>
void refuse(Receiver& receiver, const CanFrame& frame, TimeUs now, std::uint32_t id,
            std::uint32_t LinkCounters::*counter) {
  const Seen before = seen_by(receiver);
  LinkCounters link = receiver.link(id);
  LinkCounters total = receiver.total();
  const std::uint32_t foreign = receiver.foreign();
  receiver.accept(frame, now);
  assert_true(seen_by(receiver) == before);
  ++(link.*counter);
  ++(total.*counter);
  const LinkCounters link_after = receiver.link(id);
  assert_memory_equal(&link_after, &link, sizeof link);
  assert_memory_equal(&receiver.total(), &total, sizeof total);
  assert_int_equal(receiver.foreign(), foreign);
}

TEST_FOR_EACH(nothing_received_at_the_start, Bus, ExcavatorBus, DozerBus) {
  const typename Bus::Receiver receiver;
  for (const auto& [value, validity, stamp_us] : seen_by(receiver)) {
    assert_int_equal(validity, Validity::kNotReceived);
  }
  assert_int_equal(receiver.total().accepted, 0);
}

TEST_FOR_EACH(ids_are_those_of_its_messages, Bus, ExcavatorBus, DozerBus) {
  const auto ids = Bus::Receiver::ids();
  int found = 0;
  const auto find = [&](auto type) {
    found += std::count(ids.begin(), ids.end(), decltype(type)::kId) == 1 ? 1 : 0;
  };
  for_each(typename Bus::Protected{}, find);
  for_each(typename Bus::Unprotected{}, find);
  assert_int_equal(found, Bus::Receiver::kMessageCount);
}

TEST_FOR_EACH(wrong_crc, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    typename Bus::Receiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    assert_int_equal(receiver.link(Message::kId).accepted, 1);
    CanFrame frame = frame_of(filled<Message>(2000), 3);
    frame.data[2] ^= 0x10;
    refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_crc);
    assert_int_equal(rejected(receiver.total()), 1);
  });
}

// Another message's data under this id, be it one that we send.
TEST_FOR_EACH(masquerade, Bus, ExcavatorBus, DozerBus) {
  using Stroke = typename Bus::Stroke;
  typename Bus::Receiver receiver;
  const TimeUs now = synchronise<Stroke>(receiver);
  for_each(typename Bus::Other{}, [&](auto type) {
    CanFrame frame = frame_of(filled<decltype(type)>(2000), 3);
    frame.id = Stroke::kId;
    refuse(receiver, frame, now, Stroke::kId, &LinkCounters::masquerade);
  });
  assert_int_equal(rejected(receiver.total()), 4);
  // A data id that nobody has; 0 is what unprotected messages carry.
  for (const std::uint16_t nobodys : {std::uint16_t{0}, std::uint16_t{0x1234}}) {
    CanFrame frame = frame_of(filled<Stroke>(2000), 3);
    e2e_protect(frame.data, nobodys, 3);
    refuse(receiver, frame, now, Stroke::kId, &LinkCounters::wrong_crc);
  }
}

TEST_FOR_EACH(wrong_counter, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    const auto refuse_counter = [](std::uint8_t counter) {
      typename Bus::Receiver receiver;
      const TimeUs now = synchronise<Message>(receiver);
      refuse(receiver, frame_of(filled<Message>(2000), counter), now, Message::kId,
             &LinkCounters::wrong_counter);
    };
    refuse_counter(2);                                                         // repeated
    refuse_counter(static_cast<std::uint8_t>(3 + Message::kMaxDeltaCounter));  // too many lost
    refuse_counter(1);                                                         // late
    refuse_counter(15);                                                        // invalid
  });
}

TEST_FOR_EACH(some_lost_is_accepted, Bus, ExcavatorBus, DozerBus) {
  for_each(typename Bus::Protected{}, [](auto type) {
    using Message = decltype(type);
    typename Bus::Receiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    const auto counter = static_cast<std::uint8_t>(2 + Message::kMaxDeltaCounter);
    receiver.accept(frame_of(filled<Message>(2000), counter), now);
    assert_int_equal(receiver.link(Message::kId).accepted, 2);
    assert_int_equal(receiver.link_check(Message::kId, now), E2eCheck::kSomeLost);
  });
}

TEST_FOR_EACH(silence_needs_three_frames, Bus, ExcavatorBus, DozerBus) {
  using Stroke = typename Bus::Stroke;
  typename Bus::Receiver receiver;
  TimeUs now = synchronise<Stroke>(receiver);
  now += 41 * kMillisecondUs;  // four cycles are the limit
  assert_int_equal(receiver.link_check(Stroke::kId, now), E2eCheck::kNoNewData);
  refuse(receiver, frame_of(filled<Stroke>(2000), 3), now, Stroke::kId,
         &LinkCounters::synchronising);
}

TEST_FOR_EACH(wrong_kind_and_length, Bus, ExcavatorBus, DozerBus) {
  const auto test = [](auto type) {
    using Message = decltype(type);
    typename Bus::Receiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    const CanFrame good = frame_of(filled<Message>(2000), 3);
    for (bool CanFrame::*const flag : {&CanFrame::remote, &CanFrame::fd, &CanFrame::extended}) {
      CanFrame frame = good;
      frame.*flag = !(frame.*flag);
      refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_kind);
    }
    for (const int length : {0, 7, 9, 64}) {
      CanFrame frame = good;
      frame.length = static_cast<std::uint8_t>(length);
      refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_length);
    }
    // None of them has spoilt the link.
    receiver.accept(good, now);
    assert_int_equal(receiver.link(Message::kId).accepted, Message::kProtected ? 2 : 4);
  };
  for_each(typename Bus::Protected{}, test);
  for_each(typename Bus::Unprotected{}, test);
}

TEST_FOR_EACH(error_frame_is_nobodys, Bus, ExcavatorBus, DozerBus) {
  using Stroke = typename Bus::Stroke;
  typename Bus::Receiver receiver;
  const TimeUs now = synchronise<Stroke>(receiver);
  CanFrame frame = frame_of(filled<Stroke>(2000), 3);
  frame.error = true;
  const Seen before = seen_by(receiver);
  receiver.accept(frame, now);
  assert_true(seen_by(receiver) == before);
  assert_int_equal(receiver.total().wrong_kind, 1);
  assert_int_equal(receiver.link(Stroke::kId).wrong_kind, 0);
}

// PGN and source are what a message is known by: the next frame of a sender may have any priority.
TEST_FOR_EACH(priority_is_the_senders, Bus, ExcavatorBus, DozerBus) {
  using Stroke = typename Bus::Stroke;
  typename Bus::Receiver receiver;
  const TimeUs now = synchronise<Stroke>(receiver);
  CanFrame frame = frame_of(filled<Stroke>(2000), 3);
  frame.id ^= 0x18000000U;
  receiver.accept(frame, now);
  assert_int_equal(receiver.foreign(), 0);
  assert_int_equal(receiver.link(Stroke::kId).accepted, 2);
  assert_int_equal(rejected(receiver.total()), 0);
}

TEST_FOR_EACH(foreign_ids_are_counted_apart, Bus, ExcavatorBus, DozerBus) {
  using Stroke = typename Bus::Stroke;
  typename Bus::Receiver receiver;
  const TimeUs now = synchronise<Stroke>(receiver);
  const Seen before = seen_by(receiver);
  const CanFrame good = frame_of(filled<Stroke>(2000), 3);
  std::uint32_t count = 0;
  // Another source address, another PGN, another page.
  for (const std::uint32_t id :
       {Stroke::kId + 1, Stroke::kId ^ 0x00008000U, Stroke::kId ^ 0x01000000U}) {
    CanFrame frame = good;
    frame.id = id;
    receiver.accept(frame, now);
    assert_int_equal(receiver.foreign(), ++count);
    assert_int_equal(receiver.link_check(id, now), E2eCheck::kNoNewData);
  }
  CanFrame low_bits = good;  // an 11-bit id that equals the low bits of ours
  low_bits.extended = false;
  low_bits.id &= 0x7FFU;
  receiver.accept(low_bits, now);
  assert_int_equal(receiver.foreign(), ++count);
  assert_true(seen_by(receiver) == before);
  assert_int_equal(rejected(receiver.total()), 0);
}

// The first raw value above [min|max] that is no special one; 0 where there is none.
std::uint32_t beyond(const dbc::Field& field) {
  const std::uint64_t next = std::uint64_t{field.raw_max} + 1U;
  const bool exists =
      next < std::uint64_t{1} << field.width &&
      dbc::classify(field, static_cast<std::uint32_t>(next)) == dbc::RawState::kOutOfRange;
  return exists ? static_cast<std::uint32_t>(next) : 0U;
}

TEST_FOR_EACH(out_of_range_is_refused_as_a_whole, Bus, ExcavatorBus, DozerBus) {
  int fields = 0;
  const auto test = [&fields](auto type) {
    using Message = decltype(type);
    Message::visit(type, [&fields](const dbc::Field& field, auto&) {
      if (beyond(field) == 0U) {
        return;  // a hash has no range, two bits no value between the last state and 'error'
      }
      ++fields;
      typename Bus::Receiver receiver;
      const TimeUs now = synchronise<Message>(receiver);
      assert_false(receiver.take_out_of_range());
      refuse(receiver, frame_with<Message>(field, beyond(field), 3), now, Message::kId,
             &LinkCounters::out_of_range);
      receiver.accept(frame_of(filled<Message>(2000), 4), now + 1);  // does not hide it
      assert_true(receiver.take_out_of_range());
      assert_false(receiver.take_out_of_range());
    });
  };
  for_each(typename Bus::Protected{}, test);
  for_each(typename Bus::Unprotected{}, test);
  assert_in_range(fields, 15, 50);
}

TEST_FOR_EACH(sender_says_error_or_not_available, Bus, ExcavatorBus, DozerBus) {
  using Command = typename Bus::OperatorCommand;
  typename Bus::Receiver receiver;
  TimeUs now = synchronise<Command>(receiver);
  assert_true(receiver.inputs().driver.enable.value);
  receiver.accept(frame_with<Command>(Command::kEnable, 2, 3), now);
  assert_int_equal(receiver.inputs().driver.enable.validity, Validity::kError);
  assert_false(receiver.inputs().driver.enable.value);
  now += 20'000;
  receiver.accept(frame_with<Command>(Command::kEnable, 3, 4), now);
  assert_int_equal(receiver.inputs().driver.enable.validity, Validity::kNotAvailable);
  assert_int_equal(receiver.inputs().driver.mode.validity, Validity::kValid);
  assert_int_equal(rejected(receiver.total()), 0);
}

/// Who limits the machine from outside: what is not valid of what decides is no word.
TEST_FOR_EACH(a_limit_from_outside, Bus, ExcavatorBus, DozerBus) {
  using Limit = dbc::common::ExternalLimit;
  const struct {
    const dbc::Field* field;
    std::uint32_t raw;
    Validity validity;
    ExternalLevel level;
  } cases[] = {{&Limit::kLevel, 0, Validity::kValid, ExternalLevel::kFree},
               {&Limit::kLevel, 1, Validity::kValid, ExternalLevel::kSlow},
               {&Limit::kLevel, 2, Validity::kValid, ExternalLevel::kStop},
               {&Limit::kLevel, 14, Validity::kError, ExternalLevel::kFree},
               {&Limit::kLevel, 15, Validity::kNotAvailable, ExternalLevel::kFree},
               {&Limit::kSpeedShare, 254, Validity::kError, ExternalLevel::kSlow},
               {&Limit::kSpeedShare, 255, Validity::kNotAvailable, ExternalLevel::kSlow}};
  for (const auto& each : cases) {
    Feed<typename Bus::Receiver> feed;
    Limit limit;
    limit.level = {Limit::Level::kSlow, dbc::RawState::kValid};
    limit.resume = {Limit::Resume::kOn, dbc::RawState::kValid};
    limit.speed_share_ratio = {0.3, dbc::RawState::kValid};
    limit.source = {7, dbc::RawState::kValid};
    dbc::Payload payload = limit.encode();
    dbc::insert(payload, each.field->start_bit, each.field->width, each.raw);
    const TimeUs now = feed.send(Limit::decode(payload));
    const Signal<ExternalWord>& heard = feed.receiver.inputs().external;
    assert_int_equal(heard.validity, each.validity);
    assert_int_equal(heard.stamp_us, now);
    assert_int_equal(heard.value.level, each.level);
    assert_true(heard.value.resumes);
    assert_int_equal(heard.value.source, 7);
    assert_near(heard.value.deadline_s, 0.25, 1e-12);
  }
}

/// What is not said: it holds for 0.25 s, it does not go on by itself, its source is 0. A share
/// counts only where it slows.
TEST_FOR_EACH(what_a_limit_does_not_say, Bus, ExcavatorBus, DozerBus) {
  using Limit = dbc::common::ExternalLimit;
  Feed<typename Bus::Receiver> feed;
  Limit limit;
  limit.level = {Limit::Level::kStop, dbc::RawState::kValid};
  limit.resume = {Limit::Resume::kOn, dbc::RawState::kError};
  limit.speed_share_ratio.state = dbc::RawState::kNotAvailable;
  limit.deadline_s.state = dbc::RawState::kNotAvailable;
  feed.send(limit);
  const Signal<ExternalWord>& heard = feed.receiver.inputs().external;
  assert_int_equal(heard.validity, Validity::kValid);
  assert_false(heard.value.resumes);
  assert_int_equal(heard.value.source, 0);
  assert_near(heard.value.deadline_s, 0.25, 0.0);
}

TEST_FOR_EACH(operator_and_identity, Bus, ExcavatorBus, DozerBus) {
  Feed<typename Bus::Receiver> feed;
  using Command = typename Bus::OperatorCommand;
  Command command;
  command.enable.value = Command::Enable::kOn;
  command.operator_mode.value = Command::OperatorMode::kAutomatic;
  command.task.value = Bus::kTask;
  command.speed_override_ratio.value = 0.5;
  command.task_number.value = 7;
  const TimeUs driver_us = feed.send(command);
  const TimeUs identity_us = feed.send(typename Bus::MachineIdentity{
      {0xDEADBEEFU, dbc::RawState::kValid}, {7U, dbc::RawState::kValid}});
  const OperatorInputs& driver = feed.receiver.inputs().driver;
  assert_signal(driver.enable, 1.0, driver_us);
  assert_signal(driver.mode, 1.0, driver_us);
  assert_signal(driver.task, Bus::kTaskSeen, driver_us);
  assert_signal(driver.speed_override_ratio, 0.5, driver_us);
  assert_signal(driver.task_number, 7.0, driver_us);
  assert_signal(feed.receiver.identity().profile_hash, 3735928559.0, identity_us);
  assert_signal(feed.receiver.identity().dbc_version, 7.0, identity_us);
}

// The other end is what we are if both numbers say so; and as sure as the worse of the two.
TEST_FOR_EACH(same_machine, Bus, ExcavatorBus, DozerBus) {
  constexpr std::uint32_t kOwn = 0xDEADBEEFU;
  constexpr std::uint8_t kVersion = Bus::kDbcVersion;
  typename Bus::Receiver receiver;
  assert_int_equal(receiver.same_machine(kOwn).validity, Validity::kNotReceived);
  assert_false(receiver.same_machine(kOwn).value);
  const auto told = [&](std::uint32_t hash, dbc::Count dbc_version) {
    typename Bus::MachineIdentity message;
    message.profile_hash.value = hash;
    message.dbc_version = dbc_version;
    receiver.accept(frame_of(message, 0), kFirstFrameUs);
    return receiver.same_machine(kOwn);
  };
  assert_true(told(kOwn, {kVersion, dbc::RawState::kValid}).value);
  assert_int_equal(receiver.same_machine(kOwn).stamp_us, kFirstFrameUs);
  assert_false(told(kOwn, {kVersion + 1U, dbc::RawState::kValid}).value);
  assert_false(told(kOwn + 1U, {kVersion, dbc::RawState::kValid}).value);
  assert_int_equal(told(kOwn, {kVersion, dbc::RawState::kNotAvailable}).validity,
                   Validity::kNotAvailable);
}

TEST(rejected_sum_saturates, LinkCounters counters) {
  counters.wrong_crc = UINT32_MAX;
  assert_int_equal(rejected(counters), UINT32_MAX);
  counters.wrong_length = 1;
  assert_int_equal(rejected(counters), UINT32_MAX);
}
