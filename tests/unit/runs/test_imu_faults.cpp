// SPDX-License-Identifier: Apache-2.0
// Faults of the IMUs of a machine that digs: each stops it, in words and in time.

#include <cmath>
#include <memory>
#include <optional>

#include "app/runs/dig_run.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/scenarios.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using Rates = dbc::j1939::ARI;
using Forces = dbc::j1939::ACS;

machines::SimulatedExcavator with_imus() {
  runs::DigScenario scenario;
  scenario.errors = "all";
  scenario.scenario.imus = true;
  scenario.scenario.seed = 5;
  return runs::arranged(machines::load_simulated_excavator(machines::find_profile("excavator_22t")),
                        scenario);
}

/// A machine that has dug for seconds.
struct Digging {
  Digging() : machine(with_imus()), rig(machine, machines::dig_start(machine.profile), 1.0) {
    while (now < runs::kImusLearn_us + 4 * kSecondUs) {
      step();
    }
    assert_int_equal(status().mode, EcuMode::kActive);
    assert_true(status().stand_in);
    assert_true(status().joints.known);
  }

  void step() {
    rig.step(now);
    now += runs::DigRig::kPeriod_us;
  }
  [[nodiscard]] const ExcavatorStatus& status() const { return rig.ecu->outputs().status; }
  [[nodiscard]] std::uint32_t id(std::uint32_t message, int imu) const {
    return (message & ~0xFFU) | machine.profile.imu.mount[static_cast<unsigned>(imu)].address;
  }
  /// Until it stops; the commands are neutral in that cycle. Returns how long that took.
  int stops_within(int most_ms) {
    int time_ms = 0;
    while (status().mode == EcuMode::kActive && time_ms <= most_ms) {
      step();
      time_ms += 10;
    }
    print_message("fault %d after %d ms\n", static_cast<int>(status().fault), time_ms);
    assert_int_equal(status().mode, EcuMode::kFault);
    assert_false(rig.ecu->outputs().enable);
    for (const double duty_ratio : rig.ecu->outputs().duty_ratio) {
      assert_near(duty_ratio, 0.0, 0.0);
    }
    return time_ms;
  }
  /// From now on the frames of this id are changed on the wire.
  template <class Change>
  void change(std::uint32_t frame_id, const Change& change_data) {
    rig.bus.set_fault_hook([=](CanFrame& frame, const LoopbackPort* from) {
      return from == nullptr || frame.id != frame_id || change_data(frame);
    });
  }

  machines::SimulatedExcavator machine;
  runs::DigRig rig;
  TimeUs now = 0;
};

TEST(silence) {
  Digging dig;
  dig.change(dig.id(Rates::kId, kArm), [](CanFrame&) { return false; });
  static_cast<void>(dig.stops_within(60));
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
  static_cast<void>(dig.stops_within(20));
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
    static_cast<void>(dig.stops_within(1500));
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
  static_cast<void>(dig.stops_within(6000));
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
  static_cast<void>(dig.stops_within(1000));
}
