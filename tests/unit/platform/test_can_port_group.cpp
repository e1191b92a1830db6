// SPDX-License-Identifier: Apache-2.0
// Several buses as one.

#include "platform/can_port_group.hpp"

#include <array>

#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

CanFrame frame(std::uint32_t id) {
  CanFrame made;
  made.id = id;
  made.length = 8;
  return made;
}

/// A group on two buses, with somebody else on each.
struct TwoBuses {
  std::array<LoopbackBus, 2> bus;
  std::array<LoopbackPort*, 2> own = {&bus[0].attach(), &bus[1].attach()};
  std::array<LoopbackPort*, 2> other = {&bus[0].attach(), &bus[1].attach()};
  CanPortGroup group;

  TwoBuses() {
    for (std::size_t i = 0; i < 2; ++i) {
      assert_true(group.add(*own[i]));
      assert_true(other[i]->open());
    }
  }
};

TEST(without_ports_it_is_closed) {
  CanPortGroup none;
  CanFrame taken;
  assert_false(none.open());
  assert_int_equal(none.state(), CanPortState::kClosed);
  assert_false(none.send(frame(1)));
  assert_int_equal(none.receive(&taken, 1), 0);
}

TEST(there_is_room_for_four) {
  LoopbackBus bus;
  CanPortGroup group;
  repeat(CanPortGroup::kMost, [&] { assert_true(group.add(bus.attach())); });
  assert_false(group.add(bus.attach()));
}

TEST(what_is_sent_goes_to_all) {
  TwoBuses two;
  assert_true(two.group.open());
  assert_true(two.group.send(frame(0x123)));
  for (LoopbackPort* other : two.other) {
    CanFrame heard;
    assert_int_equal(other->receive(&heard, 1), 1);
    assert_int_equal(heard.id, 0x123);
  }
}

/// One bus that does not take it is enough to call it dropped; the others have it all the same.
TEST(a_frame_that_one_bus_refuses_is_dropped) {
  for (std::size_t broken = 0; broken < 2; ++broken) {
    TwoBuses two;
    assert_true(two.group.open());
    two.own[broken]->set_send_fails(true);
    assert_false(two.group.send(frame(0x123)));
    CanFrame heard;
    assert_int_equal(two.other[1 - broken]->receive(&heard, 1), 1);
  }
}

TEST(all_are_heard_and_a_flood_starves_nobody) {
  TwoBuses two;
  assert_true(two.group.open());
  repeat(10, [&] { assert_true(two.other[0]->send(frame(0x100))); });
  assert_true(two.other[1]->send(frame(0x200)));
  std::array<CanFrame, 4> frames;
  bool heard_second = false;
  for (int call = 0; call < 2; ++call) {
    const int count = two.group.receive(frames.data(), 4);
    assert_int_equal(count, 4);
    for (int i = 0; i < count; ++i) {
      heard_second = heard_second || frames[static_cast<std::size_t>(i)].id == 0x200;
    }
  }
  assert_true(heard_second);
}

TEST(the_worst_bus_is_the_state) {
  const CanPortState order[] = {CanPortState::kActive, CanPortState::kErrorPassive,
                                CanPortState::kBusOff, CanPortState::kDown, CanPortState::kClosed};
  for (std::size_t one = 0; one < 5; ++one) {
    for (std::size_t another = 0; another < 5; ++another) {
      TwoBuses two;
      two.own[0]->set_state(order[one]);
      two.own[1]->set_state(order[another]);
      assert_int_equal(two.group.state(), order[one > another ? one : another]);
    }
  }
}

/// A bus that is not there leaves the others open: what they say is still heard.
TEST(one_that_does_not_open_is_told) {
  TwoBuses two;
  two.own[0]->set_state(CanPortState::kDown);
  assert_false(two.group.open());
  assert_int_equal(two.own[1]->state(), CanPortState::kActive);
}
