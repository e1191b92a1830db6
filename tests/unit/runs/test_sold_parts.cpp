// SPDX-License-Identifier: Apache-2.0
// Machines with parts off the shelf: encoders and inclinometers of CANopen, auxiliary valves of ISO
// 11783-7, a driver of solenoids, and all of them on two buses. Each digs, and what can go wrong
// with a part brings the machine to neutral in the bus's own time.

#include <memory>
#include <optional>

#include "app/runs/code_text.hpp"
#include "tests/unit/runs/machine_on_bus.hpp"

using test::kCycle_ms;

/// Of the bus profiles, and a cycle to find it.
constexpr int kSensor_ms = 35 + kCycle_ms;
constexpr int kPressure_ms = 40 + 2 * kCycle_ms;
constexpr int kHeartbeat_ms = 250 + kCycle_ms;
/// Of the valves; the command is 20 ms older.
constexpr int kValve_ms = 100 + 20 + 2 * kCycle_ms;
constexpr std::uint32_t kArmEncoder = 0x182;
constexpr std::uint32_t kArmHeartbeat = 0x702;

struct Machine : test::MachineOnBus {
  using MachineOnBus::MachineOnBus;

  /// What is done to frames of this id stops the machine in time.
  template <class Change>
  void stops_by(std::uint32_t id, const Change& change_data, int most_ms) {
    dig();
    change(id, change_data);
    controller_stops_within(most_ms);
    static_cast<void>(machine_neutral_after(2 * kCycle_ms));
  }
  /// Without a pressure it works on slowly, and says so.
  void misses_a_pressure_within(int most_ms) {
    int time_ms = 0;
    while (status().fault != Fault::kPressureMissing && time_ms <= most_ms) {
      step();
      time_ms += kCycle_ms;
    }
    print_message("told after %d ms\n", time_ms);
    assert_in_range(time_ms, 0, most_ms);
  }
};

bool lost(CanFrame&) { return false; }

TEST(an_encoder_that_is_lost) {
  Machine m("encoders");
  m.stops_by(kArmEncoder, lost, kSensor_ms);
  assert_int_equal(m.status().fault, Fault::kStrokeMissing);
}

TEST(a_heartbeat_that_is_lost) {
  Machine m("encoders");
  m.stops_by(kArmHeartbeat, lost, kHeartbeat_ms);
  assert_int_equal(m.status().fault, Fault::kStrokeMissing);
}

TEST(a_node_that_falls_asleep) {
  Machine m("encoders");
  m.stops_by(
      kArmHeartbeat,
      [](CanFrame& frame) {
        frame.data[0] = 0x7F;
        return true;
      },
      100 + kCycle_ms);
}

/// It is started again; the operator gives enable anew.
TEST(a_node_that_reboots) {
  Machine m("encoders");
  m.dig();
  int starts = 0;
  m.rig.bus.set_tap([&starts](const CanFrame& frame) {
    starts += frame.id == 0 && !frame.extended && frame.data[0] == 1 && frame.data[1] == 2 ? 1 : 0;
  });
  m.rig.plant.faults().sold.reboots_node = 2;
  ++m.rig.plant.faults().sold.reboots;
  m.controller_stops_within(2 * kCycle_ms);
  assert_int_equal(m.status().fault, Fault::kStrokeMissing);
  m.rig.enable_from(m.now + kSecondUs);
  repeat(300, [&] { m.step(); });
  assert_int_equal(starts, 1);
  assert_int_equal(m.status().mode, EcuMode::kActive);
  assert_true(m.rig.plant.spools_enabled());
}

TEST(an_encoder_that_is_wrong) {
  for (const std::uint8_t top : {std::uint8_t{0xFF}, std::uint8_t{0x10}}) {
    Machine m("encoders");
    m.stops_by(
        kArmEncoder,
        [top](CanFrame& frame) {
          frame.data[3] = top;  // An error, and 2684 m.
          return true;
        },
        kSensor_ms);
  }
  Machine m("encoders");
  m.stops_by(
      kArmEncoder,
      [](CanFrame& frame) {
        frame.data[1] = static_cast<std::uint8_t>(frame.data[1] + 0x28);  // 0.1 m.
        return true;
      },
      kSensor_ms);
}

TEST(an_encoder_that_sticks) {
  Machine m("encoders");
  m.dig();
  auto first = std::make_shared<std::optional<dbc::Payload>>();
  m.change(kArmEncoder, [first](CanFrame& frame) {
    *first = first->value_or(frame.data);
    frame.data = **first;
    return true;
  });
  m.controller_stops_within(4000);
}

/// It goes on with its values all the same.
TEST(an_encoder_with_an_emergency) {
  Machine m("encoders");
  m.dig();
  m.rig.plant.faults().sold.emergency_node = 2;
  m.rig.plant.faults().sold.emergency = 0x5010;
  m.controller_stops_within(2 * kCycle_ms);
  assert_int_equal(m.status().fault, Fault::kStrokeMissing);
  assert_string_equal(runs::emergency_words(m.rig.ecu->emergency()).c_str(),
                      ", node 2 has emergency 5010h (device hardware)");
  m.rig.plant.faults().sold.emergency = 0;
  m.rig.enable_from(m.now + kSecondUs);
  repeat(300, [&] { m.step(); });
  assert_int_equal(m.status().mode, EcuMode::kActive);
}

TEST(an_inclinometer_that_is_lost) {
  Machine m("inclinometers");
  m.stops_by(0x192, lost, kSensor_ms);
  Machine heart("inclinometers");
  heart.stops_by(0x714, lost, kHeartbeat_ms);
}

TEST(valves_without_controller) {
  for (const char* bus : {"aux_valves", "valve_driver"}) {
    Machine m(bus);
    m.dig();
    static_cast<void>(m.machine_neutral_after(kValve_ms, true));
  }
}

/// A command that is lost, with a flow or state that there is none of, or whose counter stands
/// still.
TEST(a_command_that_is_none) {
  const struct {
    const char* bus;
    std::uint32_t id;
    std::size_t byte;
    std::uint8_t value;
  } cases[] = {{"aux_valves", 0x0CFE3182, 0, 0xFE},
               {"aux_valves", 0x0CFE3182, 2, 0x33},
               {"valve_driver", 0x0CFF4182, 4, 0x00},
               {"valve_driver", 0x0CFF4182, 7, 0x11}};
  for (const auto& each : cases) {
    Machine m(each.bus);
    m.dig();
    m.change(each.id, [each](CanFrame& frame) {
      frame.data[each.byte] = each.value;
      return true;
    });
    static_cast<void>(m.machine_neutral_after(kValve_ms));
    m.controller_stops_within(200);
  }
  Machine m("aux_valves");
  m.dig();
  m.change(0x0CFE3082, lost);
  static_cast<void>(m.machine_neutral_after(kValve_ms));
}

TEST(a_second_sender_of_a_command) {
  Machine m("aux_valves");
  m.dig();
  CanFrame other;
  other.id = 0x0CFE3082;
  other.length = 8;
  m.rig.bus.inject(other);
  m.controller_stops_within(2 * kCycle_ms);
  assert_int_equal(m.status().fault, Fault::kSecondController);
}

TEST(a_retrofit_loses_a_part) {
  const struct {
    std::uint32_t id;
    int most_ms;
  } cases[] = {{kArmEncoder, kSensor_ms}, {kArmHeartbeat, kHeartbeat_ms}};
  for (const auto& each : cases) {
    Machine m("retrofit");
    m.dig();
    m.change(each.id, lost);
    m.controller_stops_within(each.most_ms);
  }
  Machine m("retrofit");
  m.dig();
  m.change(0x1A3, lost);
  m.misses_a_pressure_within(kPressure_ms);
}

TEST(a_pressure_transmitter_in_doubt) {
  Machine m("retrofit");
  m.dig();
  m.change(0x1A3, [](CanFrame& frame) {
    frame.data[2] = 1;
    return true;
  });
  m.misses_a_pressure_within(2 * kCycle_ms);
}

/// The plugs of both buses are swapped, or the second is off.
TEST(a_frame_on_the_other_bus_is_none) {
  for (const bool off : {true, false}) {
    Machine m("retrofit");
    m.dig();
    m.rig.bus.set_fault_hook([off](CanFrame& frame, const LoopbackPort* from) {
      const bool is_sensor = from != nullptr && !frame.extended && frame.bus == 1;
      frame.bus = is_sensor ? std::uint8_t{0} : frame.bus;
      return !(is_sensor && off);
    });
    m.controller_stops_within(kSensor_ms);
    assert_int_equal(m.status().fault, Fault::kStrokeMissing);
  }
}
