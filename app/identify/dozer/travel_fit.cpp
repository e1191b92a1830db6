// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/travel_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/identify/dozer/lag_fit.hpp"
#include "firmware/dozer/travel/tracks.hpp"

namespace graben::identify {
namespace {

/// A displacement that stands for so long, and is then judged.
constexpr std::size_t kSteadyFor = 50;
constexpr double kSteady = 0.004;
constexpr double kLeastPump = 0.04;
/// Fewer steady points say nothing.
constexpr std::size_t kLeastPoints = 40;
/// Points of one step hang together: so many count as one.
constexpr double kPointsAsOne = 25.0;

struct Sums {
  std::size_t count = 0;
  double modelled = 0.0;  ///< Squares of what the profile has.
  double product = 0.0;
  double measured = 0.0;
  double track_m = 0.0;
  double body_m = 0.0;
  double most_pa = 0.0;
};

/// Both displacements have stood for kSteadyFor.
bool stands(const TrackSeries& track, std::size_t at) {
  const auto range = [at](const std::vector<double>& of) {
    const auto end = of.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    const auto [least, most] = std::minmax_element(end - kSteadyFor, end);
    return *most - *least;
  };
  return range(track.pump) < kSteady && range(track.motor) < kSteady;
}

void add_points(const DozerSegment& segment, std::size_t i, int side, const HstProfile& profile,
                TravelEstimate& travel, Sums& sums) {
  const TrackSeries& track = segment.track[i];
  for (std::size_t at = kSteadyFor; at < segment.size(); ++at) {
    const double pump = side * track.pump[at];
    if (pump > kLeastPump) {
      sums.most_pa = std::max(sums.most_pa, track.line_pa[at]);
    }
    if (pump < kLeastPump || !stands(track, at)) {
      continue;
    }
    const double modelled_mps =
        side * track_speed_mps(profile, segment.engine_radps[at], track.pump[at], track.motor[at]);
    const double measured_mps = side * track.speed_mps[at];
    ++sums.count;
    sums.modelled += modelled_mps * modelled_mps;
    sums.product += modelled_mps * measured_mps;
    sums.measured += measured_mps * measured_mps;
    sums.track_m += measured_mps;
    sums.body_m += side * segment.velocity_mps[at];
    travel.driven_least = travel.known() ? std::min(travel.driven_least, pump) : pump;
    travel.driven_most = std::max(travel.driven_most, pump);
  }
}

TrackSideEstimate side_of(const Sums& sums) {
  TrackSideEstimate side;
  side.most_pa = sums.most_pa;
  if (sums.count < kLeastPoints) {
    return side;
  }
  const double factor = sums.product / sums.modelled;
  const double left = std::max(0.0, sums.measured - factor * sums.product);
  const double each = left / static_cast<double>(sums.count);
  side.speed_factor = {factor, std::sqrt(kPointsAsOne * each / sums.modelled), true};
  side.slip = 1.0 - sums.body_m / sums.track_m;
  return side;
}

/// Of pumps or motors, both tracks together.
LagFit servo_of(const std::vector<DozerLog>& logs, std::vector<double> TrackSeries::*sent,
                std::vector<double> TrackSeries::*seen, double start) {
  std::vector<SentAndSeen> pieces;
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      for (const TrackSeries& track : segment.track) {
        const std::vector<double>& of = track.*sent;
        SentAndSeen piece{of, track.*seen, std::vector<char>(of.size(), 0)};
        std::size_t until = 0;
        for (std::size_t at = 1; at < of.size(); ++at) {
          // What is sent changes, or may still be under way.
          until = of[at] != of[at - 1] ? at + kSteadyFor : until;
          piece.judged[at] = at < until ? 1 : 0;
        }
        pieces.push_back(std::move(piece));
      }
    }
  }
  return fit_lag(pieces, 1, start);
}

bool moves(const std::vector<DozerLog>& logs, std::vector<double> TrackSeries::*of, double start) {
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      const std::vector<double>& values = segment.track[kLeft].*of;
      if (std::any_of(values.begin(), values.end(),
                      [start](double each) { return std::abs(each - start) > 0.05; })) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

Estimate TravelEstimate::speed_factor() const {
  Estimate all;
  double count = 0.0;
  double square = 0.0;
  for (const auto* sides : {&forward, &back}) {
    for (const TrackSideEstimate& side : *sides) {
      if (side.speed_factor.known) {
        all.value += side.speed_factor.value;
        square += side.speed_factor.deviation * side.speed_factor.deviation;
        count += 1.0;
      }
    }
  }
  if (count > 0.0) {
    all = {all.value / count, std::sqrt(square) / count, true};
  }
  return all;
}

TravelEstimate fit_travel(const std::vector<DozerLog>& logs, const HstProfile& profile) {
  TravelEstimate travel;
  for (std::size_t i = 0; i < kTrackCount; ++i) {
    for (const int side : {1, -1}) {
      Sums sums;
      for (const DozerLog& log : logs) {
        for (const DozerSegment& segment : log.segments) {
          add_points(segment, i, side, profile, travel, sums);
        }
      }
      (side > 0 ? travel.forward : travel.back)[i] = side_of(sums);
    }
  }
  if (travel.known()) {
    const LagFit pump = servo_of(logs, &TrackSeries::pump_sent, &TrackSeries::pump, 0.0);
    travel.pump_dead_time_s = pump.dead_time_s;
    travel.pump_lag_s = pump.lag_s;
  }
  if (moves(logs, &TrackSeries::motor_sent, 1.0)) {
    const LagFit motor = servo_of(logs, &TrackSeries::motor_sent, &TrackSeries::motor, 1.0);
    travel.motor_dead_time_s = motor.dead_time_s;
    travel.motor_lag_s = motor.lag_s;
  }
  return travel;
}

}  // namespace graben::identify
