// SPDX-License-Identifier: Apache-2.0
// A machine of the ZX200 class on its own bus: handshake, lock, emergency stop, what is lost and
// what stands still. Within the bus's own times the machine is neutral, and the controller stops.

#include <algorithm>

#include "can_dbc/generated/zx200_dbc.hpp"
#include "tests/unit/runs/machine_on_bus.hpp"

namespace zx200 = dbc::zx200;

using test::kCycle_ms;
/// Times of the bus: three settings, five commands.
constexpr int kSetting_ms = 150;
constexpr int kCommand_ms = 50;
/// The state every 50 ms, and the cycles that the valve side has to say it.
constexpr int kEcho_ms = 50 + 150;

struct Machine : test::MachineOnBus {
  Machine() : MachineOnBus("zx200") {}

  [[nodiscard]] plant::Zx200Faults& faults() { return rig.plant.faults().zx200; }
};

/// Levers of the last frame, in any direction.
int most_lever(const CanFrame& frame) {
  return *std::max_element(frame.data.begin(), frame.data.end());
}

TEST(nothing_moves_before_the_handshake) {
  Machine m;
  int levers = 0;
  bool asked = false;
  m.rig.bus.set_tap([&](const CanFrame& frame) {
    if (frame.id == zx200::PilotPressureCmd1::kId) {
      levers = most_lever(frame);
    }
    if (frame.id == zx200::MachineSettingCmd::kId) {
      asked = zx200::MachineSettingCmd::decode(frame.data).front_signal_switch.value == 1;
    }
  });
  TimeUs asked_us = 0;
  while (m.now < kSecondUs && !m.rig.plant.spools_enabled()) {
    m.step();
    if (m.status().mode != EcuMode::kActive) {
      assert_int_equal(levers, 0);
      assert_false(asked);
    } else if (asked_us == 0) {
      asked_us = m.now;
    }
  }
  assert_true(asked);
  assert_true(m.rig.plant.spools_enabled());
  assert_in_range(m.now - asked_us, 0, 30 * kMillisecondUs);
  m.dig();
}

TEST(a_locked_machine_does_not_move) {
  Machine m;
  m.faults().locked = true;
  while (m.now < 2 * kSecondUs && m.status().mode != EcuMode::kFault) {
    m.step();
    assert_false(m.rig.plant.spools_enabled());
  }
  // Its pilot pressures do not come, and its gateway says so before they are late.
  assert_int_equal(m.status().fault, Fault::kValveNotFollowing);
}

TEST(lock) {
  Machine m;
  m.dig();
  m.faults().locked = true;
  static_cast<void>(m.machine_neutral_after(kCycle_ms));
  m.controller_stops_within(kEcho_ms);
  assert_int_equal(m.status().fault, Fault::kValveNotFollowing);
}

/// Of a machine whose pilot pressures are not looked at, its state alone says so.
TEST(lock_by_its_state) {
  Machine m;
  m.dig();
  m.change(zx200::MachineState::kId, [](CanFrame& frame) {
    frame.data[0] |= 1U;
    return true;
  });
  m.controller_stops_within(kEcho_ms);
  assert_int_equal(m.status().fault, Fault::kValveNotFollowing);
}

TEST(a_short_lock_is_not_undone) {
  Machine m;
  m.dig();
  m.faults().locked = true;
  m.step();
  m.faults().locked = false;
  for (int cycle = 0; cycle < 100; ++cycle) {
    m.step();
    assert_false(m.rig.plant.spools_enabled());
  }
  // The operator lets go, and gives it again.
  m.rig.enable_from(m.now + kSecondUs);
  repeat(300, [&] { m.step(); });
  assert_int_equal(m.status().mode, EcuMode::kActive);
  assert_true(m.rig.plant.spools_enabled());
}

TEST(emergency_stop) {
  Machine m;
  m.dig();
  m.faults().stopped = true;
  static_cast<void>(m.machine_neutral_after(kCycle_ms));
  m.controller_stops_within(kEcho_ms);
}

TEST(lost_gateway) {
  Machine m;
  m.dig();
  m.faults().lost = true;
  // Of angles the table's 35 ms hold.
  m.controller_stops_within(50);
  assert_int_equal(m.status().fault, Fault::kStrokeMissing);
  static_cast<void>(m.machine_neutral_after(kCommand_ms));
}

TEST(lost_controller) {
  Machine m;
  m.dig();
  static_cast<void>(m.machine_neutral_after(kCommand_ms + 2 * kCycle_ms, true));
}

TEST(the_machines_counter_stands_still) {
  Machine m;
  m.dig();
  m.faults().frozen = true;
  m.controller_stops_within(160 + 50 + kCycle_ms);
  static_cast<void>(m.machine_neutral_after(2 * kCycle_ms));
}

TEST(our_counter_stands_still) {
  Machine m;
  m.dig();
  m.change(zx200::MachineSettingCmd::kId, [](CanFrame& frame) {
    frame.data[7] = 7;
    return true;
  });
  static_cast<void>(m.machine_neutral_after(kSetting_ms + 50 + 2 * kCycle_ms));
  m.controller_stops_within(kEcho_ms);
}

TEST(an_angle_that_jumps_or_sticks) {
  {
    Machine m;
    m.dig();
    m.rig.plant.faults().axis[kArm].stroke.jump_m = 0.3;  // rad
    m.controller_stops_within(50);
  }
  Machine m;
  m.dig();
  m.rig.plant.faults().axis[kArm].stroke.stuck = true;
  m.controller_stops_within(4000);
}

TEST(a_pilot_that_does_not_follow) {
  Machine m;
  m.dig();
  m.change(zx200::PilotPressure1::kId, [](CanFrame& frame) {
    frame.data[0] = 200;  // Boom up.
    return true;
  });
  m.controller_stops_within(100);
  assert_int_equal(m.status().fault, Fault::kSpoolStuck);
  static_cast<void>(m.machine_neutral_after(2 * kCycle_ms));
  // No signal says cut: nothing is sent any more, and the machine shuts off by itself.
  repeat(20, [&] { m.step(); });
  bool sent = false;
  m.rig.bus.set_tap([&](const CanFrame& frame) {
    sent = sent || frame.id == zx200::PilotPressureCmd1::kId ||
           frame.id == zx200::MachineSettingCmd::kId;
  });
  repeat(20, [&] { m.step(); });
  assert_false(sent);
}

TEST(another_controller) {
  Machine m;
  m.dig();
  CanFrame other;
  other.id = zx200::PilotPressureCmd1::kId;
  other.length = 8;
  m.rig.bus.inject(other);
  m.controller_stops_within(20);
  assert_int_equal(m.status().fault, Fault::kSecondController);
}

/// Where its own pilot puts them, and both ends know it.
TEST(nobody_commands_its_pumps) {
  const machines::SimulatedExcavator on_it = test::on_bus("zx200");
  const machines::SimulatedExcavator on_ours = test::on_bus("encoders");
  for (unsigned j = 0; j < kPumpCount; ++j) {
    assert_near(on_it.plant.swash_ratio[j], 1.0, 0.0);
    assert_near(on_it.profile.dig_swash_ratio[j], 1.0, 0.0);
    assert_near(on_ours.plant.swash_ratio[j], 0.643, 0.0);
  }
  assert_near(on_it.profile.demand_swash.most_ratio, 0.0, 0.0);
  assert_near(on_ours.profile.demand_swash.most_ratio, 1.0, 0.0);
}
