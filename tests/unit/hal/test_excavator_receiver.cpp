// Good frames reach the inputs; every kind of bad frame is counted and changes nothing.

#include "hal/excavator_receiver.hpp"

#include <cstring>

#include "tests/unit/hal/bus_frames.hpp"

namespace {

using namespace graben;
using namespace graben::test;
namespace bus = dbc::excavator;
using dbc::RawState;

bool same(const ExcavatorReceiver& receiver, const ExcavatorReceiver::Received& before) {
  const ExcavatorInputs& a = receiver.inputs();
  const ExcavatorInputs& b = before.inputs;
  const auto equal = [](const auto& x, const auto& y) {
    return x.value == y.value && x.validity == y.validity && x.stamp_us == y.stamp_us;
  };
  bool all = equal(a.engine_speed_radps, b.engine_speed_radps) &&
             equal(a.swash_ratio[0], b.swash_ratio[0]) &&
             equal(a.swash_ratio[1], b.swash_ratio[1]) && equal(a.driver.enable, b.driver.enable) &&
             equal(a.driver.mode, b.driver.mode) && equal(a.driver.task, b.driver.task) &&
             equal(a.driver.speed_override_ratio, b.driver.speed_override_ratio) &&
             equal(a.valve_enabled, b.valve_enabled) &&
             equal(receiver.identity().profile_hash, before.identity.profile_hash) &&
             equal(receiver.identity().dbc_version, before.identity.dbc_version);
  for (std::size_t i = 0; i < a.axis.size(); ++i) {
    all = all && equal(a.axis[i].stroke_m, b.axis[i].stroke_m) &&
          equal(a.axis[i].cap_pressure_pa, b.axis[i].cap_pressure_pa) &&
          equal(a.axis[i].rod_pressure_pa, b.axis[i].rod_pressure_pa) &&
          equal(a.axis[i].spool_ratio, b.axis[i].spool_ratio);
  }
  return all;
}

// Gives the frame to the receiver; exactly the expected counter goes up by one, in the message's
// link and in the total, and the inputs stay.
void refuse(ExcavatorReceiver& receiver, const CanFrame& frame, TimeUs now, std::uint32_t id,
            std::uint32_t LinkCounters::*counter) {
  const ExcavatorReceiver::Received before{receiver.inputs(), receiver.identity()};
  LinkCounters link = receiver.link(id);
  LinkCounters total = receiver.total();
  const std::uint32_t foreign = receiver.foreign();
  receiver.accept(frame, now);
  assert_true(same(receiver, before));
  ++(link.*counter);
  ++(total.*counter);
  const LinkCounters link_after = receiver.link(id);
  assert_memory_equal(&link_after, &link, sizeof link);
  assert_memory_equal(&receiver.total(), &total, sizeof total);
  assert_int_equal(receiver.foreign(), foreign);
}

void nothing_received_at_the_start(void**) {
  const ExcavatorReceiver receiver;
  assert_int_equal(receiver.inputs().axis[0].stroke_m.validity, Validity::kNotReceived);
  assert_int_equal(receiver.inputs().driver.enable.validity, Validity::kNotReceived);
  assert_int_equal(receiver.total().accepted, 0);
}

template <class T>
void assert_signal(const Signal<T>& signal, double value, TimeUs stamp_us) {
  assert_int_equal(signal.validity, Validity::kValid);
  assert_near(static_cast<double>(signal.value), value, 1e-9 * std::fabs(value));
  assert_int_equal(signal.stamp_us, stamp_us);
}

void every_signal_has_its_place(void**) {
  ExcavatorReceiver receiver;
  TimeUs stamp_us[11] = {};
  const auto send = [&](auto message, int index) {
    using Message = decltype(message);
    for (std::uint8_t counter = 0; counter < 3; ++counter) {
      stamp_us[index] = kStartUs + index + counter * Message::kCycleTimeMs * kMillisecondUs;
      receiver.accept(frame_of(message, counter), stamp_us[index]);
    }
  };
  send(bus::BoomStroke{{1.1, RawState::kValid}}, 0);
  send(bus::ArmStroke{{1.2, RawState::kValid}}, 1);
  send(bus::BucketStroke{{1.3, RawState::kValid}}, 2);
  send(bus::BoomPressure{{11e6, RawState::kValid}, {12e6, RawState::kValid}}, 3);
  send(bus::ArmPressure{{13e6, RawState::kValid}, {14e6, RawState::kValid}}, 4);
  send(bus::BucketPressure{{15e6, RawState::kValid}, {16e6, RawState::kValid}}, 5);
  send(bus::PumpState{{0.25, RawState::kValid}, {0.75, RawState::kValid}}, 6);
  send(bus::EEC1::decode({0xFF, 0xFF, 0xFF, 0x80, 0x3E, 0xFF, 0xFF, 0xFF}), 7);
  bus::OperatorCommand command;
  command.enable.value = bus::OperatorCommand::Enable::kOn;
  command.operator_mode.value = bus::OperatorCommand::OperatorMode::kAutomatic;
  command.task.value = bus::OperatorCommand::Task::kDig;
  command.speed_override_ratio.value = 0.5;
  send(command, 8);
  send(bus::MachineIdentity{{0xDEADBEEFU, RawState::kValid}, {7U, RawState::kValid}}, 9);

  bus::ValveState valve;
  valve.enabled = {bus::ValveState::Enabled::kOn, RawState::kValid};
  valve.boom_spool_ratio = {0.25, RawState::kValid};
  valve.arm_spool_ratio = {-0.5, RawState::kValid};
  valve.bucket_spool_ratio = {1.0, RawState::kValid};
  send(valve, 10);

  const ExcavatorInputs& in = receiver.inputs();
  assert_signal(in.axis[0].spool_ratio, 0.25, stamp_us[10]);
  assert_signal(in.axis[1].spool_ratio, -0.5, stamp_us[10]);
  assert_signal(in.axis[2].spool_ratio, 1.0, stamp_us[10]);
  assert_signal(in.valve_enabled, 1.0, stamp_us[10]);
  assert_signal(in.axis[0].stroke_m, 1.1, stamp_us[0]);
  assert_signal(in.axis[1].stroke_m, 1.2, stamp_us[1]);
  assert_signal(in.axis[2].stroke_m, 1.3, stamp_us[2]);
  assert_signal(in.axis[0].cap_pressure_pa, 11e6, stamp_us[3]);
  assert_signal(in.axis[0].rod_pressure_pa, 12e6, stamp_us[3]);
  assert_signal(in.axis[1].cap_pressure_pa, 13e6, stamp_us[4]);
  assert_signal(in.axis[1].rod_pressure_pa, 14e6, stamp_us[4]);
  assert_signal(in.axis[2].cap_pressure_pa, 15e6, stamp_us[5]);
  assert_signal(in.axis[2].rod_pressure_pa, 16e6, stamp_us[5]);
  assert_signal(in.swash_ratio[0], 0.25, stamp_us[6]);
  assert_signal(in.swash_ratio[1], 0.75, stamp_us[6]);
  assert_signal(in.engine_speed_radps, 2000.0 * 2.0 * 3.14159265358979323846 / 60.0, stamp_us[7]);
  assert_signal(in.driver.enable, 1.0, stamp_us[8]);
  assert_signal(in.driver.mode, 1.0, stamp_us[8]);
  assert_signal(in.driver.task, 1.0, stamp_us[8]);
  assert_signal(in.driver.speed_override_ratio, 0.5, stamp_us[8]);
  assert_signal(receiver.identity().profile_hash, 3735928559.0, stamp_us[9]);
  assert_signal(receiver.identity().dbc_version, 7.0, stamp_us[9]);
  assert_int_equal(receiver.total().accepted, 9 + 2 * 3);
  assert_int_equal(receiver.total().synchronising, 9 * 2);
  assert_int_equal(rejected(receiver.total()), 0);
}

void wrong_crc(void**) {
  for_each(Protected{}, [](auto type) {
    using Message = decltype(type);
    ExcavatorReceiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    assert_int_equal(receiver.link(Message::kId).accepted, 1);
    CanFrame frame = frame_of(filled<Message>(2000), 3);
    frame.data[2] ^= 0x10;
    refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_crc);
    assert_int_equal(rejected(receiver.total()), 1);
  });
}

// Another message's data under this id, be it one that we send.
void masquerade(void**) {
  ExcavatorReceiver receiver;
  const TimeUs now = synchronise<bus::BoomStroke>(receiver);
  for_each(List<bus::ArmStroke, bus::ValveState, bus::SpoolCommand, bus::PumpCommand>{},
           [&](auto type) {
             CanFrame frame = frame_of(filled<decltype(type)>(2000), 3);
             frame.id = bus::BoomStroke::kId;
             refuse(receiver, frame, now, bus::BoomStroke::kId, &LinkCounters::masquerade);
           });
  assert_int_equal(rejected(receiver.total()), 4);
  // A data id that nobody has; 0 is what unprotected messages carry.
  for (const std::uint16_t nobodys : {std::uint16_t{0}, std::uint16_t{0x1234}}) {
    CanFrame frame = frame_of(filled<bus::BoomStroke>(2000), 3);
    e2e_protect(frame.data, nobodys, 3);
    refuse(receiver, frame, now, bus::BoomStroke::kId, &LinkCounters::wrong_crc);
  }
}

void wrong_counter(void**) {
  for_each(Protected{}, [](auto type) {
    using Message = decltype(type);
    const auto refuse_counter = [](std::uint8_t counter) {
      ExcavatorReceiver receiver;
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

void some_lost_is_accepted(void**) {
  for_each(Protected{}, [](auto type) {
    using Message = decltype(type);
    ExcavatorReceiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    const auto counter = static_cast<std::uint8_t>(2 + Message::kMaxDeltaCounter);
    receiver.accept(frame_of(filled<Message>(2000), counter), now);
    assert_int_equal(receiver.link(Message::kId).accepted, 2);
    assert_int_equal(receiver.link_check(Message::kId, now), E2eCheck::kSomeLost);
  });
}

void silence_needs_three_frames(void**) {
  ExcavatorReceiver receiver;
  TimeUs now = synchronise<bus::BoomStroke>(receiver);
  now += 41 * kMillisecondUs;  // four cycles are the limit
  assert_int_equal(receiver.link_check(bus::BoomStroke::kId, now), E2eCheck::kNoNewData);
  refuse(receiver, frame_of(filled<bus::BoomStroke>(2000), 3), now, bus::BoomStroke::kId,
         &LinkCounters::synchronising);
}

void wrong_kind_and_length(void**) {
  const auto test = [](auto type) {
    using Message = decltype(type);
    ExcavatorReceiver receiver;
    const TimeUs now = synchronise<Message>(receiver);
    const CanFrame good = frame_of(filled<Message>(2000), 3);
    CanFrame frame = good;
    frame.remote = true;
    refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_kind);
    frame = good;
    frame.fd = true;
    refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_kind);
    frame = good;
    frame.extended = false;
    refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_kind);
    for (const int length : {0, 7, 9, 64}) {
      frame = good;
      frame.length = static_cast<std::uint8_t>(length);
      refuse(receiver, frame, now, Message::kId, &LinkCounters::wrong_length);
    }
    // None of them has spoilt the link.
    receiver.accept(good, now);
    assert_int_equal(receiver.link(Message::kId).accepted, Message::kProtected ? 2 : 4);
  };
  for_each(Protected{}, test);
  for_each(Unprotected{}, test);
}

void error_frame_is_nobodys(void**) {
  ExcavatorReceiver receiver;
  const TimeUs now = synchronise<bus::BoomStroke>(receiver);
  CanFrame frame = frame_of(filled<bus::BoomStroke>(2000), 3);
  frame.error = true;
  const ExcavatorReceiver::Received before{receiver.inputs(), receiver.identity()};
  receiver.accept(frame, now);
  assert_true(same(receiver, before));
  assert_int_equal(receiver.total().wrong_kind, 1);
  assert_int_equal(receiver.link(bus::BoomStroke::kId).wrong_kind, 0);
}

void foreign_ids_are_counted_apart(void**) {
  ExcavatorReceiver receiver;
  const TimeUs now = synchronise<bus::BoomStroke>(receiver);
  const ExcavatorReceiver::Received before{receiver.inputs(), receiver.identity()};
  const CanFrame good = frame_of(filled<bus::BoomStroke>(2000), 3);
  std::uint32_t count = 0;
  // Our own commands, another source address, another priority, another page.
  for (const std::uint32_t id :
       {bus::SpoolCommand::kId, bus::BoomStroke::kId + 1, bus::BoomStroke::kId ^ 0x10000000U,
        bus::BoomStroke::kId ^ 0x01000000U}) {
    CanFrame frame = good;
    frame.id = id;
    receiver.accept(frame, now);
    assert_int_equal(receiver.foreign(), ++count);
  }
  CanFrame low_bits = good;  // an 11-bit id that equals the low bits of ours
  low_bits.extended = false;
  low_bits.id &= 0x7FFU;
  receiver.accept(low_bits, now);
  assert_int_equal(receiver.foreign(), ++count);
  assert_true(same(receiver, before));
  assert_int_equal(rejected(receiver.total()), 0);
}

// A protected or plain frame whose field carries `raw`.
template <class Message>
CanFrame frame_with(const dbc::Field& field, std::uint32_t raw, std::uint8_t counter) {
  CanFrame frame = frame_of(filled<Message>(2000), counter);
  dbc::insert(frame.data, field.start_bit, field.width, raw);
  if (Message::kProtected) {
    e2e_protect(frame.data, Message::kDataId, counter);
  }
  return frame;
}

void out_of_range_is_refused_as_a_whole(void**) {
  const auto test = [](auto type) {
    using Message = decltype(type);
    Message::visit(type, [](const dbc::Field& field, auto&) {
      if (field.width == 32) {
        return;  // a hash has no range
      }
      ExcavatorReceiver receiver;
      const TimeUs now = synchronise<Message>(receiver);
      assert_false(receiver.take_out_of_range());
      const std::uint32_t beyond = field.width == 16 ? 0xFBFFU : field.raw_max + 1U;
      if (field.width == 2) {
        return;  // two bits have no value between the last state and 'error'
      }
      refuse(receiver, frame_with<Message>(field, beyond, 3), now, Message::kId,
             &LinkCounters::out_of_range);
      receiver.accept(frame_of(filled<Message>(2000), 4), now + 1);  // does not hide it
      assert_true(receiver.take_out_of_range());
      assert_false(receiver.take_out_of_range());
    });
  };
  for_each(Protected{}, test);
  for_each(Unprotected{}, test);
}

void sender_says_error_or_not_available(void**) {
  ExcavatorReceiver receiver;
  TimeUs now = synchronise<bus::BoomPressure>(receiver);
  const AxisInputs& axis = receiver.inputs().axis[0];
  now += 10'000;
  receiver.accept(frame_with<bus::BoomPressure>(bus::BoomPressure::kBoomCapPressure, 0xFE12, 3),
                  now);
  assert_int_equal(axis.cap_pressure_pa.validity, Validity::kError);
  assert_near(axis.cap_pressure_pa.value, 0.0, 0.0);
  assert_int_equal(axis.cap_pressure_pa.stamp_us, now);
  assert_int_equal(axis.rod_pressure_pa.validity, Validity::kValid);
  assert_near(axis.rod_pressure_pa.value, 2e6, 1e-6);
  now += 10'000;
  receiver.accept(frame_with<bus::BoomPressure>(bus::BoomPressure::kBoomCapPressure, 0xFF00, 4),
                  now);
  assert_int_equal(axis.cap_pressure_pa.validity, Validity::kNotAvailable);
  assert_int_equal(axis.cap_pressure_pa.stamp_us, now);
  assert_int_equal(rejected(receiver.total()), 0);

  now = synchronise<bus::OperatorCommand>(receiver);
  assert_true(receiver.inputs().driver.enable.value);
  receiver.accept(frame_with<bus::OperatorCommand>(bus::OperatorCommand::kEnable, 2, 3), now);
  assert_int_equal(receiver.inputs().driver.enable.validity, Validity::kError);
  assert_false(receiver.inputs().driver.enable.value);
  now += 20'000;
  receiver.accept(frame_with<bus::OperatorCommand>(bus::OperatorCommand::kEnable, 3, 4), now);
  assert_int_equal(receiver.inputs().driver.enable.validity, Validity::kNotAvailable);
}

void rejected_sum_saturates(void**) {
  LinkCounters counters;
  counters.wrong_crc = UINT32_MAX;
  assert_int_equal(rejected(counters), UINT32_MAX);
  counters.wrong_length = 1;
  assert_int_equal(rejected(counters), UINT32_MAX);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(nothing_received_at_the_start),
      cmocka_unit_test(every_signal_has_its_place),
      cmocka_unit_test(wrong_crc),
      cmocka_unit_test(masquerade),
      cmocka_unit_test(wrong_counter),
      cmocka_unit_test(some_lost_is_accepted),
      cmocka_unit_test(silence_needs_three_frames),
      cmocka_unit_test(wrong_kind_and_length),
      cmocka_unit_test(error_frame_is_nobodys),
      cmocka_unit_test(foreign_ids_are_counted_apart),
      cmocka_unit_test(out_of_range_is_refused_as_a_whole),
      cmocka_unit_test(sender_says_error_or_not_available),
      cmocka_unit_test(rejected_sum_saturates),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
