// SPDX-License-Identifier: Apache-2.0
#include "app/runs/dozer_identify_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/identify/dozer/dozer_fit.hpp"
#include "app/plant/dozer_plant.hpp"
#include "app/runs/dozer_commission_run.hpp"
#include "app/runs/grade_run.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

constexpr double kSpeedWithin = 0.03;
constexpr double kBand = 1.96;
/// Beside pilot and spool: oil of cylinder and hoses.
constexpr double kOilLag_s = 0.005;
/// Where a logistic opening has as much at its edge as a parabola over this softness.
constexpr double kSoftPerSoftness = 0.180;

identify::Estimate exactly(double value) { return {value, 0.0, true}; }

identify::BladeSideEstimate known_side(const plant::BladeValve& valve, bool extends) {
  const plant::SpoolSide& of = extends ? valve.spool.extend : valve.spool.retract;
  identify::BladeSideEstimate side;
  side.curve = {of.deadband_ratio, std::max(1e-3, kSoftPerSoftness * of.softness_ratio),
                of.opening_exponent};
  side.edge = exactly(of.deadband_ratio);
  side.dead_time_s = exactly(extends ? valve.dead_time.extend_s : valve.dead_time.retract_s);
  side.lag_s = exactly(valve.pilot_lag_s + 2.0 * valve.spool.time_constant_s + kOilLag_s);
  side.driven_least = of.deadband_ratio;
  side.driven_most = 1.0;
  return side;
}

/// Of what (9) gives by the profile, each track to each side, by the plant alone on the level.
void know_tracks(const machines::SimulatedDozer& hidden, identify::TravelEstimate& travel) {
  constexpr double kPump = 0.5;
  constexpr TimeUs kRun_us = 3 * kSecondUs;
  for (const int side : {1, -1}) {
    plant::DozerPlant plant(hidden.plant);
    plant.set_brake(false);
    plant.set_displacements({side * kPump, side * kPump}, {1.0, 1.0});
    plant.advance(kRun_us);
    const double modelled_mps = track_speed_mps(
        hidden.profile.hst, hidden.plant.machine.hst.engine_radps, side * kPump, 1.0);
    for (std::size_t i = 0; i < kTrackCount; ++i) {
      (side > 0 ? travel.forward : travel.back)[i].speed_factor =
          exactly(plant.track_speeds_mps()[i] / modelled_mps);
    }
  }
  travel.pump_dead_time_s = exactly(hidden.plant.displacement_dead_time_s);
  travel.pump_lag_s = exactly(hidden.plant.pump_response_s);
  travel.driven_least = 0.0;
  travel.driven_most = 1.0;
}

struct Graded {
  GradeEnd end = GradeEnd::kDone;
  Fault fault = Fault::kNone;
  double max_error_m = kAbsent;
  double time_s = kAbsent;
};

Graded grade_with(const machines::SimulatedDozer& hidden, const DozerProfile& profile) {
  machines::SimulatedDozer machine = hidden;
  machine.profile = profile;
  const GradeResult result = run_grade(machine, {}, [](double, const std::string&) {});
  const GradeSummary summary = summarise(machine, result);
  return {result.end, result.fault, summary.max_error_true_m, summary.time_s};
}

/// How far the speeds of what was found are off.
struct SpeedErrors {
  double most = 0.0;
  int sides = 0;
  int within = 0;

  void add(double of_full) {
    most = std::max(most, of_full);
    ++sides;
    within += of_full <= kSpeedWithin ? 1 : 0;
  }
};

/// A side's largest error over its travel, of its full speed.
double side_error(const machines::SimulatedDozer& hidden, const DozerProfile& found,
                  std::size_t drive, bool extends) {
  constexpr int kDuties = 50;
  const plant::DozerPlantProfile& plant = hidden.plant;
  const plant::BladeValve valve = plant.valve(drive);
  const plant::SpoolSide& of = extends ? valve.spool.extend : valve.spool.retract;
  const double engine_radps = plant.machine.hst.engine_radps;
  const ImplementProfile& implement = plant.machine.implement;
  const double pump_m3ps =
      engine_radps / kTwoPi * implement.displacement_m3prev * implement.efficiency;
  const double most_m3ps =
      valve.flow_factor *
      (drive == 0 ? implement.valve_flow_max_m3ps : plant.machine.tilt.valve_flow_max_m3ps);
  const auto area_m2 = [&](const auto& cylinder) {
    return extends ? cylinder.cap_area_m2() : cylinder.rod_area_m2();
  };
  const double fed_m2 = drive == 0 ? area_m2(plant.machine.blade) : area_m2(plant.machine.tilt);
  const auto true_mps = [&](double duty) {
    return std::min(most_m3ps * of.area_ratio(duty), pump_m3ps) / fed_m2;
  };
  double most = 0.0;
  for (int n = 1; n <= kDuties; ++n) {
    const double duty = static_cast<double>(n) / kDuties;
    const double found_mps =
        std::abs(identify::steady_blade_mps(found, drive, extends ? duty : -duty, engine_radps));
    most = std::max(most, std::abs(found_mps - true_mps(duty)) / true_mps(1.0));
  }
  return most;
}

void judge_tracks(const DozerProfile& profile, const DozerProfile& found,
                  const identify::TravelEstimate& truth, SpeedErrors& errors,
                  DozerIdentifySummary& summary) {
  const double factor = found.hst.pump_m3prev / profile.hst.pump_m3prev;
  summary.track_error_ratio = 0.0;
  for (const auto* sides : {&truth.forward, &truth.back}) {
    for (const identify::TrackSideEstimate& side : *sides) {
      const double off = std::abs(factor / side.speed_factor.value - 1.0);
      errors.add(off);
      summary.track_error_ratio = std::max(summary.track_error_ratio, off);
    }
  }
}

void judge(const machines::SimulatedDozer& hidden, const identify::DozerEstimate& found,
           const identify::DozerEstimate& truth, DozerIdentifySummary& summary) {
  const DozerProfile profile = identify::identified_dozer(hidden.profile, found);
  SpeedErrors speeds;
  int edges = 0;
  int within = 0;
  summary.edge_error_ratio = summary.dead_time_error_s = summary.lag_error_s = 0.0;
  const auto most = [](double& of, double off) { of = std::max(of, std::abs(off)); };
  for (std::size_t drive = 0; drive < (hidden.profile.tilt.present ? 2U : 1U); ++drive) {
    for (const bool extends : {true, false}) {
      const identify::BladeSideEstimate& is = found.blade[drive].side(extends);
      const identify::BladeSideEstimate& was = truth.blade[drive].side(extends);
      speeds.add(is.known() ? side_error(hidden, profile, drive, extends) : 1.0);
      if (is.known()) {
        const double off = is.edge.value - was.edge.value;
        most(summary.edge_error_ratio, off);
        most(summary.dead_time_error_s, is.dead_time_s.value - was.dead_time_s.value);
        most(summary.lag_error_s, is.lag_s.value - was.lag_s.value);
        ++edges;
        within += std::abs(off) <= kBand * is.edge.deviation ? 1 : 0;
      }
    }
  }
  judge_tracks(hidden.profile, profile, truth.travel, speeds, summary);
  summary.pump_flow_error_ratio =
      std::abs(profile.implement.displacement_m3prev /
                   (truth.pump_flow_factor.value * hidden.profile.implement.displacement_m3prev) -
               1.0);
  summary.speed_error_ratio = speeds.most;
  summary.sides_within_share = static_cast<double>(speeds.within) / speeds.sides;
  summary.within_band_share = edges > 0 ? static_cast<double>(within) / edges : kAbsent;
}

}  // namespace

identify::DozerEstimate known_dozer(const machines::SimulatedDozer& hidden) {
  const plant::DozerPlantProfile& plant = hidden.plant;
  identify::DozerEstimate known;
  for (std::size_t drive = 0; drive < (hidden.profile.tilt.present ? 2U : 1U); ++drive) {
    const plant::BladeValve valve = plant.valve(drive);
    for (const bool extends : {true, false}) {
      known.blade[drive].side(extends) = known_side(valve, extends);
    }
    known.blade[drive].valve_flow_m3ps =
        exactly(valve.flow_factor * (drive == 0 ? plant.machine.implement.valve_flow_max_m3ps
                                                : plant.machine.tilt.valve_flow_max_m3ps));
  }
  known.pump_flow_factor =
      exactly(plant.machine.implement.displacement_m3prev * plant.machine.implement.efficiency /
              (hidden.profile.implement.displacement_m3prev * hidden.profile.implement.efficiency));
  know_tracks(hidden, known.travel);
  return known;
}

DozerIdentifyResult run_dozer_identification(const machines::SimulatedDozer& hidden,
                                             const Progress& progress) {
  DozerIdentifyResult result;
  DozerIdentifySummary& summary = result.summary;
  identify::DozerCollector frames("bus");
  const CommissionResult done = run_dozer_commission(
      hidden, commission::whole_dozer(hidden.profile), {},
      [&](const identify::LoggedFrame& frame) { frames.take(frame); },
      [&](double share, const std::string& where) { progress(0.3 * share, where); });
  summary.commissioning_s = done.machine_s;
  if (done.end != CommissionEnd::kDone) {
    result.end = DozerIdentifyEnd::kCommissioningStopped;
    result.fault = done.fault;
    return result;
  }
  identify::DozerEstimate found;
  try {
    found = identify::identify_dozer(hidden.profile, {frames.log()});
  } catch (const std::runtime_error&) {
    result.end = DozerIdentifyEnd::kNotIdentified;
    return result;
  }
  const identify::DozerEstimate truth = known_dozer(hidden);
  judge(hidden, found, truth, summary);
  progress(0.5, "grades as identified");
  const Graded identified = grade_with(hidden, identify::identified_dozer(hidden.profile, found));
  progress(0.7, "grades as exact");
  const Graded exact = grade_with(hidden, identify::identified_dozer(hidden.profile, truth));
  progress(0.9, "grades as shipped");
  const Graded shipped = grade_with(hidden, hidden.profile);
  summary.max_error_identified_m = identified.max_error_m;
  summary.max_error_exact_m = exact.max_error_m;
  summary.max_error_as_shipped_m = shipped.max_error_m;
  summary.error_ratio = identified.max_error_m / exact.max_error_m;
  summary.time_identified_s = identified.time_s;
  summary.time_exact_s = exact.time_s;
  summary.time_as_shipped_s = shipped.time_s;
  summary.identified_fault = static_cast<double>(identified.fault);
  summary.exact_fault = static_cast<double>(exact.fault);
  summary.shipped_fault = static_cast<double>(shipped.fault);
  if (identified.end != GradeEnd::kDone) {
    result.end = DozerIdentifyEnd::kIdentifiedStopped;
    result.fault = identified.fault;
  }
  return result;
}

const FigureTable<DozerIdentifySummary>& dozer_identify_figures() {
  using S = DozerIdentifySummary;
  static const FigureTable<S> all = {
      {{"commissioning_s", "machine time of commissioning", kSeconds, "commissioning_s"},
       [](const S& s) { return s.commissioning_s; }},
      {{"max_error_as_shipped_m", "true edge off the grade, profile as shipped, max", kMillimetres,
        "max_error_as_shipped_m"},
       [](const S& s) { return s.max_error_as_shipped_m; }},
      {{"max_error_identified_m", "true edge off the grade, as identified, max", kMillimetres,
        "max_error_identified_m"},
       [](const S& s) { return s.max_error_identified_m; }},
      {{"max_error_exact_m", "true edge off the grade, exact, max", kMillimetres,
        "max_error_exact_m"},
       [](const S& s) { return s.max_error_exact_m; }},
      {{"error_ratio", "identified over exact", kRatio, "error_ratio"},
       [](const S& s) { return s.error_ratio; }},
      {{"time_identified_s", "time over the grade, as identified", kSeconds, "time_identified_s"},
       [](const S& s) { return s.time_identified_s; }},
      {{"time_exact_s", "time over the grade, exact", kSeconds, "time_exact_s"},
       [](const S& s) { return s.time_exact_s; }},
      {{"time_as_shipped_s", "time over the grade, as shipped", kSeconds, "time_as_shipped_s"},
       [](const S& s) { return s.time_as_shipped_s; }},
      {{"identified_fault", "fault that stops the identified profile", kCount, "identified_fault"},
       [](const S& s) { return s.identified_fault; }},
      {{"exact_fault", "fault that stops the exact profile", kCount, "exact_fault"},
       [](const S& s) { return s.exact_fault; }},
      {{"shipped_fault", "fault that stops the shipped profile", kCount, "shipped_fault"},
       [](const S& s) { return s.shipped_fault; }},
      {{"edge_error_ratio", "edge, largest error, of the travel", kPercent, "edge_error_ratio"},
       [](const S& s) { return s.edge_error_ratio; }},
      {{"dead_time_error_s", "dead time, largest error", kSeconds, "dead_time_error_s"},
       [](const S& s) { return s.dead_time_error_s; }},
      {{"lag_error_s", "lag, largest error", kSeconds, "lag_error_s"},
       [](const S& s) { return s.lag_error_s; }},
      {{"pump_flow_error_ratio", "implement pump's flow, error", kPercent, "pump_flow_error_ratio"},
       [](const S& s) { return s.pump_flow_error_ratio; }},
      {{"track_error_ratio", "speed of a track, largest error", kPercent, "track_error_ratio"},
       [](const S& s) { return s.track_error_ratio; }},
      {{"speed_error_ratio", "speed of one drive, largest error, of full", kPercent,
        "speed_error_ratio"},
       [](const S& s) { return s.speed_error_ratio; }},
      {{"sides_within_share", "sides within 3 % of full speed", kPercent, "sides_within_share",
        BadEnd::kLow},
       [](const S& s) { return s.sides_within_share; }},
      {{"within_band_share", "true edge within the stated 95 % band", kPercent, "within_band_share",
        BadEnd::kLow},
       [](const S& s) { return s.within_band_share; }},
  };
  return all;
}

}  // namespace graben::runs
