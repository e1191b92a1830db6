// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/blade_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/identify/dozer/lag_fit.hpp"
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/tilt.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::identify {
namespace {

/// Ways are compared over so many grid points.
constexpr std::size_t kWindow = 6;
/// What a stroke's resolution and the model leave of a way.
constexpr double kWay_m = 1.2e-4;
/// Nearer to an end its stop may hold the drive.
constexpr double kFromEnd_m = 0.002;
constexpr double kDrivenMoves_mps = 0.006;
/// A value is known where the logs say more of it than was known before.
constexpr double kSaysMore = 0.6;

enum Parameter : Eigen::Index {
  kEdgeE,
  kSoftE,
  kExponentE,
  kEdgeR,
  kSoftR,
  kExponentR,
  kValveFlow,  ///< Logarithm over the profile's, as the next.
  kPumpFlow,
  kOilLag,  ///< Logarithm, s.
  kParameters
};
using Parameters = Eigen::Matrix<double, kParameters, 1>;

struct Prior {
  Parameters mean;
  Parameters deviation;
};

Prior prior_of(const Estimate& pump) {
  Prior prior;
  prior.mean << 0.2, std::log(0.015), 1.15, 0.2, std::log(0.015), 1.15, 0.0,
      pump.known ? std::log(pump.value) : 0.0, std::log(0.008);
  prior.deviation << 0.2, 0.6, 0.3, 0.2, 0.6, 0.3, 0.2,
      pump.known ? std::max(0.003, pump.deviation) : 0.12, 0.7;
  return prior;
}

OpeningCurve curve_of(const Parameters& of, bool extends) {
  const Eigen::Index from = extends ? kEdgeE : kEdgeR;
  return {of[from], std::exp(of[from + 1]), of[from + 2]};
}

/// One piece of a log with the windows in it that count.
struct Piece {
  const BladeSeries* series = nullptr;
  const std::vector<double>* engine_radps = nullptr;
  std::vector<std::size_t> begin;  ///< Of each window.
};

class BladeProblem {
 public:
  BladeProblem(const std::vector<DozerLog>& logs, std::size_t drive, const BladeMachine& machine)
      : machine_(machine) {
    for (const DozerLog& log : logs) {
      for (const DozerSegment& segment : log.segments) {
        add(segment.blade[drive], segment.engine_radps);
      }
    }
  }

  [[nodiscard]] std::size_t count() const { return windows_; }
  [[nodiscard]] Eigen::VectorXd off(const Parameters& of) const;

 private:
  void add(const BladeSeries& series, const std::vector<double>& engine_radps) {
    Piece piece{&series, &engine_radps, {}};
    for (std::size_t at = 0; at + kWindow < series.stroke_m.size(); at += kWindow) {
      const double from_m = series.stroke_m[at];
      const double to_m = series.stroke_m[at + kWindow];
      const bool free = std::min(from_m, to_m) > kFromEnd_m &&
                        std::max(from_m, to_m) < machine_.stroke_m - kFromEnd_m;
      const auto first = series.spool.begin() + static_cast<std::ptrdiff_t>(at);
      const auto most = std::max_element(
          first, first + kWindow + 1, [](double a, double b) { return std::abs(a) < std::abs(b); });
      if (free && std::abs(*most) > 0.03) {
        piece.begin.push_back(at);
      }
    }
    windows_ += piece.begin.size();
    pieces_.push_back(std::move(piece));
  }

  BladeMachine machine_;
  std::vector<Piece> pieces_;
  std::size_t windows_ = 0;
};

/// Ways that the model has less those of the stroke, over what is left open of one.
Eigen::VectorXd BladeProblem::off(const Parameters& of) const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(windows_));
  const OpeningCurve extend = curve_of(of, true);
  const OpeningCurve retract = curve_of(of, false);
  const double valve_m3ps = std::exp(of[kValveFlow]) * machine_.valve_flow_m3ps;
  const double pump_m3prad = std::exp(of[kPumpFlow]) * machine_.pump_m3prad;
  const double share = -std::expm1(-kGrid_s / std::exp(of[kOilLag]));
  Eigen::Index row = 0;
  for (const Piece& piece : pieces_) {
    const std::vector<double>& spool = piece.series->spool;
    std::vector<double> way_m(spool.size(), 0.0);
    double speed_mps = 0.0;
    for (std::size_t n = 1; n < spool.size(); ++n) {
      const double x = 0.5 * (spool[n - 1] + spool[n]);
      const bool extends = x > 0.0;
      const double most_m3ps = pump_m3prad * (*piece.engine_radps)[n];
      const double flow_m3ps =
          x == 0.0 ? 0.0
                   : std::min(valve_m3ps * (extends ? extend : retract).area_ratio(std::abs(x)),
                              most_m3ps);
      const double target_mps =
          extends ? flow_m3ps / machine_.extend_area_m2 : -flow_m3ps / machine_.retract_area_m2;
      speed_mps += share * (target_mps - speed_mps);
      way_m[n] = way_m[n - 1] + kGrid_s * speed_mps;
    }
    const std::vector<double>& stroke_m = piece.series->stroke_m;
    for (const std::size_t at : piece.begin) {
      const double model_m = way_m[at + kWindow] - way_m[at];
      all[row++] = (model_m - (stroke_m[at + kWindow] - stroke_m[at])) / kWay_m;
    }
  }
  return all;
}

struct Solution {
  Parameters value;
  Parameters deviation;
  double squares = 0.0;
};

/// A single outlier, as a drive that breaks loose, weighs no more than some deviations.
Eigen::VectorXd tamed(const Eigen::VectorXd& off) {
  constexpr double kMost = 6.0;
  return off.unaryExpr([](double each) { return kMost * std::tanh(each / kMost); });
}

Solution solve(const BladeProblem& problem, const Prior& prior, const Parameters& start) {
  constexpr int kSteps = 40;
  constexpr double kDelta = 1e-4;
  Parameters at = start;
  const auto squares = [&](const Parameters& of) {
    return tamed(problem.off(of)).squaredNorm() +
           ((of - prior.mean).array() / prior.deviation.array()).square().sum();
  };
  double now = squares(at);
  double damping = 1e-2;
  Eigen::Matrix<double, kParameters, kParameters> square;
  for (int step = 0; step < kSteps && damping < 1e8; ++step) {
    const Eigen::VectorXd off = tamed(problem.off(at));
    Eigen::MatrixXd slope(off.size(), static_cast<Eigen::Index>(kParameters));
    for (Eigen::Index p = 0; p < kParameters; ++p) {
      Parameters moved = at;
      moved[p] += kDelta;
      slope.col(p) = (tamed(problem.off(moved)) - off) / kDelta;
    }
    const Parameters weight = prior.deviation.array().square().inverse();
    square = slope.transpose() * slope;
    square.diagonal() += weight;
    const Parameters right = -(slope.transpose() * off) - weight.cwiseProduct(at - prior.mean);
    bool better = false;
    while (!better && damping < 1e8) {
      auto damped = square;
      damped.diagonal() *= 1.0 + damping;
      const Parameters tried = at + damped.ldlt().solve(right);
      const double then = squares(tried);
      better = then < now;
      damping *= better ? 0.3 : 4.0;
      if (better) {
        const double gained = now - then;
        at = tried;
        now = then;
        damping = gained < 1e-6 * now ? 1e9 : damping;
      }
    }
  }
  const double each =
      std::max(1.0, now / static_cast<double>(std::max<std::size_t>(1, problem.count())));
  const Parameters variance = square.inverse().diagonal();
  return {at, (each * variance).cwiseSqrt(), now};
}

/// From several edges on: far from it a soft opening looks like a sharp one elsewhere.
Solution best_of(const BladeProblem& problem, const Prior& prior) {
  Solution best;
  best.squares = -1.0;
  for (const double edge : {0.13, 0.22, 0.32, 0.45}) {
    Parameters start = prior.mean;
    start[kEdgeE] = start[kEdgeR] = edge;
    const Solution found = solve(problem, prior, start);
    if (best.squares < 0.0 || found.squares < best.squares) {
      best = found;
    }
  }
  return best;
}

/// Duties of this side, and how its spool follows.
void find_times(const std::vector<DozerLog>& logs, std::size_t drive, bool extends,
                BladeSideEstimate& side) {
  const double sign = extends ? 1.0 : -1.0;
  std::vector<std::vector<double>> kept;
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      for (const auto* values : {&segment.blade[drive].duty, &segment.blade[drive].spool}) {
        std::vector<double> part(values->size());
        std::transform(values->begin(), values->end(), part.begin(),
                       [sign](double each) { return std::max(0.0, sign * each); });
        kept.push_back(std::move(part));
      }
    }
  }
  std::vector<SentAndSeen> pieces;
  for (std::size_t n = 0; n + 1 < kept.size(); n += 2) {
    SentAndSeen piece{kept[n], kept[n + 1], std::vector<char>(kept[n].size(), 0)};
    for (std::size_t at = 0; at < piece.judged.size(); ++at) {
      piece.judged[at] = kept[n][at] > 0.0 || kept[n + 1][at] > 0.01 ? 1 : 0;
    }
    pieces.push_back(std::move(piece));
  }
  const LagFit fit = fit_lag(pieces, 2, 0.0);
  side.dead_time_s = fit.dead_time_s;
  side.lag_s = fit.lag_s;
}

void find_driven(const std::vector<DozerLog>& logs, std::size_t drive, bool extends,
                 BladeSideEstimate& side) {
  constexpr std::size_t kOver = 8;
  /// What was sent before it is no longer under way.
  constexpr std::size_t kStands = 40;
  const double sign = extends ? 1.0 : -1.0;
  for (const DozerLog& log : logs) {
    for (const DozerSegment& segment : log.segments) {
      const BladeSeries& of = segment.blade[drive];
      std::size_t since = 0;
      for (std::size_t at = kOver; at < of.stroke_m.size(); ++at) {
        const double speed_mps =
            sign * (of.stroke_m[at] - of.stroke_m[at - kOver]) / (kGrid_s * kOver);
        const double duty = sign * of.duty[at];
        since = duty > 0.0 ? since + 1 : 0;
        if (since > kStands && speed_mps > kDrivenMoves_mps) {
          side.driven_least = side.known() ? std::min(side.driven_least, duty) : duty;
          side.driven_most = std::max(side.driven_most, duty);
        }
      }
    }
  }
}

}  // namespace

BladeMachine blade_machine(const DozerProfile& profile, std::size_t drive) {
  const double pump_m3prad =
      profile.implement.displacement_m3prev * profile.implement.efficiency / kTwoPi;
  if (drive == kBladeLift) {
    return {profile.blade.cap_area_m2(), profile.blade.rod_area_m2(),
            BladeKinematics(profile.blade).stroke_max_m(), profile.implement.valve_flow_max_m3ps,
            pump_m3prad};
  }
  return {profile.tilt.cap_area_m2(), profile.tilt.rod_area_m2(),
          TiltKinematics(profile.tilt).stroke_max_m(), profile.tilt.valve_flow_max_m3ps,
          pump_m3prad};
}

BladeFit fit_blade(const std::vector<DozerLog>& logs, std::size_t drive,
                   const BladeMachine& machine, const Estimate& pump_flow_factor) {
  BladeFit fit;
  for (const bool extends : {true, false}) {
    find_driven(logs, drive, extends, fit.drive.side(extends));
  }
  const BladeProblem problem(logs, drive, machine);
  if (problem.count() == 0 || !(fit.drive.extend.known() || fit.drive.retract.known())) {
    return fit;
  }
  const Prior prior = prior_of(pump_flow_factor);
  const Solution found = best_of(problem, prior);
  const double oil_s = std::exp(found.value[kOilLag]);
  for (const bool extends : {true, false}) {
    BladeSideEstimate& side = fit.drive.side(extends);
    if (side.known()) {
      const Eigen::Index edge = extends ? kEdgeE : kEdgeR;
      side.curve = curve_of(found.value, extends);
      side.edge = {side.curve.edge, found.deviation[edge], true};
      find_times(logs, drive, extends, side);
      side.lag_s.value += oil_s;
    }
  }
  const auto says = [&](Eigen::Index at) {
    return found.deviation[at] < kSaysMore * prior.deviation[at];
  };
  const double valve = std::exp(found.value[kValveFlow]);
  fit.drive.valve_flow_m3ps = {valve * machine.valve_flow_m3ps,
                               valve * machine.valve_flow_m3ps * found.deviation[kValveFlow],
                               says(kValveFlow)};
  const double pump = std::exp(found.value[kPumpFlow]);
  fit.pump_flow_factor = {pump, pump * found.deviation[kPumpFlow],
                          !pump_flow_factor.known && says(kPumpFlow)};
  return fit;
}

}  // namespace graben::identify
