// SPDX-License-Identifier: Apache-2.0
// Faults of the IMUs of a machine that digs: each stops it, in words and in time.

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "tests/unit/runs/machine_on_bus.hpp"

using Rates = dbc::j1939::ARI;
using Forces = dbc::j1939::ACS;

machines::SimulatedExcavator with_imus() {
  machines::Scenario scenario;
  scenario.imus = true;
  return test::found(scenario);
}

/// A machine that has dug for seconds.
struct Digging : test::MachineOnBus {
  Digging() : MachineOnBus(with_imus()) {
    dig(runs::kImusLearn_us + 4 * kSecondUs);
    assert_true(status().joints.known);
  }

  [[nodiscard]] std::uint32_t id(std::uint32_t message, int imu) const {
    return (message & ~0xFFU) | machine.profile.imu.mount[static_cast<unsigned>(imu)].address;
  }
};

TEST(silence) {
  Digging dig;
  dig.change(dig.id(Rates::kId, kArm), [](CanFrame&) { return false; });
  dig.controller_stops_within(60);
  assert_int_equal(dig.status().fault, Fault::kStrokeMissing);
}

TEST(it_calls_itself_degraded) {
  Digging dig;
  dig.change(dig.id(Forces::kId, kBucket), [](CanFrame& frame) {
    Forces message = Forces::decode(frame.data);
    message.vertical_merit = {Forces::VerticalMerit::kDegraded, dbc::RawState::kValid};
    frame.data = message.encode();
    return true;
  });
  dig.controller_stops_within(20);
}

TEST(frozen) {
  for (const std::uint32_t message : {Rates::kId, Forces::kId}) {
    Digging dig;
    auto last = std::make_shared<std::optional<CanFrame>>();
    dig.change(dig.id(message, kBoom), [last](CanFrame& frame) {
      if (!*last) {
        *last = frame;
      }
      frame.data = (*last)->data;
      return true;
    });
    dig.controller_stops_within(1500);
  }
}

TEST(a_second_sender) {
  Digging dig;
  runs::DigRig& rig = dig.rig;
  CanFrame other;
  other.id = dig.id(Rates::kId, kBoom);
  other.length = 8;
  other.data = Rates{}.encode();
  other.data[0] = 0x00;
  other.data[1] = 0x7D;
  other.data[6] = 0x00;
  int time_ms = 0;
  while (dig.status().mode == EcuMode::kActive && time_ms < 200) {
    rig.bus.inject(other);
    dig.step();
    time_ms += 10;
  }
  print_message("second sender: %d ms\n", time_ms);
  assert_int_equal(dig.status().mode, EcuMode::kFault);
  assert_in_range(time_ms, 10, 120);
}

TEST(a_jump) {
  Digging dig;
  // An axis is off by 0.35 g all at once: no tilt, whose size would be that of gravity.
  dig.change(dig.id(Forces::kId, kBoom), [](CanFrame& frame) {
    Forces message = Forces::decode(frame.data);
    message.longitudinal_mps2.value += 3.4;
    frame.data = message.encode();
    return true;
  });
  dig.controller_stops_within(6000);
}

TEST(a_bracket_turns) {
  Digging dig;
  dig.change(dig.id(Forces::kId, kBoom), [](CanFrame& frame) {
    constexpr double kTilt_rad = 0.35;
    Forces message = Forces::decode(frame.data);
    const double along = message.longitudinal_mps2.value;
    const double up = message.vertical_mps2.value;
    message.longitudinal_mps2.value = along * std::cos(kTilt_rad) + up * std::sin(kTilt_rad);
    message.vertical_mps2.value = up * std::cos(kTilt_rad) - along * std::sin(kTilt_rad);
    frame.data = message.encode();
    return true;
  });
  dig.controller_stops_within(1000);
}
