// SPDX-License-Identifier: Apache-2.0
#include "app/identify/simple_models.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/identify/command_integral.hpp"
#include "app/identify/least_squares.hpp"

namespace graben::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kSide = 10;           // Knots of a side, beside 0.
constexpr std::size_t kHats = 2 * kSide;    // What the curve is a sum of.
constexpr double kBlock_s = 10.0;           // Errors within it hang together.
constexpr std::size_t kSearchRows = 12000;  // Enough to search dead time and lag by.
constexpr double kShortestLag_s = 0.005;
constexpr double kLongestLag_s = 1.0;
constexpr double kSparse = 5.0;  // Rows that a knot needs to count as driven.
constexpr double kEdge = 0.05;   // Of the fastest speed.

double largest_command(const std::vector<SimpleRun>& runs, std::size_t drive) {
  double most = 0.0;
  for (const SimpleRun& run : runs) {
    for (const double command : run.command[drive]) {
      most = std::max(most, std::abs(command));
    }
  }
  return most;
}

/// Shares of the hats at a command, in parts of the largest one; the first kSide are positive.
void add_hats(double command, double share, double* hats) {
  const double place = std::min(std::abs(command), 1.0) * static_cast<double>(kSide);
  const auto below = std::min(static_cast<std::size_t>(place), kSide - 1);
  const double part = place - static_cast<double>(below);
  double* of = hats + (command < 0.0 ? kSide : 0);
  if (below > 0) {
    of[below - 1] += share * (1.0 - part);
  }
  of[below] += share * part;
}

/// Hats behind dead time and lag, averaged as the velocity is.
MatrixXd hats_of(const SimpleRun& run, std::size_t drive, double largest, double dead_time_s,
                 double lag_s) {
  const auto rows = static_cast<Index>(run.time_s.size());
  MatrixXd lagged = MatrixXd::Zero(kHats, rows);
  MatrixXd turned = MatrixXd::Zero(kHats, rows);
  const CommandIntegral commanded(run.time_s, run.command[drive], moves_first(run));
  CommandIntegral::Place place;
  Eigen::Matrix<double, kHats, 1> state = Eigen::Matrix<double, kHats, 1>::Zero();
  if (moves_first(run)) {
    add_hats(run.command[drive].front() / largest, 1.0, state.data());
    lagged.col(0) = state;
  }
  for (Index row = 1; row < rows; ++row) {
    const auto at = static_cast<std::size_t>(row);
    const double from_s = run.time_s[at - 1];
    const double step_s = run.time_s[at] - from_s;
    Eigen::Matrix<double, kHats, 1> open = Eigen::Matrix<double, kHats, 1>::Zero();
    commanded.pieces(
        from_s - dead_time_s, run.time_s[at] - dead_time_s, place,
        [&](double command, double share) { add_hats(command / largest, share, open.data()); });
    const double kept = std::exp(-step_s / lag_s);
    const Eigen::Matrix<double, kHats, 1> before = state;
    state = kept * state + (1.0 - kept) * open;
    lagged.col(row) = state;
    // Exact of a constant opening within the step.
    turned.col(row) = turned.col(row - 1) + open * step_s + (before - state) * lag_s;
  }
  for (Index row = rows - 1; row >= 0; --row) {
    const auto at = static_cast<std::size_t>(row);
    if (run.since[at] < at) {
      const double apart_s = run.time_s[at] - run.time_s[run.since[at]];
      lagged.col(row) = (turned.col(row) - turned.col(static_cast<Index>(run.since[at]))) / apart_s;
    }
  }
  return lagged;
}

Table curve_table(const std::vector<SimpleRun>& runs, std::size_t drive, double largest,
                  double dead_time_s, double lag_s) {
  Table table;
  const auto rows = static_cast<Index>(row_count(runs));
  table.x.resize(kHats, rows);
  table.y.resize(rows);
  Index to = 0;
  std::size_t block = 0;
  for (const SimpleRun& run : runs) {
    const auto count = static_cast<Index>(run.time_s.size());
    table.x.middleCols(to, count) = hats_of(run, drive, largest, dead_time_s, lag_s);
    double begin_s = run.time_s.front();
    for (std::size_t at = 0; at < run.time_s.size(); ++at) {
      if (run.time_s[at] - begin_s > kBlock_s) {
        begin_s = run.time_s[at];
        ++block;
      }
      table.y[to + static_cast<Index>(at)] = run.velocity[at];
      table.block.push_back(block);
    }
    table.judged.insert(table.judged.end(), run.judged.begin(), run.judged.end());
    to += count;
    ++block;
  }
  return table;
}

constexpr double kCurveRidge = 1e-6;

double cost_of(const std::vector<SimpleRun>& runs, std::size_t drive, double largest,
               double dead_time_s, double lag_s) {
  const Table table = curve_table(runs, drive, largest, dead_time_s, lag_s);
  return explained(table, solved(normal_of(table, 0), kCurveRidge), 0).squares;
}

/// Whole runs up to kSearchRows rows, evenly; the judged ones judge nothing here.
std::vector<SimpleRun> searched_runs(const std::vector<SimpleRun>& runs) {
  const std::size_t every = std::max<std::size_t>(1, row_count(runs) / kSearchRows);
  std::vector<SimpleRun> some;
  for (std::size_t at = 0; at < runs.size(); at += every) {
    some.push_back(runs[at]);
  }
  return some;
}

struct Answer {
  double dead_time_s = 0.0;
  double lag_s = 0.1;
};

/// Coarsely everywhere, then closer and closer about the best.
Answer search(const std::vector<SimpleRun>& runs, std::size_t drive, double largest) {
  constexpr double kCoarse_s = 0.05;
  constexpr double kFine_s = 0.001;
  constexpr std::array<double, 4> kLags_s = {0.02, 0.08, 0.2, 0.5};
  Answer best;
  double least = INFINITY;
  const auto attempt = [&](double dead_time_s, double lag_s) {
    const Answer tried{std::clamp(dead_time_s, 0.0, kLongestDeadTime_s),
                       std::clamp(lag_s, kShortestLag_s, kLongestLag_s)};
    const double cost = cost_of(runs, drive, largest, tried.dead_time_s, tried.lag_s);
    if (cost < least) {
      least = cost;
      best = tried;
      return true;
    }
    return false;
  };
  for (double dead_time_s = 0.0; dead_time_s <= kLongestDeadTime_s + 1e-9;
       dead_time_s += kCoarse_s) {
    for (const double lag_s : kLags_s) {
      attempt(dead_time_s, lag_s);
    }
  }
  double ratio = 1.6;
  for (double step_s = 0.5 * kCoarse_s; step_s > kFine_s; step_s *= 0.5) {
    bool better = true;
    for (int turn = 0; turn < 4 && better; ++turn) {
      const Answer from = best;
      better = attempt(from.dead_time_s + step_s, from.lag_s);
      better = attempt(from.dead_time_s - step_s, from.lag_s) || better;
      better = attempt(from.dead_time_s, from.lag_s * ratio) || better;
      better = attempt(from.dead_time_s, from.lag_s / ratio) || better;
      better = attempt(from.dead_time_s + step_s, from.lag_s / ratio) || better;
      better = attempt(from.dead_time_s - step_s, from.lag_s * ratio) || better;
    }
    ratio = std::sqrt(ratio);
  }
  return best;
}

/// Deviations of dead time and lag, whose errors hang together within a block.
void take_deviations(const std::vector<SimpleRun>& runs, std::size_t drive, double largest,
                     const Table& table, const VectorXd& weight, CurveFit& fit) {
  constexpr double kStep_s = 0.004;
  const auto slope = [&](double dead_s, double lag_s) {
    const Table there = curve_table(runs, drive, largest, dead_s, lag_s);
    return VectorXd((there.x - table.x).transpose() * weight);
  };
  const double later_s = fit.dead_time_s + kStep_s > kLongestDeadTime_s ? -kStep_s : kStep_s;
  const VectorXd by_dead = slope(fit.dead_time_s + later_s, fit.lag_s) / later_s;
  const VectorXd by_lag = slope(fit.dead_time_s, fit.lag_s + kStep_s) / kStep_s;
  constexpr Index kAll = Index{kHats} + 2;
  MatrixXd square = MatrixXd::Zero(kAll, kAll);
  MatrixXd gradients = MatrixXd::Zero(kAll, kAll);
  VectorXd gradient = VectorXd::Zero(kAll);
  VectorXd row_of(kAll);
  for (Index row = 0; row < table.y.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (table.judged[at] == 0) {
      row_of << table.x.col(row), by_dead[row], by_lag[row];
      square.selfadjointView<Eigen::Lower>().rankUpdate(row_of);
      gradient += row_of * (table.y[row] - table.x.col(row).dot(weight));
    }
    if (at + 1 == table.block.size() || table.block[at + 1] != table.block[at]) {
      gradients += gradient * gradient.transpose();
      gradient.setZero();
    }
  }
  square = square.selfadjointView<Eigen::Lower>();
  square.diagonal().array() += 1e-9 * square.trace() / static_cast<double>(kAll);
  const MatrixXd inverse = square.ldlt().solve(MatrixXd::Identity(kAll, kAll));
  const MatrixXd covariance = inverse * gradients * inverse;
  fit.dead_time_deviation_s = std::sqrt(std::max(0.0, covariance(kHats, kHats)));
  fit.lag_deviation_s = std::sqrt(std::max(0.0, covariance(kHats + 1, kHats + 1)));
}

VectorXd weight_of(const CurveFit& fit) {
  VectorXd weight(kHats);
  for (std::size_t at = 0; at < kSide; ++at) {
    weight[static_cast<Index>(at)] = fit.speed[kSide + 1 + at];
    weight[static_cast<Index>(kSide + at)] = fit.speed[kSide - 1 - at];
  }
  return weight;
}

}  // namespace

bool CurveFit::at_bound() const {
  constexpr double kNear_s = 1e-3;
  return dead_time_s < kNear_s || dead_time_s > kLongestDeadTime_s - kNear_s;
}

double CurveFit::half_s() const { return dead_time_s + lag_s * std::log(2.0); }
double CurveFit::most_s() const { return dead_time_s + lag_s * std::log(10.0); }

double CurveFit::fastest(double side) const {
  double most = 0.0;
  for (std::size_t at = 0; at < knot.size(); ++at) {
    if (side * knot[at] > 0.0 && driven[at] != 0 && std::abs(speed[at]) > std::abs(most)) {
      most = speed[at];
    }
  }
  return most;
}

double CurveFit::edge(double side) const {
  const double wanted = kEdge * std::abs(fastest(side));
  if (wanted == 0.0) {
    return 0.0;
  }
  // From the fastest down: noise about zero is no opening.
  std::size_t n = kSide;
  const auto at = [&](std::size_t number) { return side > 0.0 ? kSide + number : kSide - number; };
  while (n > 1 && std::abs(speed[at(n)]) < std::abs(fastest(side))) {
    --n;
  }
  while (n > 1 && std::abs(speed[at(n - 1)]) > wanted) {
    --n;
  }
  if (n > 1 && driven[at(n - 1)] == 0) {
    return 0.0;
  }
  const double above = std::abs(speed[at(n)]);
  const double below = n > 1 ? std::min(std::abs(speed[at(n - 1)]), wanted) : 0.0;
  const double part = above > below ? (wanted - below) / (above - below) : 0.0;
  const double from = std::abs(knot[at(n - 1)]);
  return from + std::clamp(part, 0.0, 1.0) * (std::abs(knot[at(n)]) - from);
}

CurveFit fit_curve(const std::vector<SimpleRun>& runs, std::size_t drive) {
  CurveFit fit;
  const double largest = largest_command(runs, drive);
  if (largest <= 0.0 || row_count(runs) == 0) {
    return fit;
  }
  const Answer found = search(searched_runs(runs), drive, largest);
  const Table table = curve_table(runs, drive, largest, found.dead_time_s, found.lag_s);
  if (stands(table)) {
    return fit;
  }
  const Normal normal = normal_of(table, 0);
  const VectorXd weight = solved(normal, kCurveRidge);
  fit.known = true;
  fit.dead_time_s = found.dead_time_s;
  fit.lag_s = found.lag_s;
  for (int n = -int{kSide}; n <= int{kSide}; ++n) {
    const Index at = n > 0 ? n - 1 : static_cast<Index>(kSide) - n - 1;
    fit.knot.push_back(largest * n / double(kSide));
    fit.speed.push_back(n == 0 ? 0.0 : weight[at]);
    fit.driven.push_back(n == 0 || normal.square(at, at) > kSparse ? 1 : 0);
  }
  const Explained judged = explained(table, weight, 1);
  fit.judged_r2 = judged.r2;
  fit.rms = judged.rms;
  fit.trained_r2 = explained(table, weight, 0).r2;
  take_deviations(runs, drive, largest, table, weight, fit);
  return fit;
}

std::vector<std::vector<double>> curve_velocities(const std::vector<SimpleRun>& runs,
                                                  std::size_t drive, const CurveFit& fit) {
  const VectorXd weight = weight_of(fit);
  std::vector<std::vector<double>> all;
  for (const SimpleRun& run : runs) {
    const VectorXd velocity =
        hats_of(run, drive, fit.knot.back(), fit.dead_time_s, fit.lag_s).transpose() * weight;
    all.emplace_back(velocity.data(), velocity.data() + velocity.size());
  }
  return all;
}

}  // namespace graben::identify
