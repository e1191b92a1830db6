// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <cmath>

#include "app/identify/command_integral.hpp"
#include "app/identify/least_squares.hpp"
#include "app/identify/simple_models.hpp"

namespace graben::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLagStep_s = 0.05;
constexpr std::size_t kOwnLags = 24;
constexpr std::size_t kOtherLags = 14;

/// What was commanded of late, each drive by means over kLagStep_s; the own one both ways apart.
Table ridge_table(const std::vector<SimpleRun>& runs, std::size_t drive) {
  const std::size_t drives = runs.front().command.size();
  const std::size_t poses = runs.front().pose.size();
  const std::size_t columns = 2 * kOwnLags + (drives - 1) * kOtherLags + poses + 1;
  Table table;
  table.x = MatrixXd::Zero(static_cast<Index>(columns), static_cast<Index>(row_count(runs)));
  table.y.resize(table.x.cols());
  Index to = 0;
  for (const SimpleRun& run : runs) {
    std::size_t column = 0;
    for (std::size_t of = 0; of < drives; ++of) {
      const bool own = of == drive;
      const CommandIntegral commanded(run.time_s, run.command[of], moves_first(run));
      for (std::size_t lag = 0; lag < (own ? kOwnLags : kOtherLags); ++lag) {
        CommandIntegral::Place place;
        for (std::size_t at = 0; at < run.time_s.size(); ++at) {
          const double until_s = run.time_s[at] - kLagStep_s * static_cast<double>(lag);
          double mean = 0.0;
          commanded.pieces(until_s - kLagStep_s, until_s, place,
                           [&](double command, double share) { mean += share * command; });
          const Index row = to + static_cast<Index>(at);
          table.x(static_cast<Index>(column), row) = mean;
          if (own) {
            table.x(static_cast<Index>(column + 1), row) = std::abs(mean);
          }
        }
        column += own ? 2 : 1;
      }
    }
    for (std::size_t at = 0; at < run.time_s.size(); ++at) {
      const Index row = to + static_cast<Index>(at);
      for (std::size_t of = 0; of < poses; ++of) {
        table.x(static_cast<Index>(column + of), row) = run.pose[of][at];
      }
      table.x(static_cast<Index>(columns - 1), row) = 1.0;
      table.y[row] = run.velocity[at];
    }
    table.judged.insert(table.judged.end(), run.judged.begin(), run.judged.end());
    to += static_cast<Index>(run.time_s.size());
  }
  return table;
}

}  // namespace

RidgeFit fit_ridge(const std::vector<SimpleRun>& runs, std::size_t drive) {
  constexpr double kRidge = 1e-4;
  RidgeFit fit;
  if (row_count(runs) == 0) {
    return fit;
  }
  const Table table = ridge_table(runs, drive);
  if (stands(table)) {
    return fit;
  }
  const VectorXd weight = solved(normal_of(table, 0), kRidge);
  const Explained judged = explained(table, weight, 1);
  fit.known = true;
  fit.judged_r2 = judged.r2;
  fit.rms = judged.rms;
  fit.trained_r2 = explained(table, weight, 0).r2;
  return fit;
}

}  // namespace graben::identify
