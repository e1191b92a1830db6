// SPDX-License-Identifier: Apache-2.0
// Another bus as a table: bits, what is refused of it and when it is missing, what is sent to it.

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/table_bus.hpp"

using namespace graben::test;

struct Bus {
  BusTable other = table();
  ExcavatorReceiver receiver{with_table({}, &other)};
  TimeUs now = kNow;
  std::uint8_t counter = 0;

  [[nodiscard]] const ExcavatorInputs& inputs() const { return receiver.inputs(); }
  void angle(double rad, std::uint8_t on = kAnyBus) {
    CanFrame frame;
    frame.id = kAngles;
    frame.length = 8;
    frame.bus = on;
    put_raw({0, 16, false, false}, static_cast<std::int64_t>((rad - 10.0) / -0.0004 + 0.5),
            frame.data);
    receiver.accept(frame, now);
  }
  void state(bool locked) {
    CanFrame frame;
    frame.id = kState;
    frame.length = 8;
    frame.data[0] = locked ? 1 : 0;
    frame.data[5] = 1;
    frame.data[7] = counter++;
    receiver.accept(frame, now);
  }
  void state_of_a_period(bool locked) {
    state(locked);
    pass(5 * kPeriod);
  }
  void pass(TimeUs time = kPeriod) {
    receiver.finish(now);
    now += time;
  }
};

/// As many messages and signals as a table may have: the last of each message is a swash or speed.
TEST(a_full_table_is_read_to_its_end) {
  constexpr std::size_t kEach = kMostTableSources / kMostTableReceived;
  BusTable full;
  full.message_count = kMostTableReceived;
  full.source_count = kMostTableSources;
  for (std::size_t i = 0; i < kMostTableReceived; ++i) {
    full.rule[i].id = kAngles + 0x100 * static_cast<std::uint32_t>(i);
    full.rule[i].length = 8;
    full.message[i].period_us = kPeriod;
    full.message[i].timeout_us = 35 * kMillisecondUs;
    full.message[i].first = static_cast<std::uint8_t>(kEach * i);
    full.message[i].count = kEach;
    for (std::size_t n = 0; n < kEach; ++n) {
      TableSource& source = full.source[kEach * i + n];
      source.bits = {static_cast<std::uint8_t>(16 * n), 16, false, false};
      source.place = SourcePlace::kSwash;
      source.index = static_cast<std::uint8_t>(i % 2);
      source.scale = 1e-3;
      source.most = 1.0;
    }
  }
  ExcavatorReceiver receiver{with_table({}, &full)};
  for (std::size_t i = 0; i < kMostTableReceived; ++i) {
    CanFrame frame;
    frame.id = full.rule[i].id;
    frame.length = 8;
    put_raw(full.source[kEach * i + kEach - 1].bits, static_cast<std::int64_t>(10 * i), frame.data);
    receiver.accept(frame, kNow);
    assert_near(receiver.inputs().swash_ratio[i % 2].value, 0.01 * static_cast<double>(i), 1e-9);
  }
  receiver.finish(kNow);
  assert_int_equal(receiver.table().accepted, kMostTableReceived);
  assert_int_equal(receiver.table().out_of_range, 0);
}

TEST(bits_lie_where_a_dbc_says) {
  // Bytes by hand: Intel from the lowest bit on, Motorola from the highest.
  const dbc::Payload data{0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC, 0xDE, 0xF0};
  assert_int_equal(raw_of({0, 16, false, false}, data), 0x3412);
  assert_int_equal(raw_of({4, 8, false, false}, data), 0x41);
  assert_int_equal(raw_of({7, 16, true, false}, data), 0x1234);
  assert_int_equal(raw_of({3, 12, true, false}, data), 0x234);
  assert_int_equal(raw_of({55, 16, true, false}, data), 0xDEF0);
  assert_int_equal(raw_of({32, 32, false, false}, data), 0xF0DEBC9A);
  assert_int_equal(raw_of({56, 8, false, true}, data), -16);
  assert_int_equal(raw_of({55, 8, true, true}, data), 0xDE - 256);
  for (const BitField& field : {BitField{4, 8, false, true}, BitField{3, 12, true, false},
                                BitField{32, 32, false, false}}) {
    dbc::Payload changed = data;
    put_raw(field, 0x2A, changed);
    assert_int_equal(raw_of(field, changed), 0x2A);
    put_raw(field, raw_of(field, data), changed);
    assert_memory_equal(changed.data(), data.data(), data.size());
  }
  assert_true(lies_within({48, 16, false, false}, 8));
  assert_false(lies_within({49, 16, false, false}, 8));
  assert_true(lies_within({55, 16, true, false}, 8));
  assert_false(lies_within({54, 16, true, false}, 8));
  assert_false(lies_within({0, 16, false, false}, 1));
}

TEST(a_value_comes_with_its_scale_and_sign, Bus bus) {
  bus.angle(0.3);
  assert_true(bus.inputs().joint_rad[0].validity == Validity::kValid);
  assert_near(bus.inputs().joint_rad[0].value, 0.3, 2.1e-4);
  assert_int_equal(bus.inputs().joint_rad[0].stamp_us, kNow);
  assert_true(bus.inputs().joint_rad[1].validity == Validity::kNotReceived);
  assert_int_equal(bus.receiver.foreign(), 0);
}

TEST(what_cannot_be_is_refused, Bus bus) {
  bus.angle(0.3);
  bus.pass();
  bus.angle(1.4);  // Beyond its range.
  assert_near(bus.inputs().joint_rad[0].value, 0.3, 2.1e-4);
  assert_true(bus.receiver.take_out_of_range());
  bus.pass();
  bus.angle(0.37);  // 0.07 rad in 20 ms: more than 3 rad/s.
  assert_near(bus.inputs().joint_rad[0].value, 0.3, 2.1e-4);
  bus.pass();
  bus.angle(0.38);  // And 0.08 in 30 ms is not.
  assert_near(bus.inputs().joint_rad[0].value, 0.38, 2.1e-4);
  assert_int_equal(bus.receiver.table().out_of_range, 2);
}

TEST(a_silent_source_is_missing_in_its_own_time, Bus bus) {
  bus.angle(0.3);
  for (int cycle = 0; cycle < 4; ++cycle) {
    bus.pass();
    assert_true(bus.inputs().joint_rad[0].validity == Validity::kValid);
  }
  bus.pass();
  assert_true(bus.inputs().joint_rad[0].validity == Validity::kNotAvailable);
  bus.angle(-1.0);  // As new: no rate is judged.
  assert_near(bus.inputs().joint_rad[0].value, -1.0, 2.1e-4);
}

TEST(two_senders_are_an_error, Bus bus) {
  bus.angle(0.3);
  for (int cycle = 0; cycle < 8; ++cycle) {
    bus.pass();
    bus.angle(0.3);
    assert_true(bus.inputs().joint_rad[0].validity == Validity::kValid);
  }
  Validity worst = Validity::kValid;
  for (int cycle = 0; cycle < 8; ++cycle) {
    bus.pass();
    bus.angle(0.3);
    bus.angle(0.3);
    worst = std::min(worst, bus.inputs().joint_rad[0].validity);
  }
  assert_true(worst == Validity::kError);
}

TEST(another_bus_is_not_meant, Bus bus) {
  bus.angle(0.3, 1);
  assert_true(bus.inputs().joint_rad[0].validity == Validity::kNotReceived);
  bus.angle(0.3, 0);
  assert_true(bus.inputs().joint_rad[0].validity == Validity::kValid);
}

TEST(a_counter_that_stands_still_is_no_news, Bus bus) {
  bus.state_of_a_period(false);  // Only says where it counts from.
  assert_true(bus.inputs().valve_enabled.validity == Validity::kNotAvailable);
  bus.state_of_a_period(false);
  assert_true(bus.inputs().valve_enabled.validity == Validity::kValid);
  assert_true(bus.inputs().valve_enabled.value);
  assert_near(bus.inputs().engine_speed_radps.value, 188.5, 1e-9);
  for (int frame = 0; frame < 3; ++frame) {
    --bus.counter;
    bus.state_of_a_period(false);
  }
  bus.pass();
  assert_true(bus.inputs().valve_enabled.validity == Validity::kNotAvailable);
  assert_true(bus.inputs().engine_speed_radps.validity == Validity::kNotAvailable);
  assert_int_equal(bus.receiver.table().wrong_counter, 4);
}

TEST(a_slow_source_holds_up_to_its_time_out, Bus bus) {
  bus.state_of_a_period(false);
  bus.state(false);
  for (int cycle = 0; cycle <= 16; ++cycle) {
    bus.pass();
    assert_true(bus.inputs().valve_enabled.validity == Validity::kValid);
    assert_int_equal(bus.inputs().valve_enabled.stamp_us, bus.now - kPeriod);
    assert_int_equal(bus.inputs().engine_speed_radps.stamp_us, bus.now - kPeriod);
  }
  bus.pass();
  assert_true(bus.inputs().valve_enabled.validity == Validity::kNotAvailable);
}

TEST(a_condition_that_fails_says_disabled, Bus bus) {
  bus.state_of_a_period(false);
  bus.state(true);
  bus.pass();
  assert_true(bus.inputs().valve_enabled.validity == Validity::kValid);
  assert_false(bus.inputs().valve_enabled.value);
}

TEST(priority_is_the_senders, Bus bus) {
  CanFrame frame;
  frame.id = kState ^ 0x0C000000U;
  frame.length = 8;
  frame.data[5] = 1;
  bus.receiver.accept(frame, bus.now);
  bus.state_of_a_period(false);
  assert_int_equal(bus.receiver.foreign(), 0);
  assert_int_equal(bus.receiver.table().surplus, 1);
  // What only we send is another controller's at any priority.
  frame.id = kLevers ^ 0x10000000U;
  bus.receiver.accept(frame, bus.now);
  assert_true(bus.receiver.message_faults(bus.now).has(Fault::kSecondController));
}

TEST(source_fe_is_any_sender_unless_one_is_named) {
  BusTable made = table();
  made.rule[0].id = (kAngles & ~0xFFU) | 0xFEU;
  ExcavatorReceiver receiver{with_table({}, &made)};
  CanFrame frame;
  frame.id = (kAngles & ~0xFFU) | 0x21U;
  frame.length = 8;
  put_raw({0, 16, false, false}, 25000, frame.data);
  receiver.accept(frame, kNow);
  assert_true(receiver.inputs().joint_rad[0].validity == Validity::kValid);
  assert_int_equal(receiver.foreign(), 0);
  // Another PGN stays foreign; and the state of a named sender, of the same PGN, is not taken for
  // it.
  frame.id ^= 0x100U;
  receiver.accept(frame, kNow + kPeriod);
  assert_int_equal(receiver.foreign(), 1);
  made.rule[1].id = (kAngles & ~0xFFU) | 0x33U;
  ExcavatorReceiver both{with_table({}, &made)};
  frame.id = made.rule[1].id;
  both.accept(frame, kNow);
  assert_true(both.inputs().joint_rad[0].validity == Validity::kNotReceived);
}

/// 0x18000123 of 29 bits and 0x123 of 11 have the same low 26: two messages, on one bus.
TEST(an_id_of_11_bits_is_none_of_29) {
  for (const bool extended : {true, false}) {
    BusTable made = table();
    made.rule[0].id = extended ? 0x18000123U : 0x123U;
    made.rule[0].extended = extended;
    CanFrame frame;
    frame.length = 8;
    put_raw({0, 16, false, false}, 25000, frame.data);
    const auto hears = [&](BusTable& of, bool long_id) {
      ExcavatorReceiver receiver{with_table({}, &of)};
      frame.extended = long_id;
      frame.id = long_id ? 0x18000123U : 0x123U;
      receiver.accept(frame, kNow);
      const Validity angle = receiver.inputs().joint_rad[0].validity;
      return std::pair(angle == Validity::kValid, static_cast<int>(receiver.foreign()));
    };
    assert_true(hears(made, extended) == std::pair(true, 0));
    assert_true(hears(made, !extended) == std::pair(false, 1));
    // Nor does a message of the one kind stand before that of the other.
    made.rule[1] = made.rule[0];
    made.message[1] = made.message[0];
    made.message[1].first = 1;
    made.rule[0].extended = !extended;
    made.rule[0].id = extended ? 0x123U : 0x18000123U;
    std::swap(made.message[0].first, made.message[1].first);
    std::swap(made.message[0].count, made.message[1].count);
    made.message[1].count = 1;
    assert_true(hears(made, extended) == std::pair(true, 0));
  }
}

TEST(the_machines_own_frames_of_ours_are_foreign, Bus bus) {
  const CanFrame speed{dbc::common::EEC1::kId,      true, false, false, false, 8,
                       dbc::common::EEC1{}.encode()};
  bus.receiver.accept(speed, bus.now);
  assert_int_equal(bus.receiver.foreign(), 1);
}

/// Our own messages as rows of a table: what the generated code takes and refuses, in every frame.
TEST(our_own_bus_as_a_table_is_the_same) {
  using Stroke = dbc::excavator::BoomStroke;
  BusTable made;
  made.own_frames = true;
  made.message_count = made.source_count = 1;
  made.rule[0] = message_rule<Stroke>(nullptr);
  made.message[0].protection = TableProtection::kE2e;
  made.message[0].period_us = kPeriod;
  made.message[0].timeout_us = 100 * kSecondUs;
  made.message[0].count = 1;
  made.source[0] = {{16, 16, false, false},
                    SourcePlace::kStroke,
                    0,
                    false,
                    0.05e-3,
                    0.0,
                    0.0,
                    3.2,
                    0.0,
                    0xFEFF,
                    0xFFFF};
  ExcavatorReceiver by_table{with_table({}, &made)};
  ExcavatorReceiver own;
  std::mt19937 random(3);
  const auto draw = [&random](unsigned below) { return static_cast<unsigned>(random() % below); };
  TimeUs now = kNow;
  std::uint8_t counter = 0;
  int valid = 0;
  int states = 0;
  for (int n = 0; n < 4000; ++n) {
    const unsigned kind = draw(16);
    Stroke stroke{{0.0001 * draw(32000), dbc::RawState::kValid}};
    if (kind == 0) {
      stroke.boom_stroke_m.state =
          draw(2) == 0 ? dbc::RawState::kError : dbc::RawState::kNotAvailable;
    }
    CanFrame frame;
    frame.id = Stroke::kId;
    frame.length = kind == 1 ? 7 : 8;
    frame.extended = kind != 2;
    frame.data = stroke.encode();
    if (kind == 3) {
      frame.data[3] = 0xFC;  // Out of range.
    }
    e2e_protect(frame.data, kind == 4 ? Stroke::kDataId + 1 : Stroke::kDataId, counter);
    if (kind == 5) {
      frame.data[2 + draw(6)] ^= static_cast<std::uint8_t>(1U << draw(8));
    }
    counter = kind == 6 ? counter : e2e_next_counter(counter);
    for (ExcavatorReceiver* each : {&by_table, &own}) {
      each->accept(frame, now);
      each->finish(now);
    }
    const Signal<double>& mine = own.inputs().axis[0].stroke_m;
    const Signal<double>& other = by_table.inputs().axis[0].stroke_m;
    assert_int_equal(mine.validity, other.validity);
    assert_int_equal(mine.stamp_us, other.stamp_us);
    assert_near(mine.value, other.value, 1e-12);
    assert_int_equal(own.total().accepted, by_table.table().accepted);
    assert_int_equal(own.total().out_of_range, by_table.table().out_of_range);
    valid += mine.validity == Validity::kValid;
    states += mine.validity != Validity::kValid;
    now += kPeriod;
  }
  assert_true(valid > 1000 && states > 20);
}

TEST(our_commands_from_another_are_a_second_controller, Bus bus) {
  CanFrame frame;
  frame.id = kLevers;
  frame.length = 8;
  bus.receiver.accept(frame, bus.now);
  assert_true(bus.receiver.message_faults(bus.now).has(Fault::kSecondController));
}
