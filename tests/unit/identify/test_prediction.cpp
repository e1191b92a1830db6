// SPDX-License-Identifier: Apache-2.0
/// What a profile alone predicts, how it is judged, and what is left out for that.

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/identify/machine/log_split.hpp"
#include "app/identify/machine/prediction_score.hpp"
#include "app/machines/excavator_file.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/evaluation.hpp"
#include "tests/fuzz/endless_work.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

constexpr double kEngine_radps = 188.5;

const ExcavatorProfile& machine() {
  static const ExcavatorProfile profile =
      machines::load_excavator(machines::find_profile("excavator_22t")).profile;
  return profile;
}

ValveMoment moment(double boom, double arm, double bucket) {
  ValveMoment now;
  now.opening = {boom, arm, bucket};
  now.cap_pa = {9e6, 7e6, 6e6};
  now.rod_pa = {4e6, 5e6, 5e6};
  now.swash = {0.64, 0.64};
  now.engine_radps = kEngine_radps;
  return now;
}

/// The controller's own way, from speeds to openings, must lead back.
TEST(speeds_are_those_that_need_these_openings) {
  const McvMachine valve = mcv_machine(machine());
  const std::array<ValveMoment, 4> moments = {moment(0.5, 0.0, 0.0), moment(0.0, -0.4, 0.0),
                                              moment(0.45, 0.5, -0.3), moment(-0.3, 0.35, 0.4)};
  for (const ValveMoment& now : moments) {
    const std::array<double, kDriveCount> speed_mps = DriveModel(machine()).speeds_mps(now);
    McvInput input;
    for (std::size_t k = 0; k < kAxisCount; ++k) {
      assert_true((speed_mps[k] != 0.0) == (now.opening[k] != 0.0));
      assert_true(speed_mps[k] * now.opening[k] >= 0.0);
      input.velocity_mps[k] = speed_mps[k];
      input.cap_pressure_pa[k] = now.cap_pa[k];
      input.rod_pressure_pa[k] = now.rod_pa[k];
    }
    for (std::size_t j = 0; j < kPumpCount; ++j) {
      input.pump_flow_m3ps[j] = pump_flow_m3ps(machine().pump[j], kEngine_radps, now.swash[j]);
    }
    const McvCircuit circuit = make_circuit(valve, input, test::endless_work());
    McvPoint point = evaluate(circuit, 1.0);
    open_spools(circuit, point);
    for (std::size_t k = 0; k < kAxisCount; ++k) {
      assert_near(point.spool_m[k] / machine().valve.spool_travel_m, now.opening[k], 2e-3);
    }
  }
}

TEST(a_load_that_drives_is_held_by_the_draining_edge) {
  ValveMoment now = moment(-0.3, 0.0, 0.0);
  now.rod_pa[kBoom] = 0.0;
  now.cap_pa[kBoom] = 8e6;
  const double slow_mps = DriveModel(machine()).speeds_mps(now)[kBoom];
  now.cap_pa[kBoom] = 16e6;
  const double fast_mps = DriveModel(machine()).speeds_mps(now)[kBoom];
  assert_true(slow_mps < 0.0);
  assert_near(fast_mps / slow_mps, std::sqrt(2.0), 1e-9);
}

/// Boom's duty as told, the others at rest, strokes in mid range.
LogSegment segment(const std::vector<double>& duty) {
  LogSegment made;
  for (std::size_t k = 0; k < kAxisCount; ++k) {
    CylinderSeries& axis = made.axis[k];
    axis.duty = k == 0 ? duty : std::vector<double>(duty.size(), 0.0);
    axis.spool = axis.duty;
    axis.stroke_m.assign(duty.size(), 0.5);
    axis.cap_pa.assign(duty.size(), 9e6);
    axis.rod_pa.assign(duty.size(), 4e6);
  }
  for (std::vector<double>& swash : made.swash) {
    swash.assign(duty.size(), 0.64);
  }
  made.engine_radps.assign(duty.size(), kEngine_radps);
  return made;
}

std::size_t starts_at(const ExcavatorProfile& profile, const MachineLog& log) {
  const std::vector<double> speed_mps =
      predict_logs(DriveModel(profile), {log})[0][0].axis[kBoom].predicted_mps;
  std::size_t at = 0;
  while (at < speed_mps.size() && std::abs(speed_mps[at]) < 0.01) {
    ++at;
  }
  return at;
}

TEST(dead_time_and_edge_are_in_it) {
  std::vector<double> duty(300, 0.0);
  std::fill(duty.begin() + 100, duty.end(), 0.5);
  MachineLog log;
  log.segments = {segment(duty)};
  ExcavatorProfile late = machine();
  late.valve.answer[kBoom].extend.dead_time_s = 0.15;
  const std::size_t soon = starts_at(machine(), log);
  assert_true(soon > 90 && soon < 110);
  assert_int_equal(starts_at(late, log), soon + 15);
  late.valve.answer[kBoom].extend.dead_time_s = kUnsaid_s;
  late.valve.answer[kBoom].retract.dead_time_s = 0.15;
  assert_int_equal(starts_at(late, log), soon);
  std::fill(duty.begin() + 100, duty.end(), 0.19);
  log.segments = {segment(duty)};
  assert_int_equal(starts_at(machine(), log), duty.size());
}

TEST(a_shut_valve_is_not_judged) {
  std::vector<double> duty(600, 0.0);
  std::fill(duty.begin() + 100, duty.begin() + 200, 0.5);
  MachineLog log;
  log.segments = {segment(duty)};
  const std::vector<bool> judged =
      predict_logs(DriveModel(machine()), {log})[0][0].axis[kBoom].judged;
  assert_true(!judged[99] && judged[100] && judged[250] && !judged[270]);
}

/// Predicted: pulses of two heights; measured: `ratio` of them, so many grid points later.
std::vector<std::vector<PredictedSegment>> pulses(double ratio, std::size_t late) {
  PredictedSegment made;
  for (PredictedAxis& axis : made.axis) {
    axis.predicted_mps.assign(2000, 0.0);
    axis.measured_mps.assign(2000, 0.0);
    axis.judged.assign(2000, true);
  }
  PredictedAxis& arm = made.axis[kArm];
  for (std::size_t at = 0; at < 2000; ++at) {
    const auto speed = [](std::size_t n) {
      return n % 400 < 150 ? (n % 800 < 400 ? 0.1 : 0.2) : 0.0;
    };
    arm.predicted_mps[at] = speed(at);
    arm.measured_mps[at] = at < late ? 0.0 : ratio * speed(at - late);
  }
  return {{made}};
}

TEST(slower_and_later_are_told_apart) {
  const std::vector<LogStretch> all = {{0, 0, 0, 2000}};
  const PredictionScore same = score(pulses(1.0, 0), all);
  assert_near(same.share(), 0.0, 1e-12);
  assert_near(same.axis[kArm].extend.r2, 1.0, 1e-12);
  assert_true(score_sentences(same).empty());
  const PredictionScore off = score(pulses(0.92, 4), all);
  assert_near(off.axis[kArm].extend.speed_ratio, 0.92, 1e-9);
  assert_near(off.axis[kArm].extend.late_s, 0.04, 0.003);
  assert_near(most_off(off), 0.08, 1e-9);
  assert_true(off.axis[kArm].retract.moving_s == 0.0 && off.axis[kBoom].share() == 0.0);
  const std::vector<std::string> said = score_sentences(off);
  assert_int_equal(said.size(), 2);
  assert_string_equal(said[0].c_str(), "the arm, extending, is 8 % slower than the profile says");
  assert_true(said[1].find("the arm, extending, answers 4") == 0);
  assert_true(said[1].find(" ms later than the profile says") != std::string::npos);
}

TEST(a_measured_spool_tells_how_late_it_is) {
  PredictionScore off = score(pulses(1.0, 4), {{0, 0, 0, 2000}});
  DriveEstimates found;
  judge_spools(DriveModel(machine()), found, off);
  assert_near(off.axis[kArm].extend.late_s, 0.04, 0.004);
  // The shipped machine has no dead time and twice 20 ms.
  found[kArm].extend.dead_time_s = {0.100, 0.002, true};
  found[kArm].pilot_lag_s.value = 0.010;
  found[kArm].spool_time_constant_s.value = 0.025;
  judge_spools(DriveModel(machine()), found, off);
  assert_near(off.axis[kArm].extend.late_s, 0.120, 1e-12);
  assert_true(!off.axis[kArm].retract.has_delay);
}

/// 60 s in which the boom goes out and in every 5 s, or stands.
MachineLog log_of(bool moves) {
  std::vector<double> duty(6000, 0.0);
  LogSegment made = segment(duty);
  for (std::size_t at = 1; at < duty.size(); ++at) {
    const double way = at % 1000 < 500 ? 1.0 : -1.0;
    made.axis[kBoom].duty[at] = moves ? 0.5 * way : 0.0;
    made.axis[kBoom].stroke_m[at] = made.axis[kBoom].stroke_m[at - 1] + (moves ? 0.001 * way : 0.0);
  }
  MachineLog log;
  log.segments = {made};
  return log;
}

bool is_refused(const std::vector<MachineLog>& logs) {
  return !graben::test::refusal_of([&] { return split_logs(logs); }).empty();
}

TEST(what_judges_is_not_fitted) {
  const LogSplit split = split_logs({log_of(true)});
  // Six stretches out, six in; the third of each.
  assert_int_equal(split.judged.size(), 2);
  assert_int_equal(split.judged[0].begin, 2000);
  assert_int_equal(split.judged[1].begin, 2500);
  assert_near(split.fitted_s + split.judged_s, 60.0, 1e-9);
  std::size_t points = 0;
  for (const LogSegment& part : split.fitted[0].segments) {
    points += part.size();
    assert_int_equal(part.axis[kBoom].stroke_m.size(), part.size());
  }
  assert_int_equal(points, 5000);
  assert_near(split.fitted[0].segments[1].begin_s, 30.0, 1e-9);
  const LogSplit two = split_logs({log_of(true), log_of(true)});
  assert_int_equal(two.fitted.size(), 1);
  assert_int_equal(two.judged.size(), 12);
  assert_int_equal(two.judged[0].log, 1);
  assert_true(is_refused({log_of(false)}));
  assert_true(is_refused({log_of(true), log_of(false)}));
}
