// SPDX-License-Identifier: Apache-2.0
// Commissioning over the bus, by the station: what stops it, how far a cylinder goes wrong by then,
// and that it goes on and ends as if nothing had been.

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulation_file.hpp"
#include "app/runs/frame_edit.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/operate/commission_bench.hpp"

using commission::SequenceOptions;
using commission::StepKind;
using operate::CommissionEnd;
using test::CommissionBench;
using Dbc = dbc::excavator::Dbc;
using Results = std::vector<commission::StepResult>;

constexpr double kWrong_m = 0.050;
/// To neutral, once the controller has said its fault or enable is gone.
constexpr double kNeutral_s = 0.02;

/// Begins it or takes it back, with the axis that is tried.
using Switch = std::function<void(CommissionBench&, unsigned axis, bool on)>;

struct Row {
  const char* name;
  bool from_the_start;  ///< Else it comes while a drive is told to move.
  Switch turn;
  std::vector<Fault> faults;  ///< Any of these; kNone: the station itself stops, or pauses.
};

std::vector<machines::SimulatedExcavator> machines_to_try() {
  machines::SimulatedChoice hidden;
  hidden.hidden = 3;
  return {test::excavator(),
          machines::load_simulated_excavator(machines::find_profile("excavator_22t"), hidden)};
}

void expect_done(CommissionBench& bench) {
  assert_true(bench.run_to_end());
  assert_int_equal(bench.station->end(), CommissionEnd::kDone);
}

/// What a sound machine gives.
Results sound_results(const machines::SimulatedExcavator& machine, const SequenceOptions& options) {
  CommissionBench bench(machine, options);
  bench.hands.deadman = true;
  expect_done(bench);
  return bench.station->sequence().results();
}

void expect_same(const Results& results, const Results& sound) {
  assert_int_equal(results.size(), sound.size());
  for (std::size_t at = 0; at < results.size(); ++at) {
    // One that began again elsewhere may end at its window.
    assert_int_equal(results[at].end == commission::StepEnd::kNoMotion,
                     sound[at].end == commission::StepEnd::kNoMotion);
    assert_near(results[at].duty, sound[at].duty, 0.06);
  }
}

/// It stops by itself with this fault, and is neutral.
void expect_stop(CommissionBench& bench, double within_s, Fault fault) {
  bench.hands.deadman = true;
  assert_true(bench.run_to_end(within_s));
  assert_int_equal(bench.station->end(), CommissionEnd::kFault);
  assert_int_equal(bench.fault(), fault);
  bench.run(kNeutral_s);
  assert_true(bench.neutral());
}

bool is_one_of(Fault fault, const std::vector<Fault>& any) {
  return std::count(any.begin(), any.end(), fault) > 0;
}

/// Stopped, the station's words are there, and it goes on with the step that was interrupted.
void try_row(const Row& row, const machines::SimulatedExcavator& machine, int axis) {
  const SequenceOptions options = test::one_drive(machine, axis);
  const Results sound = sound_results(machine, options);
  CommissionBench bench(machine, options);
  if (row.from_the_start) {
    row.turn(bench, static_cast<unsigned>(axis), true);
    // A stroke that jumps at rest has moved: until it has stood for a second nothing arms.
    bench.run(2.0);
  }
  bench.begin_watch();
  bench.hands.deadman = true;
  if (!row.from_the_start) {
    assert_true(bench.run_until([&] { return bench.duty() > 0.2; }, 20.0));
    row.turn(bench, static_cast<unsigned>(axis), true);
  }
  assert_true(bench.run_to_end(20.0));
  const Fault fault = bench.fault();
  bench.run(kNeutral_s);
  std::printf("%s, %s: %s; %.1f mm wrong, %.1f mm unseen\n", row.name, commission::axis_name(axis),
              bench.station->end_words().c_str(), 1e3 * bench.strayed_m,
              1e3 * bench.unseen_m(axis));
  assert_true(bench.neutral());
  bench.run(1.0);
  assert_true(bench.strayed_m < kWrong_m);
  assert_true(bench.station->end() == CommissionEnd::kWrongWay || is_one_of(fault, row.faults));
  assert_false(bench.station->end_words().empty());
  row.turn(bench, static_cast<unsigned>(axis), false);
  bench.restart_station(bench.station->sequence().results());
  expect_done(bench);
  expect_same(bench.station->sequence().results(), sound);
}

void try_rows(const std::vector<Row>& rows, const std::vector<int>& axes) {
  for (const machines::SimulatedExcavator& machine : machines_to_try()) {
    for (const Row& row : rows) {
      for (const int axis : axes) {
        try_row(row, machine, axis);
      }
    }
  }
}

TEST(valves_and_sensors_the_wrong_way) {
  try_rows({{"reversed valve",
             true,
             [](CommissionBench& bench, unsigned axis, bool on) {
               bench.plant.faults().axis[axis].reversed = on;
             },
             {Fault::kWrongDirection}}},
           {kBoom, kArm, kBucket});
  try_rows({{"swapped stroke sensors",
             true,
             [](CommissionBench& bench, unsigned, bool on) {
               bench.plant.faults().stroke_from = {on ? 1U : 0U, on ? 0U : 1U, 2};
             },
             {Fault::kUncommandedMotion}}},
           {kBoom, kArm});
}

TEST(spools_that_hang) {
  try_rows({{"spool held open",
             false,
             [](CommissionBench& bench, unsigned axis, bool on) {
               auto& held_ratio = bench.plant.faults().axis[axis].spool_held_ratio;
               held_ratio = on ? std::optional<double>(-0.5) : std::nullopt;
             },
             {Fault::kSpoolStuck, Fault::kWrongDirection, Fault::kUncommandedMotion}}},
           {kBoom, kArm, kBucket});
}

/// Of a drive whose sensor stands from the start nothing tells that it moves but its pressures.
TEST(a_stuck_stroke_sensor) {
  constexpr double kUnseen_m = 0.10;
  for (const machines::SimulatedExcavator& machine : machines_to_try()) {
    for (const int axis : {kBoom, kArm, kBucket}) {
      CommissionBench bench(machine, test::one_drive(machine, axis));
      plant::StrokeFault& stroke = bench.plant.faults().axis[static_cast<unsigned>(axis)].stroke;
      stroke.stuck = true;
      expect_stop(bench, 30.0, Fault::kStrokeStuck);
      std::printf("stuck stroke sensor, %s: %.1f mm unseen\n", commission::axis_name(axis),
                  1e3 * bench.unseen_m(axis));
      assert_true(bench.unseen_m(axis) < kUnseen_m);
      stroke = {};
      bench.restart_station(bench.station->sequence().results());
      expect_done(bench);
    }
  }
}

TEST(engine_and_bus_that_go) {
  const std::vector<Row> rows = {
      {"engine stops",
       false,
       [](CommissionBench& bench, unsigned, bool on) {
         bench.plant.faults().engine_ratio = on ? 0.0 : 1.0;
       },
       {Fault::kEngineStopped}},
      {"station's frames stop",
       false,
       [](CommissionBench& bench, unsigned, bool on) { bench.sends = !on; },
       {Fault::kOperatorMissing}},
      {"machine's frames stop",
       false,
       [](CommissionBench& bench, unsigned, bool on) {
         bench.plant.faults().set_silent(Dbc::ArmStroke::kId, on);
       },
       {Fault::kStrokeMissing}},
      {"CRC of CommissionDuty",
       false,
       [](CommissionBench& bench, unsigned, bool on) {
         bench.bus.set_fault_hook([on](CanFrame& frame, const LoopbackPort*) {
           if (on && frame.id == Dbc::CommissionDuty::kId) {
             runs::corrupt(frame);
           }
           return true;
         });
       },
       {Fault::kOperatorMissing}},
      {"controller's bus is gone",
       false,
       [](CommissionBench& bench, unsigned, bool on) {
         if (on) {  // For a while.
           bench.ecu_port.set_state(CanPortState::kDown);
           bench.run(0.3);
           bench.ecu_port.set_state(CanPortState::kClosed);
         }
       },
       {Fault::kBusDown}},
  };
  try_rows(rows, {kArm});
}

/// Nothing of what is tried goes by which is which: it ends well, or stops.
TEST(swapped_pressures) {
  for (const machines::SimulatedExcavator& machine : machines_to_try()) {
    for (const int axis : {kBoom, kArm, kBucket}) {
      const SequenceOptions options = test::one_drive(machine, axis);
      CommissionBench bench(machine, options);
      bench.plant.faults().axis[static_cast<unsigned>(axis)].pressures_swapped = true;
      bench.run(0.5);
      bench.begin_watch();
      bench.hands.deadman = true;
      assert_true(bench.run_to_end());
      const bool done = bench.station->end() == CommissionEnd::kDone;
      std::printf("swapped pressures, %s: %s\n", commission::axis_name(axis),
                  done ? "done" : bench.station->end_words().c_str());
      assert_true(bench.strayed_m < kWrong_m);
      bench.run(kNeutral_s);
      assert_true(bench.neutral());
      bench.plant.faults().axis[static_cast<unsigned>(axis)].pressures_swapped = false;
      if (!done) {
        bench.restart_station(bench.station->sequence().results());
        assert_true(bench.run_to_end());
      }
      assert_int_equal(bench.station->end(), CommissionEnd::kDone);
      expect_same(bench.station->sequence().results(), sound_results(machine, options));
    }
  }
}

/// Held by more than its pump can give; freed, the rest is done.
TEST(a_blocked_cylinder) {
  const machines::SimulatedExcavator& sound = test::excavator();
  const SequenceOptions options = test::one_drive(sound, kArm);
  machines::SimulatedExcavator machine = sound;
  machine.plant.friction[kArm].coulomb_n = 2e6;
  CommissionBench bench(machine, options);
  bench.begin_watch();
  const Eigen::Vector3d from_m = bench.strokes_m();
  expect_stop(bench, 60.0, Fault::kStrokeStuck);
  assert_true((bench.strokes_m() - from_m).norm() < kWrong_m);
  CommissionBench after(sound, options);
  after.restart_station(bench.station->sequence().results());
  expect_done(after);
  expect_same(after.station->sequence().results(), sound_results(sound, options));
}

/// Two of one address: no frame of either can be told from the other's.
TEST(a_second_station) {
  const machines::SimulatedExcavator& machine = test::excavator();
  CommissionBench bench(machine, test::one_drive(machine, kArm));
  bench.begin_watch();
  bench.hands.deadman = true;
  assert_true(bench.run_until([&] { return bench.duty() > 0.2; }, 20.0));
  assert_false(bench.heard.other_station().has_value());
  operate::CommandFrames others;
  for (int n = 0; n < 30; ++n) {
    bench.bus.inject(others.next({}, {0, dbc::RawState::kValid}, bench.now_us)[0]);
    bench.cycle();
  }
  assert_true(bench.heard.other_station().has_value());
  assert_true(bench.neutral());
  assert_true(bench.strayed_m < kWrong_m);
}

/// A controller without a window holds the drive: no step is taken for one that did not move.
TEST(windows_that_do_not_arrive) {
  const machines::SimulatedExcavator& machine = test::excavator();
  const SequenceOptions options = test::one_drive(machine, kArm);
  CommissionBench bench(machine, options);
  bench.hands.deadman = true;
  assert_true(bench.run_until([&] { return bench.duty() > 0.2; }, 20.0));
  bench.bus.set_fault_hook(
      [](CanFrame& frame, const LoopbackPort*) { return frame.id != Dbc::CommissionWindow::kId; });
  const std::size_t at = bench.station->sequence().at();
  bench.run(1.2);
  const Eigen::Vector3d from_m = bench.strokes_m();
  bench.run(12.0);
  assert_true((bench.strokes_m() - from_m).norm() < 0.03);
  assert_int_equal(bench.fault(), Fault::kNone);
  assert_int_equal(bench.station->sequence().at(), at);
  bench.bus.set_fault_hook(nullptr);
  expect_done(bench);
  expect_same(bench.station->sequence().results(), sound_results(machine, options));
}

/// A speed that the machine does not keep: the ramp's own is more.
TEST(over_speed) {
  const machines::SimulatedExcavator& machine = test::excavator();
  SequenceOptions options = test::one_drive(machine, kArm);
  options.window[kArm].most_mps = 0.015;
  CommissionBench bench(machine, options);
  bench.begin_watch();
  expect_stop(bench, 40.0, Fault::kCommissionBound);
  assert_true(bench.strayed_m < kWrong_m);
}

void let_go_for_a_second(CommissionBench& bench) {
  const std::size_t done = bench.station->sequence().results().size();
  bench.hands.deadman = false;
  bench.run(0.03);
  assert_true(bench.neutral());
  assert_int_equal(bench.fault(), Fault::kNone);
  bench.run(1.0);
  assert_int_equal(bench.station->sequence().results().size(), done);
  bench.hands.deadman = true;
}

/// In every kind of step: neutral at once, nothing is lost, and the step begins again.
TEST(the_operator_lets_go_in_every_step) {
  const machines::SimulatedExcavator& machine = test::excavator();
  SequenceOptions options = test::one_drive(machine, kBucket);
  options.steps = true;
  options.bursts = true;
  options.window[kBucket].least_m = 0.0;
  options.touch_retracted[kBucket] = true;
  CommissionBench bench(machine, options);
  bench.hands.deadman = true;
  const auto& sequence = bench.station->sequence();
  for (std::size_t at = 0; at < sequence.steps().size(); ++at) {
    const auto has_passed = [&] { return sequence.at() > at; };
    assert_true(bench.run_until([&] { return bench.duty() > 0.1 || has_passed(); }, 60.0));
    if (!has_passed()) {
      bench.run(0.1);
      let_go_for_a_second(bench);
    }
    assert_true(bench.run_until(has_passed, 60.0));
  }
  bench.run_to_end();
  assert_int_equal(bench.station->end(), CommissionEnd::kDone);
  const Results& results = bench.station->sequence().results();
  assert_int_equal(results.size(), bench.station->sequence().steps().size());
  const Results sound = sound_results(machine, options);
  assert_near(results[0].duty, sound[0].duty, 0.06);
  assert_near(results[1].duty, sound[1].duty, 0.06);
}

/// By the station: both sides, within the sector; let go in the middle it is neutral, and goes on.
TEST(the_swing_is_led_and_let_go) {
  SequenceOptions options = test::one_drive(test::excavator_12t(), -1);
  options.sector = {-0.4, 0.35, 0.5};
  CommissionBench bench(test::excavator_12t(), options);
  bench.hands.deadman = true;
  const auto turned_rad = [&] { return bench.plant.plant().swing_rad(); };
  assert_true(bench.run_until([&] { return turned_rad() > 0.01; }, 30.0));
  bench.hands.deadman = false;
  bench.run(0.1);
  assert_true(bench.neutral());
  bench.run(1.0);
  assert_int_equal(bench.station->end(), CommissionEnd::kNone);
  bench.hands.deadman = true;
  double least_rad = 0.0;
  double most_rad = 0.0;
  assert_true(bench.run_until(
      [&] {
        least_rad = std::min(least_rad, turned_rad());
        most_rad = std::max(most_rad, turned_rad());
        return bench.station->end() != CommissionEnd::kNone;
      },
      60.0));
  assert_int_equal(bench.station->end(), CommissionEnd::kDone);
  assert_true(least_rad > options.sector.right_rad && most_rad < options.sector.left_rad);
  const Results& results = bench.station->sequence().results();
  assert_int_equal(results.size(), 3);  // Of the links no edge is known: they stay.
  for (const std::size_t at : {1U, 2U}) {
    assert_int_equal(results[at].end, commission::StepEnd::kDone);
    assert_true(results[at].duty > 0.2 && results[at].duty < 0.4);
  }
}

/// Outside its sector it is not tried.
TEST(a_swing_outside_its_sector_stays) {
  SequenceOptions options = test::one_drive(test::excavator_12t(), -1);
  options.sector = {0.3, 0.95, 0.5};
  CommissionBench bench(test::excavator_12t(), options);
  bench.hands.deadman = true;
  expect_done(bench);
  for (const std::size_t at : {1U, 2U}) {
    assert_int_equal(bench.station->sequence().results()[at].end, commission::StepEnd::kOutside);
  }
  assert_near(bench.plant.plant().swing_rad(), 0.0, 1e-3);
}
