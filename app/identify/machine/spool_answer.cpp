// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/spool_answer.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace graben::identify {
namespace {

enum Parameter : std::size_t { kExtendDead, kRetractDead, kPilot, kSpool, kParameters };
using Parameters = std::array<double, kParameters>;

constexpr Parameters kLeast = {0.0002, 0.0002, 0.0005, 0.001};
constexpr Parameters kMost = {0.6, 0.6, 0.4, 0.2};
constexpr std::array<double, 6> kStarts_s = {0.01, 0.05, 0.10, 0.16, 0.22, 0.30};
/// Pilot and spool may share their lag in many ways that are nearly as good.
constexpr std::array<std::pair<double, double>, 2> kLagStarts_s = {{{0.004, 0.04}, {0.05, 0.01}}};
constexpr std::size_t kSearched = 3;
constexpr int kSearchSteps = 20;
constexpr std::size_t kFinalists = 3;
constexpr int kSteps = 100;
constexpr double kStep_s = 0.002;
/// After a change of duty its spool is followed for so long.
constexpr double kFollow_s = 1.2;
/// Of the travel: a smaller change of duty is no step.
constexpr double kChange = 0.002;
constexpr double kScale = 0.005;
constexpr double kBlock_s = 10.0;
constexpr std::size_t kLeastReadings = 100;

/// Both sides' parts of the duty and their integrals over time.
class Duty {
 public:
  explicit Duty(const std::vector<Reading>& readings) : readings_(readings) {
    for (std::size_t at = 0; at < readings.size(); ++at) {
      const double dt = at > 0 ? readings[at].time_s - readings[at - 1].time_s : 0.0;
      const double before = at > 0 ? readings[at - 1].value : 0.0;
      extend_.push_back((at > 0 ? extend_.back() : 0.0) + std::max(before, 0.0) * dt);
      retract_.push_back((at > 0 ? retract_.back() : 0.0) + std::min(before, 0.0) * dt);
    }
  }

  /// Integral of one side's part until then; times come in rising order, `place` goes with them.
  [[nodiscard]] double until(bool extends, double time_s, std::size_t& place) const {
    while (place + 1 < readings_.size() && readings_[place + 1].time_s <= time_s) {
      ++place;
    }
    const Reading& last = readings_[place];
    if (time_s <= last.time_s) {
      return 0.0;
    }
    const double rest_s = time_s - last.time_s;
    return extends ? extend_[place] + std::max(last.value, 0.0) * rest_s
                   : retract_[place] + std::min(last.value, 0.0) * rest_s;
  }

 private:
  const std::vector<Reading>& readings_;
  std::vector<double> extend_;
  std::vector<double> retract_;
};

/// A stretch in which the duty changes, with the spool's readings.
struct Stretch {
  const Duty* duty = nullptr;
  double begin_s = 0.0;
  double start = 0.0;  ///< Spool at its beginning, at rest there.
  std::vector<Reading> seen;
};

/// The spool at the readings' times.
void follow(const Stretch& of, const Parameters& p, double* spool) {
  std::size_t extend_place = 0;
  std::size_t retract_place = 0;
  double time_s = of.begin_s;
  double extended = of.duty->until(true, time_s - p[kExtendDead], extend_place);
  double retracted = of.duty->until(false, time_s - p[kRetractDead], retract_place);
  const double whole_pilot = 1.0 - std::exp(-kStep_s / p[kPilot]);
  const double whole_spool = 1.0 - std::exp(-kStep_s / p[kSpool]);
  double pilot = of.start;
  double first = of.start;
  double second = of.start;
  for (std::size_t at = 0; at < of.seen.size(); ++at) {
    while (time_s < of.seen[at].time_s - 1e-9) {
      const double step_s = std::min(kStep_s, of.seen[at].time_s - time_s);
      time_s += step_s;
      const double extend = of.duty->until(true, time_s - p[kExtendDead], extend_place);
      const double retract = of.duty->until(false, time_s - p[kRetractDead], retract_place);
      const double sent = (extend - extended + retract - retracted) / step_s;
      extended = extend;
      retracted = retract;
      const bool whole = step_s == kStep_s;
      pilot += (sent - pilot) * (whole ? whole_pilot : 1.0 - std::exp(-step_s / p[kPilot]));
      const double share = whole ? whole_spool : 1.0 - std::exp(-step_s / p[kSpool]);
      first += share * (pilot - first);
      second += share * (first - second);
    }
    spool[at] = second;
  }
}

/// Times by their logarithms, in which the search has no bounds to get stuck at.
Parameters times_of(const Parameters& logs) {
  Parameters times{};
  for (std::size_t at = 0; at < kParameters; ++at) {
    times[at] = std::clamp(std::exp(logs[at]), kLeast[at], kMost[at]);
  }
  return times;
}

/// Residuals of a stretch and their slopes, over the logarithms of the times. Written out: the
/// core's headers forbid Eigen the heap, which Ceres' own numeric differences of so many residuals
/// would take.
class StretchCost : public ceres::CostFunction {
 public:
  explicit StretchCost(const Stretch& of) : of_(of) {
    set_num_residuals(static_cast<int>(of.seen.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(kParameters));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Parameters logs{};
    std::copy_n(parameters[0], kParameters, logs.begin());
    const Parameters p = times_of(logs);
    errors(p, residuals);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      slopes(p, jacobians[0]);
      for (std::size_t at = 0; at < of_.seen.size() * kParameters; ++at) {
        jacobians[0][at] *= p[at % kParameters];
      }
    }
    return true;
  }

  void errors(const Parameters& p, double* residuals) const {
    follow(of_, p, residuals);
    for (std::size_t at = 0; at < of_.seen.size(); ++at) {
      residuals[at] = (residuals[at] - of_.seen[at].value) / kScale;
    }
  }

  /// Row by row.
  void slopes(const Parameters& p, double* jacobian) const {
    constexpr double kDelta_s = 1e-5;
    const std::size_t rows = of_.seen.size();
    std::vector<double> up(rows);
    std::vector<double> down(rows);
    for (std::size_t k = 0; k < kParameters; ++k) {
      Parameters there = p;
      there[k] = p[k] + kDelta_s;
      errors(there, up.data());
      there[k] = p[k] - kDelta_s;
      errors(there, down.data());
      for (std::size_t at = 0; at < rows; ++at) {
        jacobian[at * kParameters + k] = (up[at] - down[at]) / (2.0 * kDelta_s);
      }
    }
  }

 private:
  const Stretch& of_;
};

/// Stretches of at most kBlock_s that begin at rest.
void add_stretches(const CylinderSeries& axis, const Duty& duty, std::vector<Stretch>& stretches) {
  double last_change_s = -std::numeric_limits<double>::infinity();
  double last_duty = axis.duties.empty() ? 0.0 : axis.duties.front().value;
  std::size_t next = 0;
  bool open = false;
  for (const Reading& reading : axis.spools) {
    bool begins = false;
    while (next < axis.duties.size() && axis.duties[next].time_s <= reading.time_s) {
      if (std::abs(axis.duties[next].value - last_duty) > kChange) {
        begins = begins || axis.duties[next].time_s - last_change_s > kFollow_s;
        last_change_s = axis.duties[next].time_s;
        last_duty = axis.duties[next].value;
      }
      ++next;
    }
    const bool long_enough = open && reading.time_s - stretches.back().begin_s > kBlock_s;
    if (begins) {
      stretches.push_back({&duty, reading.time_s - 0.02, reading.value, {}});
      open = true;
    } else if (long_enough || reading.time_s - last_change_s > kFollow_s) {
      open = false;
    }
    if (open) {
      stretches.back().seen.push_back(reading);
    }
  }
}

double solve(const std::vector<Stretch>& stretches, int steps, Parameters& times) {
  Parameters p{};
  for (std::size_t at = 0; at < kParameters; ++at) {
    p[at] = std::log(std::max(times[at], kLeast[at]));
  }
  ceres::Problem problem;
  for (const Stretch& of : stretches) {
    const auto rows = static_cast<double>(of.seen.size());
    problem.AddResidualBlock(new StretchCost(of), new ceres::HuberLoss(3.0 * std::sqrt(rows)),
                             p.data());
  }
  ceres::Solver::Options options;
  options.max_num_iterations = steps;
  options.function_tolerance = 1e-9;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  times = times_of(p);
  return summary.final_cost;
}

/// Standard deviations by whole stretches, whose errors hang together: H^-1 (sum g g^T) H^-1.
Parameters deviations(const std::vector<Stretch>& stretches, const Parameters& p) {
  using Square = Eigen::Matrix<double, kParameters, kParameters>;
  using Row = Eigen::Matrix<double, kParameters, 1>;
  Square curvature = Square::Zero();
  Square gradients = Square::Zero();
  for (const Stretch& of : stretches) {
    const StretchCost cost(of);
    std::vector<double> residuals(of.seen.size());
    std::vector<double> jacobian(of.seen.size() * kParameters);
    cost.errors(p, residuals.data());
    cost.slopes(p, jacobian.data());
    Row gradient = Row::Zero();
    for (std::size_t at = 0; at < of.seen.size(); ++at) {
      const Eigen::Map<const Row> row(&jacobian[at * kParameters]);
      curvature += row * row.transpose();
      gradient += residuals[at] * row;
    }
    gradients += gradient * gradient.transpose();
  }
  Square ridge = curvature;
  ridge.diagonal().array() += 1e-9 * (1.0 + curvature.trace());
  const Square inverse = ridge.ldlt().solve(Square::Identity());
  const Square covariance = inverse * gradients * inverse;
  Parameters sigma{};
  for (std::size_t at = 0; at < kParameters; ++at) {
    const auto k = static_cast<Eigen::Index>(at);
    sigma[at] = std::sqrt(std::max(0.0, covariance(k, k)));
  }
  return sigma;
}

/// What the bus rounds to and how its frames are spread over a cycle stays unseen in the residuals.
constexpr double kLeastDeviation_s = 0.0015;

Estimate estimate(double value, double deviation) {
  return {value, std::hypot(deviation, kLeastDeviation_s), true};
}

}  // namespace

void find_spool_answer(const std::vector<MachineLog>& logs, int axis, DriveEstimate& drive) {
  std::vector<Duty> duties;
  std::vector<Stretch> stretches;
  std::size_t segments = 0;
  for (const MachineLog& log : logs) {
    segments += log.segments.size();
  }
  duties.reserve(segments);
  std::size_t readings = 0;
  bool extends = false;
  bool retracts = false;
  for (const MachineLog& log : logs) {
    for (const LogSegment& segment : log.segments) {
      const CylinderSeries& series = segment.axis[static_cast<std::size_t>(axis)];
      if (!segment.senses_spools || series.duties.empty() || series.spools.empty()) {
        continue;
      }
      duties.emplace_back(series.duties);
      add_stretches(series, duties.back(), stretches);
    }
  }
  for (const Stretch& of : stretches) {
    readings += of.seen.size();
    for (const Reading& reading : of.seen) {
      extends = extends || reading.value > 0.05;
      retracts = retracts || reading.value < -0.05;
    }
  }
  if (readings < kLeastReadings) {
    return;
  }
  // From each start on a share of the stretches; from the best of them on all.
  std::vector<Stretch> some;
  for (std::size_t at = 0; at < stretches.size(); at += kSearched) {
    some.push_back(stretches[at]);
  }
  std::vector<std::pair<double, Parameters>> tried;
  for (const double start_s : kStarts_s) {
    for (const auto& [pilot_s, spool_s] : kLagStarts_s) {
      Parameters p = {start_s, start_s, pilot_s, spool_s};
      const double cost = solve(some, kSearchSteps, p);
      tried.emplace_back(cost, p);
    }
  }
  std::sort(tried.begin(), tried.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Parameters best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at < kFinalists; ++at) {
    const double cost = solve(stretches, kSteps, tried[at].second);
    if (cost < least) {
      least = cost;
      best = tried[at].second;
    }
  }
  const Parameters sigma = deviations(stretches, best);
  if (extends) {
    drive.extend.dead_time_s = estimate(best[kExtendDead], sigma[kExtendDead]);
  }
  if (retracts) {
    drive.retract.dead_time_s = estimate(best[kRetractDead], sigma[kRetractDead]);
  }
  drive.pilot_lag_s = estimate(best[kPilot], sigma[kPilot]);
  drive.spool_time_constant_s = estimate(best[kSpool], sigma[kSpool]);
}

}  // namespace graben::identify
