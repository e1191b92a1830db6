// SPDX-License-Identifier: Apache-2.0
// Nodes of CANopen that a table names: who is started, whose messages count.

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/table_bus.hpp"

using namespace graben::test;

constexpr std::uint8_t kNode = 0x0B;
constexpr std::uint32_t kPosition = 0x18B;

/// An encoder on the boom's cylinder, node 11 on the second bus.
BusTable encoder() {
  BusTable made;
  made.own_frames = true;
  made.node_count = 1;
  made.node[0] = {kNode, 1, 250 * kMillisecondUs};
  made.message_count = 1;
  made.rule[0].id = kPosition;
  made.rule[0].extended = false;
  made.rule[0].length = 4;
  made.message[0].bus = 1;
  made.message[0].node = 0;
  made.message[0].period_us = kPeriod;
  made.message[0].timeout_us = 35 * kMillisecondUs;
  made.message[0].count = 1;
  made.source_count = 1;
  made.source[0] = {{0, 32, false, false}, SourcePlace::kStroke, 0, false, 1e-5, 0.0, 0.0, 3.0};
  return made;
}

struct Bus {
  BusTable table = encoder();
  ExcavatorReceiver receiver{with_table({}, &table)};
  TimeUs now = kNow;

  void take(std::uint32_t id, std::uint8_t length, const dbc::Payload& data, std::uint8_t on = 1) {
    CanFrame frame;
    frame.id = id;
    frame.extended = false;
    frame.length = length;
    frame.data = data;
    frame.bus = on;
    receiver.accept(frame, now);
  }
  void says(std::uint8_t state, std::uint8_t on = 1) { take(0x700 + kNode, 1, {state}, on); }
  /// 0.3 m.
  void position() { take(kPosition, 4, {0x30, 0x75, 0x00, 0x00}); }
  void pass(TimeUs time = kPeriod) {
    receiver.finish(now);
    now += time;
  }
  /// What its position counts as in the next cycle.
  Validity seen() {
    position();
    pass();
    return stroke().validity;
  }
  [[nodiscard]] const Signal<double>& stroke() const { return receiver.inputs().axis[0].stroke_m; }
};

/// EAO series 09 keypad manual, boot-up sequence: 70B 00, 70B 7F, 000 01 0B, 70B 05.
TEST(a_node_is_started_as_printed, Bus bus) {
  bus.says(0x00);
  bus.pass();
  const NodeStart start = bus.receiver.take_start(bus.now);
  assert_int_equal(start.id, 0x0B);
  ExcavatorTransmitter transmitter{with_table({}, &bus.table)};
  transmitter.start_node(start);
  ExcavatorTransmitter::Frames frames;
  const int count = transmitter.frames({}, {}, bus.now, frames);
  const CanFrame* sent = nullptr;
  for (int i = 0; i < count; ++i) {
    const CanFrame& frame = frames[static_cast<unsigned>(i)];
    sent = !frame.extended ? &frame : sent;
  }
  assert_non_null(sent);
  assert_int_equal(sent->id, 0);
  assert_int_equal(sent->length, 2);
  assert_int_equal(sent->data[0], 0x01);
  assert_int_equal(sent->data[1], 0x0B);
  assert_int_equal(sent->bus, 1);
  // Once only.
  assert_int_equal(bus.receiver.take_start(bus.now).id, 0);
}

TEST(a_node_that_sleeps_on_is_told_again, Bus bus) {
  int told = 0;
  for (int cycle = 0; cycle < 40; ++cycle) {
    if (cycle % 10 == 0) {
      bus.says(0x7F);
    }
    told += bus.receiver.take_start(bus.now).id != 0 ? 1 : 0;
    bus.pass();
  }
  assert_int_equal(told, 4);
  bus.says(0x05);
  bus.pass(kSecondUs);
  assert_int_equal(bus.receiver.take_start(bus.now).id, 0);
}

TEST(only_an_operational_nodes_values_count, Bus bus) {
  assert_true(bus.seen() == Validity::kNotReceived);
  bus.says(0x7F);
  assert_true(bus.seen() == Validity::kNotReceived);
  bus.says(0x05);
  assert_true(bus.seen() == Validity::kValid);
  assert_near(bus.stroke().value, 0.3, 1e-12);
}

TEST(a_node_that_reboots_is_no_source) {
  for (const std::uint8_t state : {std::uint8_t{0x00}, std::uint8_t{0x7F}, std::uint8_t{0x04}}) {
    Bus bus;
    bus.says(0x05);
    bus.seen();
    bus.says(state);
    assert_true(bus.seen() == Validity::kNotAvailable);
    assert_int_equal(bus.receiver.take_start(bus.now).id, kNode);
    bus.says(0x05);
    assert_true(bus.seen() == Validity::kValid);
  }
}

TEST(a_heartbeat_that_is_lost, Bus bus) {
  bus.says(0x05);
  for (int cycle = 0; cycle <= 25; ++cycle) {
    assert_true(bus.seen() == Validity::kValid);
  }
  assert_true(bus.seen() == Validity::kNotAvailable);
}

/// CiA 301: bytes 0 and 1 the code, 2 the error register. Its values go on, and do not count.
TEST(an_emergency_makes_values_errors, Bus bus) {
  bus.says(0x05);
  bus.seen();
  bus.take(0x080 + kNode, 8, {0x10, 0x50, 0x01});
  assert_true(bus.seen() == Validity::kError);
  assert_int_equal(bus.receiver.emergency().id, kNode);
  assert_int_equal(bus.receiver.emergency().code, 0x5010);
  bus.says(0x05);  // Its heartbeat is as always.
  assert_true(bus.seen() == Validity::kError);
  bus.take(0x080 + kNode, 8, {});
  assert_true(bus.seen() == Validity::kValid);
  assert_int_equal(bus.receiver.emergency().id, 0);
}

TEST(a_node_that_boots_tells_its_emergency_anew, Bus bus) {
  bus.says(0x05);
  bus.take(0x080 + kNode, 8, {0x00, 0x10, 0x01});
  bus.says(0x7F);
  assert_int_equal(bus.receiver.emergency().code, 0x1000);
  bus.says(0x00);
  assert_int_equal(bus.receiver.emergency().code, 0);
}

TEST(what_is_no_emergency, Bus bus) {
  bus.says(0x05);
  bus.take(0x080 + kNode, 8, {0x10, 0x50, 0x01}, 0);  // On the other bus.
  bus.take(0x080 + kNode, 7, {0x10, 0x50, 0x01});
  bus.take(0x080 + kNode + 1, 8, {0x10, 0x50, 0x01});
  bus.take(0x080, 0, {});  // SYNC.
  assert_true(bus.seen() == Validity::kValid);
  assert_int_equal(bus.receiver.emergency().id, 0);
}

TEST(what_is_no_heartbeat, Bus bus) {
  bus.says(0x05, 0);  // On the other bus.
  bus.take(0x700 + kNode, 2, {0x05});
  bus.take(0x700 + kNode + 1, 1, {0x05});
  bus.says(0x85);  // Node guarding's toggle.
  assert_true(bus.seen() == Validity::kNotReceived);
  assert_int_equal(bus.receiver.take_start(bus.now).id, 0);
}

TEST(a_port_lets_heartbeats_and_emergencies_through) {
  const BusTable made = encoder();
  int found = 0;
  for (const std::uint32_t id : table_ids(made)) {
    found += id == (kStandardId | 0x70BU) || id == (kStandardId | 0x08BU) ? 1 : 0;
  }
  assert_int_equal(found, 2);
}

/// Encoders on boom and arm, both node 11, each on its own bus and with a message of its own
/// length.
BusTable two_encoders() {
  BusTable made = encoder();
  made.node_count = 2;
  made.node[1] = {kNode, 0, 250 * kMillisecondUs};
  made.message_count = 2;
  made.rule[1] = made.rule[0];
  made.rule[1].length = 6;
  made.message[1] = made.message[0];
  made.message[1].bus = 0;
  made.message[1].node = 1;
  made.message[1].first = 1;
  made.source_count = 2;
  made.source[1] = made.source[0];
  made.source[1].index = 1;
  return made;
}

TEST(two_nodes_of_one_id_on_two_buses) {
  Bus bus{two_encoders()};
  const auto both = [&] {
    bus.take(kPosition, 4, {0x30, 0x75, 0x00, 0x00}, 1);
    bus.take(kPosition, 6, {0x40, 0x9C, 0x00, 0x00}, 0);
    bus.pass();
  };
  const auto& axis = bus.receiver.inputs().axis;
  bus.says(0x05, 1);
  both();
  assert_true(axis[0].stroke_m.validity == Validity::kValid);
  assert_true(axis[1].stroke_m.validity != Validity::kValid);
  bus.says(0x05, 0);
  both();
  assert_true(axis[1].stroke_m.validity == Validity::kValid);
  assert_near(axis[0].stroke_m.value, 0.3, 1e-9);
  assert_near(axis[1].stroke_m.value, 0.4, 1e-9);
}
