// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two models of a drive that anybody can make, beside which the physical one has to stand: a
/// static curve behind a dead time and a first-order lag, and a ridge regression on what all drives
/// were commanded of late. Each is judged by rows that it was not made of.

#include <cstddef>
#include <string>
#include <vector>

namespace graben::identify {

inline constexpr char kNeither = 2;

/// A run without a break, of one drive among others. Every vector has the length of `time_s`.
struct SimpleRun {
  std::vector<double> time_s;                ///< Increasing.
  std::vector<std::vector<double>> command;  ///< Per drive, -1 .. 1, held until the next row.
  std::vector<double> velocity;              ///< Of the drive in question, its unit per second.
  /// Row since which `velocity` is the mean: what the model says is then averaged alike. The row
  /// itself: it was measured at once.
  std::vector<std::size_t> since;
  std::vector<std::vector<double>> pose;  ///< Per quantity; any number of them.
  std::vector<char> judged;               ///< 1: judges, 0: is fitted to; or kNeither.
};

/// v = curve(command) behind dead time and lag.
struct CurveFit {
  bool known = false;  ///< False: the drive or its command stood.
  double dead_time_s = 0.0;
  double dead_time_deviation_s = 0.0;  ///< Not valid at a bound.
  double lag_s = 0.0;
  double lag_deviation_s = 0.0;
  std::vector<double> knot;   ///< Commands, increasing; 0 is among them.
  std::vector<double> speed;  ///< At each.
  std::vector<char> driven;   ///< 1: rows were there.
  double judged_r2 = 0.0;     ///< Share of the velocity's variance explained, of judged rows.
  double trained_r2 = 0.0;
  double rms = 0.0;  ///< Of judged rows, unexplained.

  [[nodiscard]] bool at_bound() const;
  /// From a step of the command to 50 and 90 % of the speed, s.
  [[nodiscard]] double half_s() const;
  [[nodiscard]] double most_s() const;
  /// Command at which `side` (+1, -1) reaches 5 % of its fastest speed; 0: it was not driven, or
  /// not with smaller commands.
  [[nodiscard]] double edge(double side) const;
  [[nodiscard]] double fastest(double side) const;
};

struct RidgeFit {
  bool known = false;
  double judged_r2 = 0.0;
  double trained_r2 = 0.0;
  double rms = 0.0;
};

/// Longest dead time that is searched, s.
inline constexpr double kLongestDeadTime_s = 0.5;

/// `drive` is the place of its own command among each run's.
[[nodiscard]] CurveFit fit_curve(const std::vector<SimpleRun>& runs, std::size_t drive);
[[nodiscard]] RidgeFit fit_ridge(const std::vector<SimpleRun>& runs, std::size_t drive);

/// What a curve predicts, per run and row.
[[nodiscard]] std::vector<std::vector<double>> curve_velocities(const std::vector<SimpleRun>& runs,
                                                                std::size_t drive,
                                                                const CurveFit& fit);

}  // namespace graben::identify
