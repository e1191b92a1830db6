// SPDX-License-Identifier: Apache-2.0
// A machine with slope sensors of SAE J1939 in the place of stroke sensors: it digs by them, and of
// what can go wrong with such a sensor each brings it to neutral in the bus's own time.

#include <memory>
#include <optional>

#include "can_dbc/generated/j1939_dbc.hpp"
#include "tests/unit/runs/machine_on_bus.hpp"

using test::kCycle_ms;

/// The arm's.
constexpr std::uint32_t kSlope = dbc::j1939::SSI2::kId + 1;
/// Of the bus profile, and a cycle to find it.
constexpr int kTimeout_ms = 35 + kCycle_ms;

struct Machine : test::MachineOnBus {
  Machine() : MachineOnBus("slopes") {}

  /// What the arm's sensor sends from now on stops the machine in time, as a missing sensor does.
  template <class Change>
  void stops_by(const Change& change_data, int most_ms = kTimeout_ms) {
    dig();
    change(kSlope, change_data);
    controller_stops_within(most_ms);
    assert_int_equal(status().fault, Fault::kStrokeMissing);
    static_cast<void>(machine_neutral_after(2 * kCycle_ms));
  }
};

TEST(a_sensor_that_is_lost) {
  Machine m;
  m.stops_by([](CanFrame&) { return false; });
}

TEST(a_sensor_that_says_error_or_nothing) {
  for (const std::uint8_t top : {std::uint8_t{0xFE}, std::uint8_t{0xFF}}) {
    Machine m;
    m.stops_by(
        [top](CanFrame& frame) {
          frame.data[2] = top;
          return true;
        },
        2 * kCycle_ms);
  }
}

TEST(a_sensor_in_doubt) {
  for (const std::uint8_t merit : {std::uint8_t{0x04}, std::uint8_t{0x08}}) {
    Machine m;
    m.stops_by(
        [merit](CanFrame& frame) {
          frame.data[6] = merit;
          return true;
        },
        2 * kCycle_ms);
  }
}

TEST(a_sensor_whose_filter_is_late) {
  Machine m;
  m.stops_by(
      [](CanFrame& frame) {
        frame.data[7] = 80;  // 40 ms; its rule bears 30.
        return true;
      },
      2 * kCycle_ms);
}

TEST(a_slope_out_of_range) {
  Machine m;
  m.stops_by([](CanFrame& frame) {
    frame.data[2] = 0xF0;  // 230 degrees.
    return true;
  });
}

TEST(a_slope_that_jumps) {
  Machine m;
  m.stops_by([](CanFrame& frame) {
    frame.data[2] = static_cast<std::uint8_t>(frame.data[2] + 5);  // 10 degrees.
    return true;
  });
}

TEST(a_slope_that_stands_still) {
  Machine m;
  m.dig();
  auto first = std::make_shared<std::optional<dbc::Payload>>();
  m.change(kSlope, [first](CanFrame& frame) {
    *first = first->value_or(frame.data);
    frame.data = **first;
    return true;
  });
  m.controller_stops_within(4000);
}

/// Angles of 20 ms ago made this machine ring at 3 Hz until its strokes were taken for wrong.
TEST(a_machine_that_would_ring) {
  runs::DigScenario scenario;
  scenario.errors = "all";
  scenario.scenario.bus = "slopes";
  scenario.scenario.seed = 17;
  const machines::SimulatedExcavator machine = runs::arranged(
      machines::load_simulated_excavator(machines::find_profile("excavator_22t")), scenario);
  const runs::DigResult result =
      runs::run_dig(machine, runs::usual_run(machine, scenario), [](double, const std::string&) {});
  assert_int_equal(result.fault, Fault::kNone);
  const runs::DigSummary summary = runs::summarise(result);
  print_message("true tip, max: %.1f mm\n", 1e3 * summary.max_error_true_m);
  assert_in_range(static_cast<int>(1e3 * summary.max_error_true_m), 5, 70);
}

TEST(two_sensors_of_one_address) {
  Machine m;
  m.dig();
  CanFrame other;
  other.id = kSlope;
  other.length = 8;
  other.data = {0, 0, 0x7D, 0, 0, 0x7D, 0, 40};
  for (int cycle = 0; cycle < 4 && m.status().mode == EcuMode::kActive; ++cycle) {
    m.rig.bus.inject(other);
    m.step();
  }
  assert_int_equal(m.status().mode, EcuMode::kFault);
}
