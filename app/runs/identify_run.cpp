// SPDX-License-Identifier: Apache-2.0
#include "app/runs/identify_run.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/identify/machine/identified_profile.hpp"
#include "app/identify/machine/log_checks.hpp"
#include "app/identify/machine/machine_fit.hpp"
#include "app/identify/machine/swing_figures.hpp"
#include "app/machines/simulated/hidden.hpp"
#include "app/runs/commission_run.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/drive_speeds.hpp"
#include "app/runs/known_machine.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::runs {
namespace {

struct Dig {
  DigEnd end = DigEnd::kDone;
  Fault fault = Fault::kNone;
  double max_error_m = kAbsent;
  double ringing_m = kAbsent;
  double loop_s = kAbsent;
};

Dig dig_with(const machines::SimulatedExcavator& machine, const ExcavatorProfile& profile,
             double speed_override_ratio) {
  machines::SimulatedExcavator tried = machine;
  tried.profile = profile;
  DigOptions run = usual_run(tried, DigScenario{});
  run.speed_override_ratio = speed_override_ratio;
  const DigResult result = run_dig(tried, run, [](double, const std::string&) {});
  Dig dig{result.end, result.fault};
  const DigSummary summary = summarise(result);
  if (summary.max_error_true_m > 0.0) {
    dig.max_error_m = summary.max_error_true_m;
    dig.ringing_m = summary.ringing_rms_m;
    dig.loop_s = summary.loop_s;
  }
  return dig;
}

void take_errors(const IdentificationErrors& errors, IdentifySummary& summary) {
  summary.edge_error_ratio = errors.edge_ratio;
  summary.dead_time_error_s = errors.dead_time_s;
  summary.lag_error_s = errors.lag_s;
  summary.stroke_zero_error_m = errors.stroke_zero_m;
  summary.pressure_zero_error_pa = errors.pressure_zero_pa;
  summary.pump_flow_error_ratio = errors.pump_flow;
  summary.speed_error_ratio = errors.speed.most;
  summary.within_band_share = errors.within_share();
}

void take_swing(const ExcavatorProfile& profile, const identify::MachineEstimate& found,
                const machines::MachineTruth& truth, SpeedErrors speeds, IdentifySummary& summary) {
  const auto error = [&](bool left) {
    // What was not driven is not known at all.
    return found.drive[kSwing].side(left).driven_most > 0.0
               ? swing_speed_error(profile, found, known_machine(profile, truth), left)
               : 1.0;
  };
  if (profile.has_swing()) {
    summary.swing_left_error_ratio = error(true);
    summary.swing_right_error_ratio = error(false);
    for (const double off : {summary.swing_left_error_ratio, summary.swing_right_error_ratio}) {
      speeds.within += off <= kSpeedFound ? 1 : 0;
      ++speeds.sides;
    }
  }
  summary.sides_within_share = static_cast<double>(speeds.within) / speeds.sides;
}

void take_times(const machines::MachineTruth& truth, IdentifySummary& summary) {
  summary.longest_dead_time_s = 0.0;
  summary.longest_lag_s = 0.0;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    for (const machines::SideTruth* side :
         {&truth.drive[axis].extend, &truth.drive[axis].retract}) {
      summary.longest_dead_time_s = std::max(summary.longest_dead_time_s, side->dead_time_s);
      summary.longest_lag_s = std::max(summary.longest_lag_s, side->lag_s);
    }
  }
}

}  // namespace

machines::SimulatedExcavator hidden_with_noise(const machines::SimulatedExcavator& nominal,
                                               std::uint64_t seed) {
  machines::SimulatedExcavator hidden = machines::hidden_machine(nominal, seed);
  hidden.plant.seed = seed;
  hidden.plant.sensor_errors = true;
  hidden.plant.sensors.stroke_bias_m = 0.0;
  hidden.plant.sensors.swing_bias_rad = 0.0;
  hidden.plant.sensors.pressure_bias_ratio = 0.0;
  return hidden;
}

machines::SimulatedExcavator nominal_with_errors(const machines::SimulatedExcavator& nominal,
                                                 std::uint64_t seed) {
  DigScenario scenario;
  scenario.errors = "kim";
  scenario.scenario.seed = seed;
  return arranged(nominal, scenario);
}

IdentifyResult run_identification(const machines::SimulatedExcavator& hidden,
                                  const IdentifyRunOptions& options, const Progress& progress) {
  IdentifyResult result;
  IdentifySummary& summary = result.summary;
  const machines::MachineTruth truth = machines::truth_of(hidden.plant);
  take_times(truth, summary);
  identify::LogCollector frames("bus");
  CommissionOptions commission = usual_commission(hidden);
  commission.log_file = options.log_file;
  const CommissionResult done = run_commission(
      hidden, commission, [&](const identify::LoggedFrame& frame) { frames.take(frame); },
      [&](double share, const std::string& where) { progress(0.4 * share, where); });
  summary.commissioning_s = done.machine_s;
  if (done.end != CommissionEnd::kDone) {
    result.end = IdentifyEnd::kCommissioningStopped;
    result.fault = done.fault;
    return result;
  }
  identify::MachineEstimate found;
  try {
    const std::vector<identify::MachineLog> logs = {
        frames.log(hidden.profile.pump_count, identify::swing_lever_m(hidden.profile),
                   !hidden.profile.pump[0].regulator.sets_swash())};
    found = identify::identify_machine(
        identify::DriveModel(hidden.profile), logs,
        [&](double share, const std::string& what) { progress(0.4 + 0.3 * share, what); });
    found.swing = identify::find_swing(hidden.profile, logs);
  } catch (const std::runtime_error&) {
    result.end = IdentifyEnd::kNotIdentified;
    return result;
  }
  if (options.truth_is_known) {
    const IdentificationErrors errors = errors_of(hidden.profile, found, truth);
    take_errors(errors, summary);
    take_swing(hidden.profile, found, truth, errors.speed, summary);
  }
  const double override_ratio =
      options.speed_override_ratio * (summary.longest_dead_time_s > kLateHydraulics_s ? 0.5 : 1.0);
  progress(0.7, "digs as identified");
  const Dig identified =
      dig_with(hidden, identify::identified(hidden.profile, found), override_ratio);
  progress(0.8, "digs as exact");
  Dig exact;
  if (options.truth_is_known) {
    exact =
        dig_with(hidden, identify::identified(hidden.profile, known_machine(hidden.profile, truth)),
                 override_ratio);
    summary.exact_fault = static_cast<double>(exact.fault);
  }
  progress(0.9, "digs as shipped");
  const Dig shipped = dig_with(hidden, hidden.profile, override_ratio);
  summary.max_error_as_shipped_m = shipped.max_error_m;
  summary.ringing_as_shipped_m = shipped.ringing_m;
  summary.shipped_fault = static_cast<double>(shipped.fault);
  summary.max_error_identified_m = identified.max_error_m;
  summary.ringing_identified_m = identified.ringing_m;
  summary.loop_identified_s = identified.loop_s;
  summary.max_error_exact_m = exact.max_error_m;
  summary.ringing_exact_m = exact.ringing_m;
  summary.loop_exact_s = exact.loop_s;
  summary.error_ratio = identified.max_error_m / exact.max_error_m;
  if (identified.end != DigEnd::kDone) {
    result.end = IdentifyEnd::kIdentifiedStopped;
    result.fault = identified.fault;
  }
  return result;
}

const FigureTable<IdentifySummary>& identify_figures() {
  using S = IdentifySummary;
  static const FigureTable<S> all = {
      {{"commissioning_s", "machine time of commissioning", kSeconds, "commissioning_s"},
       [](const S& s) { return s.commissioning_s; }},
      {{"max_error_as_shipped_m", "path error of the true tip, profile as shipped, max",
        kMillimetres, "max_error_as_shipped_m"},
       [](const S& s) { return s.max_error_as_shipped_m; }},
      {{"max_error_identified_m", "path error of the true tip, as identified, max", kMillimetres,
        "max_error_identified_m"},
       [](const S& s) { return s.max_error_identified_m; }},
      {{"max_error_exact_m", "path error of the true tip, exact, max", kMillimetres,
        "max_error_exact_m"},
       [](const S& s) { return s.max_error_exact_m; }},
      {{"error_ratio", "identified over exact", kRatio, "error_ratio"},
       [](const S& s) { return s.error_ratio; }},
      {{"ringing_as_shipped_m", "error above 1 Hz, as shipped, RMS", kMillimetres,
        "ringing_as_shipped_m"},
       [](const S& s) { return s.ringing_as_shipped_m; }},
      {{"ringing_identified_m", "error above 1 Hz, as identified, RMS", kMillimetres,
        "ringing_identified_m"},
       [](const S& s) { return s.ringing_identified_m; }},
      {{"ringing_exact_m", "error above 1 Hz, exact, RMS", kMillimetres, "ringing_exact_m"},
       [](const S& s) { return s.ringing_exact_m; }},
      {{"loop_identified_s", "time round the path, as identified", kSeconds, "loop_identified_s"},
       [](const S& s) { return s.loop_identified_s; }},
      {{"loop_exact_s", "time round the path, exact", kSeconds, "loop_exact_s"},
       [](const S& s) { return s.loop_exact_s; }},
      {{"shipped_fault", "fault that stops the shipped profile", kCount, "shipped_fault"},
       [](const S& s) { return s.shipped_fault; }},
      {{"exact_fault", "fault that stops the exact profile", kCount, "exact_fault"},
       [](const S& s) { return s.exact_fault; }},
      {{"edge_error_ratio", "edge, largest error, of the travel", kPercent, "edge_error_ratio"},
       [](const S& s) { return s.edge_error_ratio; }},
      {{"dead_time_error_s", "dead time, largest error", kSeconds, "dead_time_error_s"},
       [](const S& s) { return s.dead_time_error_s; }},
      {{"lag_error_s", "lag, largest error", kSeconds, "lag_error_s"},
       [](const S& s) { return s.lag_error_s; }},
      {{"stroke_zero_error_m", "stroke's zero, largest error", kMillimetres, "stroke_zero_error_m"},
       [](const S& s) { return s.stroke_zero_error_m; }},
      {{"pressure_zero_error_pa", "pressure's zero, largest error", kMegapascals,
        "pressure_zero_error_pa"},
       [](const S& s) { return s.pressure_zero_error_pa; }},
      {{"pump_flow_error_ratio", "pump's flow, largest error", kPercent, "pump_flow_error_ratio"},
       [](const S& s) { return s.pump_flow_error_ratio; }},
      {{"speed_error_ratio", "speed of one drive, largest error, of full", kPercent,
        "speed_error_ratio"},
       [](const S& s) { return s.speed_error_ratio; }},
      {{"sides_within_share", "sides within 3 % of full speed", kPercent, "sides_within_share",
        BadEnd::kLow},
       [](const S& s) { return s.sides_within_share; }},
      {{"within_band_share", "truth within the stated 95 % band", kPercent, "within_band_share",
        BadEnd::kLow},
       [](const S& s) { return s.within_band_share; }},
      {{"longest_dead_time_s", "longest dead time", kSeconds, "longest_dead_time_s"},
       [](const S& s) { return s.longest_dead_time_s; }},
      {{"longest_lag_s", "longest lag", kSeconds, "longest_lag_s"},
       [](const S& s) { return s.longest_lag_s; }},
      {{"swing_left_error_ratio", "speed of the swing to the left, largest error, of full",
        kPercent, "swing_left_error_ratio"},
       [](const S& s) { return s.swing_left_error_ratio; }},
      {{"swing_right_error_ratio", "speed of the swing to the right, largest error, of full",
        kPercent, "swing_right_error_ratio"},
       [](const S& s) { return s.swing_right_error_ratio; }},
  };
  return all;
}

}  // namespace graben::runs
