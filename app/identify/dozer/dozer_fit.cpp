// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/dozer_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/identify/dozer/blade_fit.hpp"
#include "app/identify/dozer/travel_fit.hpp"
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/tracks.hpp"

namespace graben::identify {
namespace {

/// How far two neighbours of a table are apart at least.
constexpr double kStrictly = 1e-4;
/// A spool of this lag settles in so many of it, see safety.settle.
constexpr double kSettlePerFoundLag = 1.75;

constexpr std::array<const char*, 2> kFoundNames = {"blade", "tilt"};

/// Openings are shares of `valve_m3ps`, of which this curve's spool lets all through at full
/// travel.
DutyTable table_of(const OpeningCurve& curve) {
  std::array<double, kBladeOpenings.size()> duty{};
  for (std::size_t at = 0; at < duty.size(); ++at) {
    // The first one is where the spool as good as begins to open.
    constexpr double kBegins = 0.004;
    duty[at] = curve.travel_at(std::max(kBegins, kBladeOpenings[at]));
    duty[at] = at > 0 ? std::max(duty[at], duty[at - 1] + kStrictly) : duty[at];
  }
  // What lies beyond the travel must not push the last ones over 1.
  for (std::size_t at = duty.size(); at-- > 0;) {
    const double most = 1.0 - kStrictly * static_cast<double>(duty.size() - 1 - at);
    duty[at] = std::min(duty[at], most);
  }
  DutyTable table;
  static_cast<void>(table.fill(kBladeOpenings.data(), duty.data(), static_cast<int>(duty.size())));
  return table;
}

void take_side(const BladeSideEstimate& side, SaidAnswer& answer) {
  if (!side.known()) {
    return;
  }
  answer.spool_to_duty = table_of(side.curve);
  answer.dead_time_s = side.dead_time_s.value;
  answer.lag_s = std::max(0.001, side.lag_s.value);
}

/// Of both sides that are known.
template <class Member>
double mean_of(const BladeDriveEstimate& drive, Member member, double otherwise) {
  double sum = 0.0;
  double count = 0.0;
  for (const bool extends : {true, false}) {
    if (drive.side(extends).known()) {
      sum += (drive.side(extends).*member).value;
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : otherwise;
}

/// Opening that this duty stands for.
double opening_at(const DutyTable& table, double duty) {
  if (duty <= table.y_first()) {
    return 0.0;
  }
  for (int at = 1; at < table.size(); ++at) {
    if (duty <= table.y(at)) {
      const double share = (duty - table.y(at - 1)) / (table.y(at) - table.y(at - 1));
      return table.x(at - 1) + share * (table.x(at) - table.x(at - 1));
    }
  }
  return 1.0;
}

/// What a profile makes of duties: the speed that they stand for, late.
class SpeedByDuty {
 public:
  SpeedByDuty(const DozerProfile& profile, std::size_t drive)
      : machine_(blade_machine(profile, drive)), row_(dozer_bank(profile).row[drive]) {}

  [[nodiscard]] std::vector<double> of(const std::vector<double>& duty,
                                       const std::vector<double>& engine_radps) const {
    std::vector<double> speed_mps(duty.size(), 0.0);
    std::array<double, 2> lag_mps{};
    for (std::size_t at = 1; at < duty.size(); ++at) {
      const bool extends = duty[at] != 0.0 ? duty[at] > 0.0 : lag_mps[1] > 0.0;
      const SpoolAnswer& answer = row_.answer.side(extends);
      const auto late = static_cast<std::size_t>(std::lround(answer.dead_time_s / kGrid_s));
      const double then = at >= late + 1 ? duty[at - 1 - late] : 0.0;
      const double share = -std::expm1(-2.0 * kGrid_s / std::max(0.002, answer.lag_s));
      lag_mps[0] += share * (steady_mps(then, engine_radps[at]) - lag_mps[0]);
      lag_mps[1] += share * (lag_mps[0] - lag_mps[1]);
      speed_mps[at] = lag_mps[1];
    }
    return speed_mps;
  }

  [[nodiscard]] double steady_mps(double duty, double engine_radps) const {
    if (duty == 0.0) {
      return 0.0;
    }
    const bool extends = duty > 0.0;
    const double opening = opening_at(row_.answer.side(extends).spool_to_duty, std::abs(duty));
    const double flow_m3ps =
        std::min(opening * machine_.valve_flow_m3ps, machine_.pump_m3prad * engine_radps);
    return extends ? flow_m3ps / machine_.extend_area_m2 : -flow_m3ps / machine_.retract_area_m2;
  }

 private:
  BladeMachine machine_;
  DriveRow row_;
};

struct Errors {
  double off = 0.0;
  double measured = 0.0;

  void add(double modelled_mps, double measured_mps) {
    off += (modelled_mps - measured_mps) * (modelled_mps - measured_mps);
    measured += measured_mps * measured_mps;
  }
  [[nodiscard]] double share() const { return measured > 0.0 ? std::sqrt(off / measured) : -1.0; }
};

double blade_score(const DozerProfile& profile, const std::vector<DozerLog>& logs,
                   std::size_t drive) {
  constexpr std::size_t kOver = 5;
  constexpr double kMoving_mps = 0.005;
  const SpeedByDuty by_duty(profile, drive);
  Errors errors;
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      const BladeSeries& of = segment.blade[drive];
      const std::vector<double> modelled_mps = by_duty.of(of.duty, segment.engine_radps);
      for (std::size_t at = 0; at + kOver < of.duty.size(); at += kOver) {
        double mean_mps = 0.0;
        for (std::size_t n = 1; n <= kOver; ++n) {
          mean_mps += modelled_mps[at + n] / kOver;
        }
        const double measured_mps = (of.stroke_m[at + kOver] - of.stroke_m[at]) / (kGrid_s * kOver);
        if (std::max(std::abs(mean_mps), std::abs(measured_mps)) > kMoving_mps) {
          errors.add(mean_mps, measured_mps);
        }
      }
    }
  }
  return errors.share();
}

double track_score(const DozerProfile& profile, const std::vector<DozerLog>& logs) {
  constexpr double kRunning_mps = 0.03;
  Errors errors;
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      for (const TrackSeries& track : segment.track) {
        double pump = 0.0;
        const double share = -std::expm1(-kGrid_s / std::max(0.002, profile.hst.response_s));
        for (std::size_t at = 1; at < segment.size(); ++at) {
          pump += share * (track.pump_sent[at - 1] - pump);
          const double modelled_mps =
              track_speed_mps(profile.hst, segment.engine_radps[at], pump, track.motor[at]);
          if (std::max(std::abs(modelled_mps), std::abs(track.speed_mps[at])) > kRunning_mps) {
            errors.add(modelled_mps, track.speed_mps[at]);
          }
        }
      }
    }
  }
  return errors.share();
}

void name_missing(const DozerProfile& profile, DozerEstimate& found) {
  for (std::size_t drive = 0; drive < (profile.tilt.present ? 2U : 1U); ++drive) {
    for (const bool extends : {true, false}) {
      if (!found.blade[drive].side(extends).known()) {
        found.missing.push_back(fmt::format("not driven, and so not found: {}, {}",
                                            kFoundNames[drive], extends ? "extend" : "retract"));
      }
    }
  }
  if (!found.travel.known()) {
    found.missing.emplace_back("not driven, and so not found: tracks");
  } else {
    found.missing.emplace_back(
        "not found: the gauge, for both tracks run alike on a straight way; their relief, for "
        "nothing stalls them");
  }
  found.missing.emplace_back(
      "not found: zeros of the strokes, which the mark checks; what the blade leaks");
}

}  // namespace

DozerEstimate identify_dozer(const DozerProfile& profile, const std::vector<DozerLog>& logs) {
  DozerEstimate found;
  const bool tilts =
      profile.tilt.present &&
      std::all_of(logs.begin(), logs.end(), [](const DozerLog& log) { return log.tilts; });
  const BladeFit lift = fit_blade(logs, kBladeLift, blade_machine(profile, kBladeLift), {});
  found.blade[kBladeLift] = lift.drive;
  found.pump_flow_factor = lift.pump_flow_factor;
  if (tilts) {
    const BladeFit tilt =
        fit_blade(logs, kBladeTilt, blade_machine(profile, kBladeTilt), lift.pump_flow_factor);
    found.blade[kBladeTilt] = tilt.drive;
    if (!found.pump_flow_factor.known) {
      found.pump_flow_factor = tilt.pump_flow_factor;
    }
  }
  found.travel = fit_travel(logs, profile.hst);
  const auto is_known = [](const BladeDriveEstimate& drive) {
    return drive.extend.known() || drive.retract.known();
  };
  if (!is_known(found.blade[0]) && !is_known(found.blade[1]) && !found.travel.known()) {
    throw std::runtime_error("nothing moves in the logs: neither blade nor tracks");
  }
  name_missing(profile, found);
  return found;
}

DozerProfile identified_dozer(const DozerProfile& profile, const DozerEstimate& found) {
  DozerProfile result = profile;
  double longest_lag_s = 0.0;
  for (std::size_t drive = 0; drive < found.blade.size(); ++drive) {
    for (const bool extends : {true, false}) {
      const BladeSideEstimate& side = found.blade[drive].side(extends);
      take_side(side, result.answer[drive].side(extends));
      longest_lag_s = std::max(longest_lag_s, side.known() ? side.lag_s.value : 0.0);
    }
  }
  // A table's openings are shares of what the spool lets through fully open.
  if (found.blade[kBladeLift].valve_flow_m3ps.value > 0.0) {
    result.implement.valve_flow_max_m3ps = found.blade[kBladeLift].valve_flow_m3ps.value;
  }
  if (found.blade[kBladeTilt].valve_flow_m3ps.value > 0.0) {
    result.tilt.valve_flow_max_m3ps = found.blade[kBladeTilt].valve_flow_m3ps.value;
  }
  if (found.pump_flow_factor.known) {
    result.implement.displacement_m3prev *= found.pump_flow_factor.value;
  }
  const BladeDriveEstimate& lift = found.blade[kBladeLift];
  result.control.dead_time_s =
      mean_of(lift, &BladeSideEstimate::dead_time_s, profile.control.dead_time_s);
  result.control.response_s =
      std::max(0.001, mean_of(lift, &BladeSideEstimate::lag_s, profile.control.response_s));
  const Estimate speed = found.travel.speed_factor();
  if (speed.known) {
    result.hst.pump_m3prev *= speed.value;
    result.hst.response_s =
        std::max(0.001, found.travel.pump_dead_time_s.value + found.travel.pump_lag_s.value);
  }
  result.safety.settle_s =
      std::max(result.safety.settle_s, std::min(0.3, kSettlePerFoundLag * longest_lag_s));
  return result;
}

DozerScore score_dozer(const DozerProfile& profile, const std::vector<DozerLog>& logs) {
  return {blade_score(profile, logs, kBladeLift),
          profile.tilt.present ? blade_score(profile, logs, kBladeTilt) : -1.0,
          track_score(profile, logs)};
}

double steady_blade_mps(const DozerProfile& profile, std::size_t drive, double duty,
                        double engine_radps) {
  return SpeedByDuty(profile, drive).steady_mps(duty, engine_radps);
}

std::vector<std::string> dozer_sentences(const DozerEstimate& found) {
  std::vector<std::string> lines;
  const TravelEstimate& travel = found.travel;
  for (const bool forward : {true, false}) {
    for (std::size_t i = 0; i < kTrackCount; ++i) {
      const TrackSideEstimate& side = (forward ? travel.forward : travel.back)[i];
      if (side.speed_factor.known) {
        lines.push_back(fmt::format(
            "{} track, {}: {:.1f} +- {:.1f} % of the speed that the profile has; slip {:.1f} %; "
            "line up to {:.1f} MPa",
            i == kLeft ? "left" : "right", forward ? "forward" : "back",
            100.0 * side.speed_factor.value, 100.0 * side.speed_factor.deviation, 100.0 * side.slip,
            1e-6 * side.most_pa));
      }
    }
  }
  if (travel.motor_lag_s.known) {
    lines.push_back(fmt::format("motors: dead time {:.0f} ms, lag {:.0f} ms",
                                1e3 * travel.motor_dead_time_s.value,
                                1e3 * travel.motor_lag_s.value));
  }
  return lines;
}

}  // namespace graben::identify
