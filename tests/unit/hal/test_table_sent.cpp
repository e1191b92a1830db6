// SPDX-License-Identifier: Apache-2.0
// What is sent to a bus that a table describes.

#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/table_bus.hpp"

using namespace graben::test;

struct Sent {
  BusTable other = table();
  TableTransmitter transmitter{&other};
  ExcavatorOutputs outputs;
  TableTransmitter::Frames frames;
  std::size_t count = 0;
  TimeUs now = kNow;

  void cycle() {
    count = transmitter.frames(outputs, now, frames);
    now += kPeriod;
  }
  [[nodiscard]] const CanFrame* find(std::uint32_t id) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (frames[i].id == id) {
        return &frames[i];
      }
    }
    return nullptr;
  }
};

TEST(duties_become_levers, Sent sent) {
  sent.outputs.enable = true;
  sent.outputs.duty_ratio[0] = 0.5;
  sent.cycle();
  const CanFrame* levers = sent.find(kLevers);
  assert_non_null(levers);
  assert_int_equal(levers->data[0], 125);
  assert_int_equal(levers->data[1], 0);
  assert_int_equal(levers->bus, 0);
  sent.outputs.duty_ratio[0] = -1.0;
  sent.cycle();
  assert_int_equal(sent.find(kLevers)->data[0], 0);
  assert_int_equal(sent.find(kLevers)->data[1], 250);
  assert_true(sent.transmitter.is_command(kLevers));
}

TEST(without_enable_all_is_neutral, Sent sent) {
  sent.outputs.duty_ratio[0] = 0.5;
  sent.cycle();
  assert_int_equal(sent.find(kLevers)->data[0], 0);
  assert_int_equal(sent.find(kSetting)->data[3], 0);
  assert_int_equal(sent.find(kSetting)->data[0], 180);
  sent.outputs.enable = true;
  sent.outputs.duty_ratio[1] = std::numeric_limits<double>::quiet_NaN();
  sent.cycle();
  assert_int_equal(sent.find(kLevers)->data[0], 0);
}

TEST(a_change_of_enable_does_not_wait, Sent sent) {
  sent.cycle();
  const int first = sent.find(kSetting)->data[7];
  sent.cycle();
  assert_null(sent.find(kSetting));
  sent.outputs.enable = true;
  sent.cycle();
  assert_non_null(sent.find(kSetting));
  assert_int_equal(sent.find(kSetting)->data[3], 0x10);
  assert_int_equal(sent.find(kSetting)->data[7], first + 1);
}

TEST(what_cannot_say_cut_falls_silent, Sent sent) {
  sent.outputs.pilot_known = true;
  sent.outputs.pilot_cut = true;
  for (int cycle = 0; cycle < TableTransmitter::kNeutralCycles; ++cycle) {
    sent.cycle();
    assert_int_equal(sent.find(kLevers)->data[0], 0);
  }
  for (int cycle = 0; cycle < 20; ++cycle) {
    sent.cycle();
    assert_int_equal(sent.count, 0);
  }
  sent.outputs.pilot_cut = false;
  sent.cycle();
  assert_non_null(sent.find(kLevers));
}
