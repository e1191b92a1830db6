// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Rows of many runs as one linear problem, of which some rows are fitted to and others judge.

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "app/identify/simple_models.hpp"

namespace graben::identify {

/// A column of `x` for each row of the runs, one under another.
struct Table {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  std::vector<char> judged;
  std::vector<std::size_t> block;  ///< Rows whose errors hang together have one number.
};

struct Normal {
  Eigen::MatrixXd square;
  Eigen::VectorXd right;
};

struct Explained {
  double r2 = 0.0;
  double rms = 0.0;
  double squares = 0.0;
};

[[nodiscard]] std::size_t row_count(const std::vector<SimpleRun>& runs);
/// The first row's command was there before it: the drive moves already.
[[nodiscard]] bool moves_first(const SimpleRun& run);
/// Of the rows that are `judged` or not.
[[nodiscard]] Normal normal_of(const Table& table, char judged);
/// `ridge` in parts of the columns' mean square.
[[nodiscard]] Eigen::VectorXd solved(const Normal& normal, double ridge);
[[nodiscard]] Explained explained(const Table& table, const Eigen::VectorXd& weight, char judged);
/// Nothing is to be explained.
[[nodiscard]] bool stands(const Table& table);

}  // namespace graben::identify
