// SPDX-License-Identifier: Apache-2.0
// Order, overflow, the tap, faults that a test plays.

#include "platform/loopback/loopback_bus.hpp"

#include <array>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"

CanFrame frame(std::uint32_t id) {
  CanFrame result;
  result.id = id;
  result.length = 8;
  return result;
}

std::vector<std::uint32_t> drain(LoopbackPort& port) {
  std::array<CanFrame, 64> frames;
  const int count = port.receive(frames.data(), static_cast<int>(frames.size()));
  std::vector<std::uint32_t> ids;
  ids.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    ids.push_back(frames[static_cast<std::size_t>(i)].id);
  }
  return ids;
}

LoopbackPort& opened(LoopbackBus& bus, std::size_t capacity = LoopbackBus::kQueueCapacity) {
  LoopbackPort& port = bus.attach(capacity);
  assert_true(port.open());
  return port;
}

using Ids = std::vector<std::uint32_t>;

TEST(everyone_else_receives_in_order) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  LoopbackPort& c = opened(bus);
  assert_true(a.send(frame(3)));
  assert_true(b.send(frame(1)));
  assert_true(a.send(frame(2)));
  assert_true(drain(a) == (Ids{1}));
  assert_true(drain(b) == (Ids{3, 2}));
  assert_true(drain(c) == (Ids{3, 1, 2}));
  assert_true(drain(c).empty());
}

TEST(receive_is_bounded) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  for (std::uint32_t id = 0; id < 5; ++id) {
    assert_true(a.send(frame(id)));
  }
  std::array<CanFrame, 3> frames;
  assert_int_equal(b.receive(frames.data(), 3), 3);
  assert_int_equal(frames[2].id, 2);
  assert_int_equal(b.receive(frames.data(), 3), 2);
  assert_int_equal(frames[1].id, 4);
  assert_int_equal(b.receive(frames.data(), 0), 0);
}

TEST(overflow_is_counted_and_keeps_the_oldest) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& small = opened(bus, 2);
  LoopbackPort& large = opened(bus);
  for (std::uint32_t id = 0; id < 5; ++id) {
    assert_true(a.send(frame(id)));
  }
  assert_int_equal(small.overflow_count(), 3);
  assert_int_equal(large.overflow_count(), 0);
  assert_true(drain(small) == (Ids{0, 1}));
  assert_true(drain(large) == (Ids{0, 1, 2, 3, 4}));
}

TEST(tap_sees_each_frame_with_its_time) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  std::vector<CanFrame> seen;
  bus.set_tap([&seen](const CanFrame& f) { seen.push_back(f); });
  bus.set_time(10'000);
  assert_true(a.send(frame(1)));
  bus.set_time(20'000);
  assert_true(b.send(frame(2)));
  bus.inject(frame(3));
  assert_int_equal(seen.size(), 3);
  assert_int_equal(seen[0].stamp_us, 10'000);
  assert_int_equal(seen[1].stamp_us, 20'000);
  assert_int_equal(seen[2].id, 3);
  CanFrame received;
  assert_int_equal(b.receive(&received, 1), 1);
  assert_int_equal(received.stamp_us, 10'000);
}

TEST(hook_drops_and_alters) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  Ids tapped;
  bus.set_tap([&tapped](const CanFrame& f) { tapped.push_back(f.id); });
  const LoopbackPort* sender = nullptr;
  bus.set_fault_hook([&sender](CanFrame& f, const LoopbackPort* from) {
    sender = from;
    f.data[0] = 0xAA;
    return f.id != 2;
  });
  assert_true(a.send(frame(1)));
  assert_ptr_equal(sender, &a);
  assert_true(a.send(frame(2)));  // the sender cannot know
  bus.inject(frame(3));
  assert_null(sender);
  assert_true(tapped == (Ids{1, 3}));
  CanFrame received;
  assert_int_equal(b.receive(&received, 1), 1);
  assert_int_equal(received.data[0], 0xAA);
  assert_true(drain(b) == (Ids{3}));
  assert_true(drain(a) == (Ids{3}));  // an injected frame is nobody's own
}

TEST(a_port_off_the_bus_is_deaf_and_mute) {
  for (const CanPortState off :
       {CanPortState::kClosed, CanPortState::kBusOff, CanPortState::kDown}) {
    LoopbackBus bus;
    LoopbackPort& a = opened(bus);
    LoopbackPort& b = opened(bus);
    assert_true(a.send(frame(1)));
    b.set_state(off);
    assert_int_equal(b.state(), off);
    assert_true(a.send(frame(2)));
    assert_true(drain(b).empty());
    assert_false(b.send(frame(3)));
    assert_true(drain(a).empty());
    if (off == CanPortState::kDown) {
      assert_false(b.open());
      b.set_state(CanPortState::kClosed);
    }
    // Whatever was queued before is stale.
    assert_true(b.open());
    assert_true(drain(b).empty());
    assert_true(a.send(frame(4)));
    assert_true(drain(b) == (Ids{4}));
  }
}

TEST(a_new_port_is_closed_and_error_passive_works) {
  LoopbackBus bus;
  LoopbackPort& a = bus.attach();
  LoopbackPort& b = opened(bus);
  assert_int_equal(a.state(), CanPortState::kClosed);
  assert_false(a.send(frame(1)));
  assert_true(a.open());
  a.set_state(CanPortState::kErrorPassive);
  assert_true(a.send(frame(2)));
  assert_true(b.send(frame(3)));
  assert_true(drain(a) == (Ids{3}));
  assert_true(drain(b) == (Ids{2}));
}

TEST(a_full_transmit_queue_sends_nothing) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  a.set_send_fails(true);
  assert_false(a.send(frame(1)));
  assert_true(b.send(frame(2)));
  assert_int_equal(a.state(), CanPortState::kActive);
  a.set_send_fails(false);
  assert_true(a.send(frame(3)));
  assert_true(drain(a) == (Ids{2}));
  assert_true(drain(b) == (Ids{3}));
}

TEST(babble_keeps_lower_priority_off) {
  LoopbackBus bus;
  LoopbackPort& a = opened(bus);
  LoopbackPort& b = opened(bus);
  bus.set_babble(0x0CFF3000);
  assert_true(a.send(frame(0x0CFF2FFF)));
  assert_true(a.send(frame(0x0CFF3000)));
  assert_false(a.send(frame(0x0CFF3001)));
  CanFrame standard = frame(0x33F);
  standard.extended = false;
  assert_true(a.send(standard));
  standard.id = 0x340;
  assert_false(a.send(standard));
  bus.inject(frame(0x1FFFFFFF));
  assert_true(drain(b) == (Ids{0x0CFF2FFF, 0x0CFF3000, 0x33F, 0x1FFFFFFF}));
  bus.set_babble(std::nullopt);
  assert_true(a.send(frame(0x0CFF3001)));
}
