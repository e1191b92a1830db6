// SPDX-License-Identifier: Apache-2.0
#include "app/identify/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStood = 1e-9;  // Variance of what stands.

}  // namespace

std::size_t row_count(const std::vector<SimpleRun>& runs) {
  std::size_t count = 0;
  for (const SimpleRun& run : runs) {
    count += run.time_s.size();
  }
  return count;
}

bool moves_first(const SimpleRun& run) {
  constexpr double kShare = 0.1;
  double squares = 0.0;
  for (const double velocity : run.velocity) {
    squares += velocity * velocity;
  }
  const double usual = std::sqrt(squares / static_cast<double>(run.velocity.size()));
  return std::abs(run.velocity.front()) > kShare * usual;
}

Normal normal_of(const Table& table, char judged) {
  const Index columns = table.x.rows();
  Normal normal{MatrixXd::Zero(columns, columns), VectorXd::Zero(columns)};
  constexpr Index kChunk = 512;
  MatrixXd chunk(columns, kChunk);
  VectorXd values(kChunk);
  Index filled = 0;
  const auto flush = [&] {
    const auto part = chunk.leftCols(filled);
    normal.square.selfadjointView<Eigen::Lower>().rankUpdate(part);
    normal.right.noalias() += part * values.head(filled);
    filled = 0;
  };
  for (Index row = 0; row < table.y.size(); ++row) {
    if (table.judged[static_cast<std::size_t>(row)] == judged) {
      chunk.col(filled) = table.x.col(row);
      values[filled++] = table.y[row];
      if (filled == kChunk) {
        flush();
      }
    }
  }
  flush();
  normal.square = normal.square.selfadjointView<Eigen::Lower>();
  return normal;
}

VectorXd solved(const Normal& normal, double ridge) {
  MatrixXd square = normal.square;
  const double usual = square.trace() / static_cast<double>(square.rows()) + 1e-12;
  square.diagonal().array() += ridge * usual;
  return square.ldlt().solve(normal.right);
}

Explained explained(const Table& table, const VectorXd& weight, char judged) {
  double sum = 0.0;
  double squares = 0.0;
  double left = 0.0;
  double rows = 0.0;
  for (Index row = 0; row < table.y.size(); ++row) {
    if (table.judged[static_cast<std::size_t>(row)] == judged) {
      const double error = table.y[row] - table.x.col(row).dot(weight);
      left += error * error;
      sum += table.y[row];
      squares += table.y[row] * table.y[row];
      rows += 1.0;
    }
  }
  if (rows == 0.0) {
    return {};
  }
  const double spread = squares - sum * sum / rows;
  return {spread > kStood * rows ? 1.0 - left / spread : 0.0, std::sqrt(left / rows), left};
}

bool stands(const Table& table) {
  const double rows = static_cast<double>(std::max<Index>(1, table.y.size()));
  const double mean = table.y.sum() / rows;
  return table.y.squaredNorm() / rows - mean * mean < kStood;
}

}  // namespace graben::identify
