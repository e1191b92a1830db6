// SPDX-License-Identifier: Apache-2.0
// Which trouble code is said when.

#include "hal/link/dm1.hpp"

#include <algorithm>
#include <map>

#include "firmware/safety/fault_table.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr TimeUs kCallUs = 10'000;

FaultSet set_of(std::initializer_list<Fault> faults) {
  FaultSet set;
  for (const Fault fault : faults) {
    set.add(fault);
  }
  return set;
}

FaultSet first_faults(int count) {
  FaultSet set;
  for (int code = 1; code <= count; ++code) {
    set.add(static_cast<Fault>(code));
  }
  return set;
}

std::uint32_t spn_of(Fault fault) { return kDm1FirstSpn + static_cast<std::uint32_t>(fault); }

struct Bus {
  Dm1 dm1;
  TimeUs now = 0;
  Dm1Content content;

  bool call(const FaultSet& active) {
    const bool due = dm1.due(active, now, content);
    now += kCallUs;
    return due;
  }
  // The next frame is due in the `calls`-th call from here, and says this.
  void expect(const FaultSet& active, int calls, std::uint32_t spn) {
    for (int i = 1; i < calls; ++i) {
      assert_false(call(active));
    }
    assert_true(call(active));
    assert_int_equal(content.spn, spn);
  }
};

TEST(nothing_is_said_once_a_second, Bus bus) {
  bus.expect({}, 1, 0);
  assert_false(bus.content.red_stop || bus.content.amber_warning);
  assert_int_equal(bus.content.fmi, 0);
  assert_int_equal(bus.content.occurrences, 0);
  bus.expect({}, 100, 0);
  bus.expect({}, 100, 0);
}

TEST(a_new_fault_is_said_at_once, Bus bus) {
  bus.expect({}, 1, 0);
  bus.now += 20 * kCallUs;
  const FaultSet active = set_of({Fault::kBusOff});
  bus.expect(active, 1, spn_of(Fault::kBusOff));
  assert_int_equal(bus.content.fmi, fault_row(Fault::kBusOff).fmi);
  assert_int_equal(bus.content.occurrences, 1);
  bus.expect(active, 79, spn_of(Fault::kBusOff));  // its turns have gone on
  bus.expect(active, 100, spn_of(Fault::kBusOff));
  assert_int_equal(bus.content.occurrences, 1);
  bus.expect({}, 100, 0);
}

TEST(a_fault_from_the_start_is_said_once, Bus bus) {
  bus.now = 10 * kSecondUs;
  const FaultSet active = set_of({Fault::kBusOff});
  bus.expect(active, 1, spn_of(Fault::kBusOff));
  bus.expect(active, 100, spn_of(Fault::kBusOff));
}

TEST(several_new_faults_come_one_in_each_call, Bus bus) {
  bus.expect({}, 1, 0);
  const FaultSet active = set_of({Fault::kStrokeMissing, Fault::kSpoolStuck, Fault::kSensorError});
  bus.expect(active, 1, spn_of(Fault::kStrokeMissing));
  bus.expect(active, 1, spn_of(Fault::kSpoolStuck));
  bus.expect(active, 1, spn_of(Fault::kSensorError));
  // Then their turns, 330 ms each, from the last turn on.
  bus.expect(active, 30, spn_of(Fault::kStrokeMissing));
  bus.expect(active, 33, spn_of(Fault::kSpoolStuck));
  bus.expect(active, 33, spn_of(Fault::kSensorError));
  bus.expect(active, 33, spn_of(Fault::kStrokeMissing));
}

// Up to ten are each on the bus within a second; more of them take 100 ms each.
TEST(each_has_its_turn) {
  const int period_calls[] = {100, 100, 50, 33, 25, 20, 16, 14, 12, 11, 10, 10, 10};
  for (int count = 1; count <= 12; ++count) {
    Bus bus;
    const FaultSet active = first_faults(count);
    std::map<std::uint32_t, TimeUs> last_us;
    TimeUs longest_us = 0;
    int frames = 0;
    for (int call = 0; call < 1000; ++call) {
      const TimeUs at = bus.now;
      if (bus.call(active)) {
        ++frames;
        if (last_us.count(bus.content.spn) != 0) {
          longest_us = std::max(longest_us, at - last_us[bus.content.spn]);
        }
        last_us[bus.content.spn] = at;
      }
    }
    assert_int_equal(last_us.size(), count);
    assert_true(longest_us <= (count <= 10 ? kSecondUs : count * kSecondUs / 10));
    assert_in_range(frames, 1000 / period_calls[count], 1000 / period_calls[count] + count + 1);
  }
}

/// Whenever some of them go, each of the rest is said within a second of its last time.
TEST(faults_that_go_do_not_hold_up_the_rest) {
  for (int count = 2; count <= 10; ++count) {
    for (int gone_at = 100; gone_at < 200; ++gone_at) {
      Bus bus;
      const FaultSet all = first_faults(count);
      const FaultSet rest = first_faults(count / 2);
      std::map<std::uint32_t, TimeUs> last_us;
      for (int call = 0; call < 400; ++call) {
        const TimeUs at = bus.now;
        if (bus.call(call < gone_at ? all : rest)) {
          const auto said = last_us.find(bus.content.spn);
          assert_true(said == last_us.end() || at - said->second <= kSecondUs);
          last_us[bus.content.spn] = at;
        }
      }
      assert_int_equal(last_us.size(), count);
    }
  }
}

/// However many there are, none is left out.
TEST(more_than_ten_all_come_again) {
  for (const int count : {11, 12, 15, 20}) {
    Bus bus;
    const FaultSet active = first_faults(count);
    std::map<std::uint32_t, int> said;
    for (int call = 0; call < 1000; ++call) {
      if (bus.call(active)) {
        ++said[bus.content.spn];
      }
    }
    assert_int_equal(said.size(), count);
    for (const auto& [spn, times] : said) {
      assert_in_range(times, 100 / count, 100 / count + 3);
    }
  }
}

TEST(lamps_are_of_all_active) {
  for (int code = 1; code < kFaultCount; ++code) {
    const auto fault = static_cast<Fault>(code);
    Bus bus;
    bus.expect(set_of({fault}), 1, spn_of(fault));
    assert_int_equal(bus.content.red_stop, fault_row(fault).red_stop);
    assert_int_equal(bus.content.amber_warning, !fault_row(fault).red_stop);
    assert_int_equal(bus.content.fmi, fault_row(fault).fmi);
  }
  Bus bus;
  const FaultSet both = set_of({Fault::kPressureMissing, Fault::kBusOff});
  bus.expect(both, 1, spn_of(Fault::kPressureMissing));
  assert_true(bus.content.red_stop && bus.content.amber_warning);
}

// A fault that comes and goes with every call is on the bus once a second beside its turns, and its
// appearances are counted up to 126.
TEST(a_flickering_fault_does_not_flood, Bus bus) {
  const FaultSet active = set_of({Fault::kBusPassive});
  int frames = 0;
  for (int i = 0; i < 200; ++i) {
    frames += bus.call(active) ? 1 : 0;
    frames += bus.call({}) ? 1 : 0;
  }
  assert_in_range(frames, 4, 9);  // in 4 s
  bus.now += kSecondUs;
  assert_true(bus.call(active));
  assert_int_equal(bus.content.occurrences, 126);
}

TEST(occurrences_are_counted_for_each, Bus bus) {
  for (int times = 1; times <= 3; ++times) {
    bus.expect(set_of({Fault::kBusOff}), 1, spn_of(Fault::kBusOff));
    assert_int_equal(bus.content.occurrences, times);
    bus.now += kSecondUs;
    assert_true(bus.call({}));
    bus.now += kSecondUs / 2;
  }
  bus.expect(set_of({Fault::kBusDown}), 1, spn_of(Fault::kBusDown));
  assert_int_equal(bus.content.occurrences, 1);
}

// A call may be up to 5 ms early.
TEST(jitter_keeps_the_period, Bus bus) {
  bus.expect({}, 1, 0);
  bus.now = kSecondUs - 5001;
  assert_false(bus.call({}));
  bus.now = kSecondUs - 5000;
  assert_true(bus.call({}));
}

// A fault that was on the bus less than a second ago waits for its turn.
TEST(a_fault_that_comes_back_soon_waits) {
  for (const bool soon : {true, false}) {
    Bus bus;
    bus.expect({}, 1, 0);
    bus.now = 900'000;
    bus.expect(set_of({Fault::kBusOff}), 1, spn_of(Fault::kBusOff));
    bus.now = kSecondUs;
    bus.expect({}, 1, 0);
    bus.now = 900'000 + kSecondUs - (soon ? 5001 : 5000);
    assert_int_equal(bus.call(set_of({Fault::kBusOff})), !soon);
  }
}

TEST(a_clock_that_goes_back_does_not_silence, Bus bus) {
  bus.now = 10 * kSecondUs;
  bus.expect(set_of({Fault::kBusOff}), 1, spn_of(Fault::kBusOff));
  bus.now = kSecondUs;
  assert_true(bus.call(set_of({Fault::kBusOff})));
}
