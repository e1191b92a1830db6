// SPDX-License-Identifier: Apache-2.0
// Stamps and echoes: who counts as late, and when.

#include "hal/link/challenge.hpp"

#include "tests/unit/cmocka_cpp.hpp"

constexpr TimeUs kCycleUs = 10'000;

// Stations that answer after so long by their own frames' times; negative: not at all.
struct Bus {
  Challenge challenge;
  Echoes echoes;
  TimeUs now = 5 * kSecondUs;

  static void say(Signal<std::uint32_t>& echo, std::uint32_t stamp, TimeUs now) {
    echo = {stamp, Validity::kValid, now};
  }
  std::uint32_t ask() {
    const std::uint32_t stamp = challenge.next_stamp();
    challenge.sent(now);
    return stamp;
  }
  void cycle() {
    now += kCycleUs;
    challenge.hear(echoes, now);
  }
  // Whether an answer is missed, heard at this time.
  bool late_at(TimeUs time_us) {
    challenge.hear(echoes, time_us);
    return challenge.is_late(false);
  }
  // A stamp, answered within so many cycles, then the rest of a second.
  void ask_and_answer(int driver_cycles, int machine_cycles, int cycles = 100) {
    const std::uint32_t stamp = ask();
    for (int i = 1; i <= cycles; ++i) {
      now += kCycleUs;
      const bool driver_knows = driver_cycles > 0 && i >= driver_cycles;
      say(echoes.driver, driver_knows ? stamp : stamp - 1, now);
      if (i == machine_cycles) {
        say(echoes.machine, stamp, now);
      }
      challenge.hear(echoes, now);
    }
  }
};

TEST(nobody_heard_is_not_late, Bus bus) {
  assert_false(bus.challenge.is_late(false));
  bus.ask();
  for (int i = 0; i < 20; ++i) {
    bus.cycle();
    assert_false(bus.challenge.is_late(false));
    assert_false(bus.challenge.cannot_answer());
  }
}

TEST(each_station_has_to_answer_once, Bus bus) {
  Bus::say(bus.echoes.driver, 0, bus.now);
  bus.cycle();
  assert_true(bus.challenge.is_late(false));
  assert_false(bus.challenge.is_late(true));
  const std::uint32_t stamp = bus.ask();
  Bus::say(bus.echoes.driver, stamp, bus.now);
  Bus::say(bus.echoes.machine, 0, bus.now);
  bus.cycle();
  assert_true(bus.challenge.is_late(false));
  Bus::say(bus.echoes.machine, stamp, bus.now);
  bus.cycle();
  assert_false(bus.challenge.is_late(false));
}

// 60 ms and a cycle of the sender's: 20 ms of the operator's, 10 ms of the machine's.
TEST(the_answer_has_its_time) {
  for (int cycles = 1; cycles <= 12; ++cycles) {
    Bus driver;
    driver.ask_and_answer(cycles, 1);
    assert_int_equal(driver.challenge.is_late(false), cycles > 8);
    Bus machine;
    machine.ask_and_answer(1, cycles);
    assert_int_equal(machine.challenge.is_late(false), cycles > 7);
  }
}

// Said in the cycle in which the time ends, not in the one after it.
TEST(an_answer_is_missed_when_its_time_is_over, Bus bus) {
  bus.ask_and_answer(1, 1);
  const TimeUs sent_us = bus.now;
  bus.ask();
  assert_false(bus.late_at(sent_us + 69'999));
  assert_true(bus.late_at(sent_us + 70'000));  // the machine's
  Bus driver;
  driver.ask_and_answer(1, 1);
  const TimeUs driver_us = driver.now;
  Bus::say(driver.echoes.machine, driver.ask(), driver_us + kCycleUs);
  assert_false(driver.late_at(driver_us + 79'999));
  assert_true(driver.late_at(driver_us + 80'000));
}

TEST(only_the_last_stamp_said_as_valid_is_an_answer) {
  const auto late_after = [](int off, Validity validity) {
    Bus bus;
    const std::uint32_t stamp = bus.ask();
    Bus::say(bus.echoes.driver, stamp, bus.now);
    Bus::say(bus.echoes.machine, stamp + static_cast<std::uint32_t>(off), bus.now);
    bus.echoes.machine.validity = validity;
    bus.cycle();
    return bus.challenge.is_late(false);
  };
  assert_false(late_after(0, Validity::kValid));
  assert_true(late_after(1, Validity::kValid));
  assert_true(late_after(-1, Validity::kValid));
  assert_true(late_after(0, Validity::kError));
  assert_true(late_after(0, Validity::kOutOfRange));
}

TEST(two_in_a_row_count_in_motion, Bus bus) {
  bus.ask_and_answer(1, 1);
  for (int i = 0; i < 2; ++i) {
    bus.ask_and_answer(1, 8);
    assert_true(bus.challenge.is_late(false));
    assert_int_equal(bus.challenge.is_late(true), i == 1);
  }
  bus.ask_and_answer(9, 1);
  assert_false(bus.challenge.is_late(true));  // one of the operator's, none of the machine's
  assert_true(bus.challenge.is_late(false));
  bus.ask_and_answer(9, 1);
  assert_true(bus.challenge.is_late(true));
  bus.ask_and_answer(1, 1);
  assert_false(bus.challenge.is_late(false));
}

// A cycle of ours that comes too late to tell, though the frame is there.
TEST(a_frame_that_is_read_too_late_is_late) {
  for (const TimeUs driver_ago_us : {0, 10'000}) {
    Bus bus;
    const std::uint32_t stamp = bus.ask();
    bus.now += 90'000;
    Bus::say(bus.echoes.driver, stamp, bus.now - driver_ago_us);
    Bus::say(bus.echoes.machine, stamp, bus.now - 20'000);
    bus.challenge.hear(bus.echoes, bus.now);
    assert_int_equal(bus.challenge.is_late(false), driver_ago_us == 0);
  }
}

// As long as nothing is heard of a station it is missing, not late; and late when it is back.
TEST(a_silent_station_is_missing, Bus bus) {
  bus.ask_and_answer(1, 1, 10);
  Bus::say(bus.echoes.driver, 0, bus.now);
  Bus::say(bus.echoes.machine, 0, bus.now);
  const TimeUs heard_us = bus.now;
  bus.ask();
  assert_true(bus.late_at(heard_us + 100'000));
  Bus driver = bus;
  Bus::say(driver.echoes.machine, 1, heard_us - 10 * kSecondUs);
  assert_false(driver.late_at(heard_us + 100'001));
  assert_true(bus.late_at(heard_us + 2'500'000));
  assert_false(bus.late_at(heard_us + 2'500'001));
  Bus::say(bus.echoes.driver, 0, heard_us + 2'600'000);
  assert_true(bus.late_at(heard_us + 2'600'000));
}

TEST(a_station_that_cannot_answer_is_not_checked_and_said) {
  for (const bool driver : {true, false}) {
    Bus bus;
    bus.ask();
    Signal<std::uint32_t>& mute = driver ? bus.echoes.driver : bus.echoes.machine;
    Signal<std::uint32_t>& other = driver ? bus.echoes.machine : bus.echoes.driver;
    mute = {0, Validity::kNotAvailable, bus.now};
    Bus::say(other, 1, bus.now);
    bus.cycle();
    assert_true(bus.challenge.cannot_answer());
    assert_false(bus.challenge.is_late(false));
    mute.validity = Validity::kError;  // it could, and does not
    bus.cycle();
    assert_false(bus.challenge.cannot_answer());
    assert_true(bus.challenge.is_late(false));
  }
}

TEST(stamps_go_round_without_0, Challenge challenge) {
  for (int i = 1; i <= 64255; ++i) {
    assert_int_equal(challenge.next_stamp(), i);
    challenge.sent(0);
  }
  assert_int_equal(challenge.next_stamp(), 1);
}
