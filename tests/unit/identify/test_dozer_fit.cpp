// SPDX-License-Identifier: Apache-2.0
// A dozer from series that a test makes: what is found is what was put in, and what was not driven
// is not found.

#include "app/identify/dozer/dozer_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/identify/dozer/blade_fit.hpp"
#include "app/identify/dozer/dozer_text.hpp"
#include "app/identify/dozer/lag_fit.hpp"
#include "app/machines/dozer_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben;
using namespace graben::identify;

namespace {

const machines::DozerMachine& shipped() {
  static const machines::DozerMachine machine =
      machines::load_dozer(machines::find_profile("dozer_9t"));
  return machine;
}

/// A blade and tracks that answer as they are told here.
struct Truth {
  double edge = 0.27;
  double exponent = 1.2;
  double valve_flow_m3ps = 1.8e-3;
  double pump_factor = 0.95;
  double dead_s = 0.04;
  double lag_s = 0.05;
  double track_factor = 1.04;
  double pump_lag_s = 0.12;
  bool extends = true;  ///< The blade is driven to that side too.
  bool drives = true;   ///< So are the tracks.
};

double opened(const Truth& truth, double spool) {
  const double way = (std::abs(spool) - truth.edge) / (1.0 - truth.edge);
  return way > 0.0 ? std::pow(way, truth.exponent) : 0.0;
}

/// Duties of both sides by turns, each longer than all that is late.
double duty_at(const Truth& truth, std::size_t at) {
  constexpr std::array<double, 10> kDuties = {0.30, 0.33, 0.37, 0.42, 0.50,
                                              0.60, 0.70, 0.80, 0.90, 1.0};
  const std::size_t step = at / 120;
  const double sign = step % 2 == 0 ? -1.0 : 1.0;
  // As much oil to either side: it comes back to where it was.
  const bool rests = at % 120 > (sign > 0.0 ? 80 : 56);
  return rests || (sign > 0.0 && !truth.extends) ? 0.0 : sign * kDuties[(step / 2) % 10];
}

DozerLog log_of(const Truth& truth) {
  constexpr std::size_t kPoints = 6000;
  const DozerProfile& profile = shipped().profile;
  const BladeMachine machine = blade_machine(profile, 0);
  DozerLog log;
  log.name = "made";
  DozerSegment part;
  BladeSeries& blade = part.blade[0];
  std::array<double, 2> spool{};
  double stroke_m = 0.15;
  double pump = 0.0;
  const double engine_radps = profile.hst.engine_radps;
  const double full_mps = engine_radps * profile.hst.pump_m3prev / profile.hst.motor_m3prev /
                          profile.hst.gear_ratio * profile.hst.pump_efficiency *
                          profile.hst.motor_efficiency * profile.hst.sprocket_radius_m;
  const auto late = static_cast<std::size_t>(std::lround(truth.dead_s / kGrid_s));
  for (std::size_t at = 0; at < kPoints; ++at) {
    const double sent = at > late ? duty_at(truth, at - 1 - late) : 0.0;
    const double share = -std::expm1(-2.0 * kGrid_s / truth.lag_s);
    spool[0] += share * (sent - spool[0]);
    spool[1] += share * (spool[0] - spool[1]);
    const double flow_m3ps = std::min(truth.valve_flow_m3ps * opened(truth, spool[1]),
                                      truth.pump_factor * machine.pump_m3prad * engine_radps);
    stroke_m += kGrid_s * (spool[1] > 0.0 ? flow_m3ps / machine.extend_area_m2
                                          : -flow_m3ps / machine.retract_area_m2);
    stroke_m = stroke_m < 0.01 || stroke_m > machine.stroke_m - 0.01 ? 0.15 : stroke_m;
    blade.duty.push_back(duty_at(truth, at));
    blade.spool.push_back(spool[1]);
    blade.stroke_m.push_back(stroke_m);
    const double pump_sent = truth.drives && at % 300 > 150 ? (at % 600 > 300 ? 0.5 : -0.5) : 0.0;
    pump += -std::expm1(-kGrid_s / truth.pump_lag_s) * (pump_sent - pump);
    for (TrackSeries& track : part.track) {
      track.pump_sent.push_back(pump_sent);
      track.motor_sent.push_back(1.0);
      track.pump.push_back(pump);
      track.motor.push_back(1.0);
      track.speed_mps.push_back(truth.track_factor * full_mps * pump);
      track.line_pa.push_back(5e6);
    }
    part.velocity_mps.push_back(truth.track_factor * full_mps * pump);
    part.engine_radps.push_back(engine_radps);
  }
  log.segments.push_back(part);
  return log;
}

}  // namespace

TEST(what_was_put_in_is_found) {
  for (const double edge : {0.14, 0.27, 0.44}) {
    Truth truth;
    truth.edge = edge;
    const DozerEstimate found = identify_dozer(shipped().profile, {log_of(truth)});
    for (const bool extends : {true, false}) {
      const BladeSideEstimate& side = found.blade[0].side(extends);
      assert_true(side.known());
      assert_near(side.edge.value, edge, 0.015);
      assert_near(side.dead_time_s.value, truth.dead_s, 0.008);
      assert_near(side.lag_s.value, truth.lag_s, 0.02);
    }
    assert_near(found.blade[0].valve_flow_m3ps.value, truth.valve_flow_m3ps, 0.04e-3);
    assert_true(found.pump_flow_factor.known);
    assert_near(found.pump_flow_factor.value, truth.pump_factor, 0.01);
    assert_near(found.travel.speed_factor().value, truth.track_factor, 0.003);
    assert_near(found.travel.pump_lag_s.value, truth.pump_lag_s, 0.01);
  }
}

TEST(its_profile_predicts_what_the_old_one_does_not) {
  const Truth truth;
  const std::vector<DozerLog> logs = {log_of(truth)};
  const DozerProfile& old = shipped().profile;
  const DozerProfile found = identified_dozer(old, identify_dozer(old, logs));
  const DozerScore before = score_dozer(old, logs);
  const DozerScore after = score_dozer(found, logs);
  print_message("off: %.3f of the speed, %.3f before\n", after[0], before[0]);
  assert_true(after[0] < 0.35 * before[0]);
  assert_true(after[2] < 0.5 * before[2]);
  assert_true(after[1] < 0.0);  // It has no tilt.
  const double full_mps = steady_blade_mps(found, 0, -1.0, old.hst.engine_radps);
  assert_near(full_mps,
              -truth.pump_factor * blade_machine(old, 0).pump_m3prad * old.hst.engine_radps /
                  blade_machine(old, 0).retract_area_m2,
              0.01 * std::abs(full_mps));
}

TEST(what_was_not_driven_is_named_and_stays) {
  Truth truth;
  truth.extends = false;
  truth.drives = false;
  const DozerProfile& old = shipped().profile;
  const DozerEstimate found = identify_dozer(old, {log_of(truth)});
  assert_false(found.blade[0].extend.known());
  assert_true(found.blade[0].retract.known());
  assert_false(found.travel.known());
  const auto named = [&](const std::string& what) {
    return std::any_of(found.missing.begin(), found.missing.end(), [&](const std::string& line) {
      return line.find(what) != std::string::npos;
    });
  };
  assert_true(named("not found: blade, extend"));
  assert_true(named("not found: tracks"));
  const DozerProfile now = identified_dozer(old, found);
  assert_int_equal(now.answer[0].extend.spool_to_duty.size(), 0);
  assert_near(now.hst.pump_m3prev, old.hst.pump_m3prev, 0.0);
  assert_near(now.hst.response_s, old.hst.response_s, 0.0);
  for (const DozerChange& change : dozer_changes(shipped(), found)) {
    assert_null(strstr(change.path().c_str(), "extend"));
    assert_null(strstr(change.path().c_str(), "hst."));
  }
}

TEST(nothing_that_moves_is_an_error) {
  DozerLog log = log_of({});
  for (BladeSeries& blade : log.segments[0].blade) {
    std::fill(blade.duty.begin(), blade.duty.end(), 0.0);
    std::fill(blade.spool.begin(), blade.spool.end(), 0.0);
  }
  for (TrackSeries& track : log.segments[0].track) {
    std::fill(track.pump.begin(), track.pump.end(), 0.0);
  }
  bool refused = false;
  try {
    static_cast<void>(identify_dozer(shipped().profile, {log}));
  } catch (const std::runtime_error&) {
    refused = true;
  }
  assert_true(refused);
}
