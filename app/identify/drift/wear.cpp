// SPDX-License-Identifier: Apache-2.0
#include "app/identify/drift/wear.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

namespace graben::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMega = 1e6;

/// Rows of one linear problem; those of a block hang together.
struct Rows {
  std::vector<VectorXd> x;
  std::vector<double> y;
  std::vector<std::size_t> block;
};

struct Solution {
  VectorXd value;
  VectorXd deviation;
  bool known = false;
};

/// Least squares; deviations by what blocks leave together.
Solution solve(const Rows& rows, Index columns) {
  constexpr double kLeastOwn = 1e-6;  // Of a column, beside what the others say of it.
  Solution solution;
  if (rows.y.size() < 3 * static_cast<std::size_t>(columns)) {
    return solution;
  }
  MatrixXd square = MatrixXd::Zero(columns, columns);
  VectorXd right = VectorXd::Zero(columns);
  for (std::size_t n = 0; n < rows.y.size(); ++n) {
    square += rows.x[n] * rows.x[n].transpose();
    right += rows.x[n] * rows.y[n];
  }
  // Columns of one size: else small ones would seem to say nothing.
  VectorXd scale = square.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const MatrixXd even =
      scale.cwiseInverse().asDiagonal() * square * scale.cwiseInverse().asDiagonal();
  const Eigen::LDLT<MatrixXd> solver(even);
  if (solver.info() != Eigen::Success || solver.vectorD().minCoeff() < kLeastOwn) {
    return solution;
  }
  const MatrixXd inverse = scale.cwiseInverse().asDiagonal() *
                           solver.solve(MatrixXd::Identity(columns, columns)) *
                           scale.cwiseInverse().asDiagonal();
  solution.value = inverse * right;
  MatrixXd outer = MatrixXd::Zero(columns, columns);
  VectorXd gradient = VectorXd::Zero(columns);
  for (std::size_t n = 0; n < rows.y.size(); ++n) {
    gradient += rows.x[n] * (rows.y[n] - rows.x[n].dot(solution.value));
    if (n + 1 == rows.y.size() || rows.block[n + 1] != rows.block[n]) {
      outer += gradient * gradient.transpose();
      gradient.setZero();
    }
  }
  solution.deviation = (inverse * outer * inverse).diagonal().cwiseMax(0.0).cwiseSqrt();
  solution.known = true;
  return solution;
}

/// Rows of one rest, each less the rest's mean: where it began says nothing. Returns by how much it
/// was pushed, MPa s.
double add_rest(const CylinderSeries& of, std::size_t from, std::size_t until, Rows& rows) {
  constexpr std::size_t kEvery = 5;
  constexpr std::size_t kBlock = 100;  // Rows, 5 s.
  std::vector<Eigen::Vector4d> all;
  double pushed = 0.0;  // MPa s
  double both_ways = 0.0;
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (std::size_t at = from; at < until; ++at) {
    const double now = kGrid_s * (of.cap_pa[at] - of.rod_pa[at]) / kMega;
    pushed += now;
    both_ways += std::abs(now);
    if ((at - from) % kEvery == 0) {
      all.emplace_back(-pushed, of.cap_pa[at] / kMega, of.rod_pa[at] / kMega, of.stroke_m[at]);
      mean += all.back();
    }
  }
  mean /= static_cast<double>(all.size());
  const std::size_t first = rows.block.empty() ? 0 : rows.block.back() + 1;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Eigen::Vector4d row = all[n] - mean;
    rows.x.emplace_back(row.head<3>());
    rows.y.push_back(row[3]);
    rows.block.push_back(first + n / kBlock);
  }
  return both_ways;
}

}  // namespace

Estimate find_creep(const MachineLog& log, std::size_t axis) {
  constexpr std::size_t kSettles = 150;  // Grid points after the valve has closed.
  constexpr std::size_t kShortest = 350;
  constexpr double kLeast_s = 20.0;
  constexpr double kLeastPush_mpa = 1.0;
  constexpr double kNeutral = 1e-3;
  Rows rows;
  double stood_s = 0.0;
  double pushed = 0.0;  // MPa s
  for (const LogSegment& segment : log.segments) {
    const CylinderSeries& of = segment.axis[axis];
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= segment.size(); ++at) {
      if (at == segment.size() || std::abs(of.duty[at]) > kNeutral) {
        if (at - begin > kShortest) {
          pushed += add_rest(of, begin + kSettles, at, rows);
          stood_s += kGrid_s * static_cast<double>(at - begin - kSettles);
        }
        begin = at + 1;
      }
    }
  }
  Estimate creep;
  const Solution solution = solve(rows, 3);
  // Without pressure, or to the chamber of more of it, something else moves it.
  if (stood_s >= kLeast_s && solution.known && pushed > kLeastPush_mpa * stood_s &&
      solution.value[0] > -2.0 * solution.deviation[0]) {
    creep = {solution.value[0] / kMega, solution.deviation[0] / kMega, true};
  }
  return creep;
}

Estimate find_friction(const std::vector<SteadyPoint>& points, const ExcavatorGeometry& geometry,
                       std::size_t axis) {
  constexpr Index kColumns = 6;
  constexpr double kMoves_mps = 0.02;
  constexpr std::size_t kFew = 30;
  const CylinderGeometry& cylinder = geometry.cylinder[axis];
  Rows rows;
  std::array<std::size_t, 2> ways{};
  for (const SteadyPoint& point : points) {
    if (point.axis != static_cast<int>(axis) || std::abs(point.speed_mps) < kMoves_mps) {
      continue;
    }
    const double way = point.speed_mps > 0.0 ? 1.0 : -1.0;
    ++ways[way > 0.0 ? 0 : 1];
    VectorXd row(kColumns);
    row << 1.0, point.stroke_m, point.stroke_m * point.stroke_m, way, point.speed_mps,
        point.speed_mps * std::abs(point.speed_mps);
    rows.x.push_back(row);
    rows.y.push_back(cylinder.cap_area_m2() * point.cap_pa[axis] -
                     cylinder.rod_area_m2() * point.rod_pa[axis]);
    rows.block.push_back(point.block);
  }
  Estimate friction;
  const Solution solution = solve(rows, kColumns);
  if (ways[0] >= kFew && ways[1] >= kFew && solution.known) {
    friction = {solution.value[3], solution.deviation[3], true};
  }
  return friction;
}

}  // namespace graben::identify
