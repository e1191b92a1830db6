// SPDX-License-Identifier: Apache-2.0
// What is found of a machine from its log: curves, dead times, lags, zeros.

#include <algorithm>
#include <stdexcept>
#include <string>

#include "app/identify/machine/identified_profile.hpp"
#include "app/identify/machine/log_checks.hpp"
#include "app/identify/machine/machine_fit.hpp"
#include "app/identify/machine/swing_figures.hpp"
#include "app/identify/machine/valve_model.hpp"
#include "app/machines/simulated/hidden.hpp"
#include "app/runs/commission_run.hpp"
#include "app/runs/drive_speeds.hpp"
#include "app/runs/identify_run.hpp"
#include "app/runs/known_machine.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/can_frame.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

void nothing(double, const std::string&) {}

/// A hidden machine's log, and what is made of it. Of pumps that set their own swash no frame is
/// seen.
struct Commissioned {
  Commissioned(const machines::SimulatedExcavator& nominal, std::uint64_t seed)
      : machine(runs::hidden_with_noise(nominal, seed)), truth(machines::truth_of(machine.plant)) {
    const bool told = !machine.profile.pump[0].regulator.sets_swash();
    LogCollector frames("bus");
    const runs::CommissionResult run = runs::run_commission(
        machine, runs::usual_commission(machine),
        [&](const LoggedFrame& frame) {
          if (told || !same_message(frame.id, dbc::excavator::PumpState::kId)) {
            frames.take(frame);
          }
        },
        nothing);
    assert_int_equal(run.end, runs::CommissionEnd::kDone);
    assert_true(run.machine_s < 300.0);
    logs.push_back(frames.log(machine.profile.pump_count, 0.0, told));
    found = identify_machine(DriveModel(machine.profile), logs, nothing);
  }

  [[nodiscard]] bool says(const std::string& words) const {
    return std::any_of(found.missing.begin(), found.missing.end(), [&](const std::string& each) {
      return each.find(words) != std::string::npos;
    });
  }

  machines::SimulatedExcavator machine;
  machines::MachineTruth truth;
  std::vector<MachineLog> logs;
  MachineEstimate found;
};

TEST(a_hidden_machine_is_found) {
  const Commissioned commissioned(test::excavator(), 11);
  const runs::IdentificationErrors errors =
      runs::errors_of(commissioned.machine.profile, commissioned.found, commissioned.truth);
  assert_true(errors.edge_ratio < 0.013);
  assert_true(errors.dead_time_s < 0.010);
  assert_true(errors.lag_s < 0.010);
  assert_true(errors.stroke_zero_m < 0.001);
  assert_true(errors.pressure_zero_pa < 0.6e6);
  assert_true(errors.pump_flow < 0.04);
  assert_true(errors.speed.most < 0.06);
  assert_int_equal(errors.speed.sides, 6);
  assert_in_range(errors.speed.within, 3, 6);
  // A side that nobody drove has no speed.
  MachineEstimate none = commissioned.found;
  for (DriveEstimate& drive : none.drive) {
    for (SideEstimate* side : {&drive.extend, &drive.retract}) {
      side->driven_least = 1.0;
      side->driven_most = 0.0;
    }
  }
  const runs::SpeedErrors undriven =
      runs::speed_errors(commissioned.machine.profile, none,
                         runs::known_machine(commissioned.machine.profile, commissioned.truth));
  assert_int_equal(undriven.within, 0);
  assert_true(errors.within_share() > 0.8);
}

/// What its pumps give is known by the drives' speeds alone; a pump that no drive uses up is not.
TEST(a_machine_that_senses_its_load_is_found) {
  const auto nominal =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t_ls"));
  const Commissioned commissioned(nominal, 1);
  const runs::IdentificationErrors errors =
      runs::errors_of(commissioned.machine.profile, commissioned.found, commissioned.truth);
  assert_true(errors.edge_ratio < 0.02);
  assert_true(errors.dead_time_s < 0.010);
  assert_true(errors.lag_s < 0.010);
  assert_true(errors.pressure_zero_pa < 0.6e6);
  assert_true(errors.speed.most < 0.05);
  assert_true(errors.within_share() > 0.8);
  assert_true(commissioned.found.pump_flow_factor[1].known);
  assert_near(commissioned.found.pump_flow_factor[1].value, commissioned.truth.pump_flow_factor[1],
              0.02);
  assert_true(commissioned.says("pump 1: its flow keeps its old value"));
  assert_true(commissioned.says("pump 1: its margin and its response keep their old values"));
  assert_true(commissioned.says("pump 2: its margin and its response keep their old values"));
}

/// Its arm has to be pushed to its end: the line's pressure grows with the opening. Where it begins
/// to move, a small error of the edge is a large one of the speed: that is held where it is open.
TEST(a_machine_under_negative_flow_is_found) {
  const auto nominal =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t_nfc"));
  const Commissioned commissioned(nominal, 3);
  const MachineEstimate& found = commissioned.found;
  const runs::IdentificationErrors errors =
      runs::errors_of(commissioned.machine.profile, found, commissioned.truth);
  assert_true(errors.edge_ratio < 0.05);
  assert_true(errors.dead_time_s < 0.010);
  assert_true(errors.stroke_zero_m < 0.001);
  assert_true(errors.pump_flow < 0.02);
  assert_near(found.closes_at_factor * 0.25, commissioned.truth.bypass_closes_at, 0.06);
  assert_true(commissioned.says("the pumps' least swash and response"));
}

/// A bypass closes over the travel, and each side has opened another share of its edges by then:
/// with that said of each side, a profile has the machine's speeds; with one opening of all it has
/// not.
TEST(each_side_closes_its_bypass_by_its_own_curve) {
  const auto nominal =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t_nfc"));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MachineEstimate truth = runs::known_machine(
        nominal.profile, machines::truth_of(machines::hidden_machine(nominal, seed).plant));
    MachineEstimate of_all = truth;
    for (DriveEstimate& drive : of_all.drive) {
      drive.extend.bypass_closed_at = drive.retract.bypass_closed_at = 0.0;
    }
    // Known no better than before, it goes with the curves that it was fitted with.
    MachineEstimate unsure = truth;
    unsure.bypass_closes_at.known = false;
    for (RegulatorEstimate& regulator : unsure.regulator) {
      regulator.full_swash_pa.known = regulator.least_swash_pa.known = false;
    }
    assert_true(runs::speed_errors(nominal.profile, truth, truth).most < 0.12);
    assert_near(runs::speed_errors(nominal.profile, unsure, truth).most,
                runs::speed_errors(nominal.profile, truth, truth).most, 0.0);
    assert_true(runs::speed_errors(nominal.profile, of_all, truth).most > 0.15);
  }
}

/// A pump whose swash follows its bypass fills the chamber too while its pressure rises: the speed
/// then says nothing of the edge, also under negative flow.
TEST(a_rising_pressure_says_no_speed) {
  for (const char* const name : {"excavator_22t_nfc", "excavator_22t_ls"}) {
    const auto nominal = machines::load_simulated_excavator(machines::find_profile(name));
    const DriveModel model(nominal.profile);
    const MachineEstimate machine = estimate_of(model);
    const auto says_speed = [&](double cap_rise_paps, double rod_rise_paps) {
      SteadyPoint at;
      at.axis = kBucket;
      at.spool = at.all_spool[kBucket] = 0.4;
      at.speed_mps = at.all_speed_mps[kBucket] = 0.05;
      at.cap_pa[kBucket] = 5e6;
      at.engine_radps = nominal.profile.pump[0].rated_speed_radps;
      at.cap_rise_paps = cap_rise_paps;
      at.rod_rise_paps = rod_rise_paps;
      return PreparedPoint(model, at, machine.drive).says_speed();
    };
    assert_true(says_speed(0.0, 20e6));
    assert_false(says_speed(20e6, 0.0));
    assert_false(says_speed(-20e6, 0.0));
  }
}

/// Its truth as an estimate has no error, and gives back what it is made of.
TEST(what_is_known_is_without_error) {
  const machines::SimulatedExcavator machine = machines::hidden_machine(test::excavator(), 5);
  const machines::MachineTruth truth = machines::truth_of(machine.plant);
  const MachineEstimate known = runs::known_machine(machine.profile, truth);
  const ExcavatorProfile exact = identified(machine.profile, known);
  assert_near(runs::speed_errors(machine.profile, known, known).most, 0.0, 0.0);
  MachineEstimate weaker = known;
  weaker.pump_flow_factor = {};
  for (Estimate& factor : weaker.pump_flow_factor) {
    factor.value = 0.9;
  }
  assert_true(runs::speed_errors(machine.profile, weaker, known).most > 0.05);
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const auto& side = truth.drive[axis].extend;
    assert_near(exact.valve.spool[axis].extend_in_m2, side.in_m2, 1e-3 * side.in_m2);
    assert_near(exact.valve.spool[axis].extend_out_m2, side.out_m2, 1e-3 * side.out_m2);
    assert_near(exact.valve.answer[axis].extend.dead_time_s, side.dead_time_s, 1e-12);
    assert_near(exact.sensor_zero.stroke_m[axis], truth.drive[axis].stroke_zero_m, 1e-12);
  }
}

TEST(a_curve_and_its_inverse) {
  const OpeningCurve curve = {0.3, 0.02, 1.6};
  for (const double travel : {0.25, 0.3, 0.35, 0.6, 1.0}) {
    assert_near(curve.travel_at(curve.area_ratio(travel)), travel, 1e-9);
  }
  assert_near(curve.area_ratio(1.0), 1.0, 1e-12);
  assert_true(curve.area_ratio(0.2) < curve.area_ratio(0.3));
}

/// A log in which a drive is not moved says so, and its values stay.
TEST(what_is_not_driven_is_said) {
  machines::SimulatedExcavator machine = test::excavator();
  runs::CommissionOptions options = runs::usual_commission(machine);
  options.sequence.drives = {false, true, false};
  LogCollector frames("bus");
  const auto run = runs::run_commission(
      machine, options, [&](const LoggedFrame& frame) { frames.take(frame); }, nothing);
  assert_int_equal(run.end, runs::CommissionEnd::kDone);
  const MachineEstimate found = identify_machine(DriveModel(machine.profile),
                                                 {frames.log(machine.profile.pump_count)}, nothing);
  assert_false(found.drive[kBucket].extend.edge.known);
  assert_true(found.drive[kArm].extend.edge.known);
  bool said = false;
  for (const std::string& each : found.missing) {
    said = said || each.find("bucket, extend: was not driven") != std::string::npos;
  }
  assert_true(said);
  const ExcavatorProfile better = identified(machine.profile, found);
  assert_int_equal(better.valve.answer[kBucket].extend.spool_to_duty.size(), 0);
  assert_near(better.valve.spool[kBucket].extend_in_m2,
              machine.profile.valve.spool[kBucket].extend_in_m2, 0.0);
}

/// The platform turns by 0.3 rad/s, is told to stop after 0.5 s, and stands `after` grid points on,
/// unless the log ends before.
bool coasting_is_told(std::size_t after) {
  const ExcavatorProfile profile = test::excavator_12t().profile;
  LogSegment segment;
  segment.drives = kDriveCount;
  segment.engine_radps.assign(200, 150.0);
  for (CylinderSeries& series : segment.axis) {
    for (std::vector<double>* values :
         {&series.duty, &series.spool, &series.stroke_m, &series.cap_pa, &series.rod_pa}) {
      values->assign(segment.size(), 0.0);
    }
  }
  CylinderSeries& swing = segment.axis[kSwing];
  for (std::size_t n = 0; n < segment.size(); ++n) {
    const auto turned = static_cast<double>(std::min(n, 50 + after));
    swing.duty[n] = n < 50 ? 0.5 : 0.0;
    swing.stroke_m[n] = 0.3 * kGrid_s * turned * profile.swing.lever_m;
  }
  MachineLog log;
  log.segments = {segment};
  return find_swing(profile, {log}).left.known;
}

TEST(a_coasting_without_its_end_is_not_told) {
  assert_true(coasting_is_told(40));
  assert_false(coasting_is_told(500));
}

/// Of a machine with a swing all of it is found, and what was not driven is said.
TEST(a_swing_is_found) {
  const machines::SimulatedExcavator machine = runs::hidden_with_noise(test::excavator_12t(), 5);
  const ExcavatorProfile& profile = machine.profile;
  runs::CommissionOptions options = runs::usual_commission(machine);
  options.sequence.drives = {false, false, false};
  LogCollector frames("bus");
  const auto run = runs::run_commission(
      machine, options, [&](const LoggedFrame& frame) { frames.take(frame); }, nothing);
  assert_int_equal(run.end, runs::CommissionEnd::kDone);
  const std::vector<MachineLog> logs = {frames.log(profile.pump_count, swing_lever_m(profile))};
  const auto& angles_m = logs[0].segments[0].axis[kSwing].stroke_m;
  const auto [right, left] = std::minmax_element(angles_m.begin(), angles_m.end());
  assert_true(*right > options.sequence.sector.right_rad * profile.swing.lever_m);
  assert_true(*left < options.sequence.sector.left_rad * profile.swing.lever_m);
  assert_true(*left - *right > 0.4 * profile.swing.lever_m);
  MachineEstimate found = identify_machine(DriveModel(profile), logs, nothing);
  found.swing = find_swing(profile, logs);
  const machines::DriveTruth truth = machines::truth_of(machine.plant).drive[kSwing];
  for (const bool left_side : {true, false}) {
    const SideEstimate& side = found.drive[kSwing].side(left_side);
    const machines::SideTruth& truly = left_side ? truth.extend : truth.retract;
    assert_true(side.edge.known);
    assert_near(side.dead_time_s.value, truly.dead_time_s, 0.010);
    const auto known = runs::known_machine(profile, machines::truth_of(machine.plant));
    assert_true(runs::swing_speed_error(profile, found, known, left_side) < 0.06);
    const SwingCoast& coast = left_side ? found.swing.left : found.swing.right;
    assert_true(coast.known && coast.angle_rad > 0.05 && coast.angle_rad < 0.5);
    assert_true(coast.most_pa > 5e6);
  }
  assert_near(found.drive[kSwing].lag_s(), truth.extend.lag_s, 0.010);
  assert_true(found.swing.inertia_kgm2.known);
  bool said = false;
  for (const std::string& each : found.missing) {
    said = said || each.find("boom, extend: was not driven") != std::string::npos;
    assert_true(each.find("swing, left: was not driven") == std::string::npos);
  }
  assert_true(said);
  const ExcavatorProfile better = identified(profile, found);
  assert_true(better.valve.answer[kSwing].extend.spool_to_duty.size() > 2);
  assert_near(better.swing.inertia_kgm2, found.swing.inertia_kgm2.value, 0.0);
}

TEST(a_log_that_says_nothing_is_refused) {
  LogCollector empty("empty.log");
  graben::test::expect_refusal([&] { return empty.log(2); }, "empty.log");
}
