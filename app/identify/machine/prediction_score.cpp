// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/prediction_score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/identify/machine/machine_fit.hpp"
#include "app/identify/machine/median.hpp"
#include "app/identify/machine/spool_answer.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {
namespace {

constexpr double kMoves_mps = 0.01;
/// A ratio of speeds needs both to be this fast, ...
constexpr double kFast_mps = 0.04;
/// ... and so little changed over this time before, of the speed: dead times are not speeds.
constexpr std::size_t kSteady = 25;
constexpr double kSteadyShare = 0.1;
constexpr std::size_t kLeastSteady = 20;
/// Delays that are tried, in grid points.
constexpr int kLeastDelay = -20;
constexpr int kMostDelay = 30;
/// A delay is told where the error at it is at most this share of that at a delay of 100 ms more or
/// less: where nothing starts or stops all are alike.
constexpr double kDecides = 0.9;
/// It must leave no more than this of the measured motion open: what swings on its oil has a phase
/// of its own.
constexpr double kOpen = 0.25;
constexpr int kAside = 10;
constexpr std::size_t kLeastMoving = 100;

/// A moment that is judged.
struct Sample {
  const PredictedAxis* axis;
  std::size_t at;

  [[nodiscard]] double measured_mps() const { return axis->measured_mps[at]; }
  [[nodiscard]] double predicted_mps() const { return axis->predicted_mps[at]; }
  /// Predicted for so much earlier.
  [[nodiscard]] double earlier_mps(int delay) const {
    const auto there = static_cast<std::ptrdiff_t>(at) - delay;
    const auto last = static_cast<std::ptrdiff_t>(axis->predicted_mps.size()) - 1;
    return axis
        ->predicted_mps[static_cast<std::size_t>(std::clamp(there, std::ptrdiff_t{0}, last))];
  }
};

using Samples = std::vector<Sample>;

void take(const PredictedAxis& axis, const LogStretch& stretch, Samples& extend, Samples& retract) {
  for (std::size_t at = stretch.begin; at < stretch.end; ++at) {
    const double measured_mps = axis.measured_mps[at];
    const double predicted_mps = axis.predicted_mps[at];
    if (!axis.judged[at] ||
        std::max(std::abs(measured_mps), std::abs(predicted_mps)) < kMoves_mps) {
      continue;
    }
    const double way = std::abs(measured_mps) >= kMoves_mps ? measured_mps : predicted_mps;
    (way > 0.0 ? extend : retract).push_back({&axis, at});
  }
}

double squared_error(const Samples& samples) {
  double sum = 0.0;
  for (const Sample& of : samples) {
    sum += std::pow(of.measured_mps() - of.predicted_mps(), 2);
  }
  return sum;
}

double squared_speed(const Samples& samples) {
  double sum = 0.0;
  for (const Sample& of : samples) {
    sum += std::pow(of.measured_mps(), 2);
  }
  return sum;
}

double variance_sum(const Samples& samples) {
  double sum = 0.0;
  for (const Sample& of : samples) {
    sum += of.measured_mps();
  }
  const double mean = sum / static_cast<double>(samples.size());
  return squared_speed(samples) - mean * sum;
}

bool is_steady(const std::vector<double>& speed_mps, std::size_t at) {
  if (at < kSteady || std::abs(speed_mps[at]) < kFast_mps) {
    return false;
  }
  const auto from = speed_mps.begin() + static_cast<std::ptrdiff_t>(at - kSteady);
  const auto [least, most] =
      std::minmax_element(from, speed_mps.begin() + static_cast<std::ptrdiff_t>(at + 1));
  return *most - *least < kSteadyShare * std::abs(speed_mps[at]);
}

void find_ratio(const Samples& samples, SideScore& side) {
  std::vector<double> ratios;
  for (const Sample& of : samples) {
    const double ratio = of.measured_mps() / of.predicted_mps();
    if (ratio > 0.0 && is_steady(of.axis->measured_mps, of.at) &&
        is_steady(of.axis->predicted_mps, of.at)) {
      ratios.push_back(ratio);
    }
  }
  if (ratios.size() < kLeastSteady) {
    return;
  }
  side.has_ratio = true;
  side.speed_ratio = median(std::move(ratios));
}

/// Share of the measured speeds that this delay leaves open, whatever the ratio of speeds is.
double left_at(const Samples& samples, int delay) {
  double both = 0.0;
  double predicted = 0.0;
  double measured = 0.0;
  for (const Sample& of : samples) {
    const double earlier_mps = of.earlier_mps(delay);
    both += of.measured_mps() * earlier_mps;
    predicted += earlier_mps * earlier_mps;
    measured += of.measured_mps() * of.measured_mps();
  }
  return predicted > 0.0 ? 1.0 - both * both / (predicted * measured) : 1.0;
}

void find_delay(const Samples& samples, SideScore& side) {
  if (samples.size() < kLeastMoving) {
    return;
  }
  int best = kLeastDelay;
  double least = 2.0;
  for (int delay = kLeastDelay; delay <= kMostDelay; ++delay) {
    const double left = left_at(samples, delay);
    if (left < least) {
      least = left;
      best = delay;
    }
  }
  if (best == kLeastDelay || best == kMostDelay || least > kOpen ||
      least > kDecides * left_at(samples, best - kAside) ||
      least > kDecides * left_at(samples, best + kAside)) {
    return;
  }
  // Vertex of the parabola through the three.
  const double before = left_at(samples, best - 1);
  const double after = left_at(samples, best + 1);
  const double bend = before - 2.0 * least + after;
  side.has_delay = true;
  side.late_s =
      kGrid_s * (static_cast<double>(best) + (bend > 0.0 ? 0.5 * (before - after) / bend : 0.0));
}

SideScore score_side(const Samples& samples) {
  SideScore side;
  if (samples.empty()) {
    return side;
  }
  const auto count = static_cast<double>(samples.size());
  side.moving_s = kGrid_s * count;
  side.rms_mps = std::sqrt(squared_error(samples) / count);
  const double variance = variance_sum(samples);
  side.r2 = variance > 0.0 ? 1.0 - squared_error(samples) / variance : 0.0;
  find_ratio(samples, side);
  find_delay(samples, side);
  return side;
}

std::string side_text(std::size_t k, bool extends) {
  const char* const way = k == kSwing ? (extends ? "to the left" : "to the right")
                                      : (extends ? "extending" : "retracting");
  return fmt::format("the {}, {}", kAxisTexts[k], way);
}

template <class Each>
void for_each_side(const PredictionScore& score, const Each& each) {
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    each(k, true, score.axis[k].extend);
    each(k, false, score.axis[k].retract);
  }
}

}  // namespace

double AxisScore::share() const {
  return speed_mps2 > 0.0 ? std::sqrt(error_mps2 / speed_mps2) : 0.0;
}

double PredictionScore::share() const {
  double sum = 0.0;
  double moved = 0.0;
  for (const AxisScore& of : axis) {
    sum += of.share() * of.share();
    moved += of.speed_mps2 > 0.0 ? 1.0 : 0.0;
  }
  return moved > 0.0 ? std::sqrt(sum / moved) : 0.0;
}

PredictionScore score(const std::vector<std::vector<PredictedSegment>>& predicted,
                      const std::vector<LogStretch>& stretches) {
  PredictionScore total;
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    Samples extend;
    Samples retract;
    for (const LogStretch& stretch : stretches) {
      const PredictedAxis& axis = predicted[stretch.log][stretch.segment].axis[k];
      if (!axis.judged.empty()) {
        take(axis, stretch, extend, retract);
      }
    }
    AxisScore& axis = total.axis[k];
    axis.extend = score_side(extend);
    axis.retract = score_side(retract);
    axis.error_mps2 = squared_error(extend) + squared_error(retract);
    axis.speed_mps2 = squared_speed(extend) + squared_speed(retract);
  }
  return total;
}

DriveEstimates spool_answers(const DriveModel& model, const std::vector<MachineLog>& logs) {
  DriveEstimates found = estimate_of(model).drive;
  for (int axis = 0; axis < static_cast<int>(model.drives()); ++axis) {
    find_spool_answer(logs, axis, found[static_cast<std::size_t>(axis)]);
  }
  return found;
}

void judge_spools(const DriveModel& model, const DriveEstimates& found, PredictionScore& score) {
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    for (const bool extends : {true, false}) {
      const Estimate& dead_time_s = found[k].side(extends).dead_time_s;
      SideScore& side = score.axis[k].side(extends);
      if (dead_time_s.known && side.moving_s > 0.0) {
        const SpoolAnswer& said = model.drive[k].answer.side(extends);
        side.has_delay = true;
        side.late_s = dead_time_s.value + found[k].lag_s() - said.dead_time_s -
                      2.0 * said.spool_time_constant_s;
      }
    }
  }
}

PredictionScore score_of(const DriveModel& model, const std::vector<MachineLog>& logs,
                         const std::vector<LogStretch>& stretches, const DriveEstimates& spools) {
  PredictionScore of = score(predict_logs(model, logs), stretches);
  judge_spools(model, spools, of);
  return of;
}

std::vector<std::string> score_sentences(const PredictionScore& score) {
  std::vector<std::string> all;
  for_each_side(score, [&](std::size_t k, bool extends, const SideScore& side) {
    const std::string of = side_text(k, extends);
    const double off = side.speed_ratio - 1.0;
    if (side.has_ratio && std::abs(off) > kRatioWorth) {
      all.push_back(fmt::format("{}, is {:.0f} % {} than the profile says", of,
                                100.0 * std::abs(off), off < 0.0 ? "slower" : "faster"));
    }
    if (side.has_delay && std::abs(side.late_s) > kLateWorth_s) {
      all.push_back(fmt::format("{}, answers {:.0f} ms {} than the profile says", of,
                                1e3 * std::abs(side.late_s),
                                side.late_s > 0.0 ? "later" : "sooner"));
    }
  });
  return all;
}

std::vector<std::string> unjudged_sides(const PredictionScore& score) {
  std::vector<std::string> all;
  for_each_side(score, [&](std::size_t k, bool extends, const SideScore& side) {
    if (!side.has_ratio && (k != kSwing || score.axis[k].speed_mps2 > 0.0)) {
      all.push_back(side_text(k, extends));
    }
  });
  return all;
}

bool any_judged(const PredictionScore& score) {
  bool any = false;
  for_each_side(score,
                [&](std::size_t, bool, const SideScore& side) { any = any || side.has_ratio; });
  return any;
}

double most_off(const PredictionScore& score) {
  double most = 0.0;
  for_each_side(score, [&](std::size_t, bool, const SideScore& side) {
    if (side.has_ratio) {
      most = std::max(most, std::abs(side.speed_ratio - 1.0));
    }
  });
  return most;
}

}  // namespace graben::identify
