// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of a run. Each is defined once, in the table of its kind of run (dig_figures(), ...),
/// and feeds the text on the terminal, the JSON summary, a campaign's file and table, and the
/// report.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/runs/code_text.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {

/// Unit in which a figure is shown, the factor to it from the SI unit, and its decimals.
struct ShownUnit {
  const char* text;
  double per_si;
  int decimals;
  bool is_whole = false;  ///< A count: a whole number in JSON too.
};
inline constexpr ShownUnit kMillimetres = {"mm", 1e3, 1};
inline constexpr ShownUnit kSeconds = {"s", 1.0, 2};
inline constexpr ShownUnit kMicroseconds = {"us", 1.0, 1};  ///< Of a figure in microseconds.
inline constexpr ShownUnit kMetresPerSecond = {"m/s", 1.0, 3};
inline constexpr ShownUnit kMetresPerSecond2 = {"m/s2", 1.0, 2};
inline constexpr ShownUnit kMegapascals = {"MPa", 1e-6, 1};
inline constexpr ShownUnit kDegrees = {"deg", kDegreesPerRad, 1};
inline constexpr ShownUnit kPercent = {"%", 100.0, 1};
inline constexpr ShownUnit kRatio = {"", 1.0, 3};
inline constexpr ShownUnit kPerSecond = {"/s", 1.0, 3};
inline constexpr ShownUnit kMetresPerSecond3 = {"m/s3", 1.0, 2};
inline constexpr ShownUnit kKilowattHours = {"kWh", 1.0 / 3.6e6, 3};
inline constexpr ShownUnit kCubicMetres = {"m3", 1.0, 3};
inline constexpr ShownUnit kNewtons = {"N", 1.0, 0};
inline constexpr ShownUnit kTimes = {"", 1.0, 0};
inline constexpr ShownUnit kCount = {"", 1.0, 0, true};

/// Which end of a campaign's distribution is the bad one: p95 and max are told, or p5 and min.
enum class BadEnd { kHigh, kLow };

struct FigureInfo {
  const char* name;  ///< Key in JSON, with its SI unit; "group.key" for one that stands in a group.
  const char* text;  ///< Less than kFigureTextWidth characters.
  ShownUnit unit;
  const char* column = nullptr;  ///< Name in a campaign's file; none: not kept there.
  BadEnd bad = BadEnd::kHigh;
};
inline constexpr int kFigureTextWidth = 50;

/// Of every kind of run that has lambda: the sum of its changes from cycle to cycle.
inline constexpr FigureInfo kLambdaVariation = {"lambda_variation_ps", "lambda, total variation",
                                                kPerSecond, "lambda_variation_ps"};

/// A figure and where a run's summary has it; not a number where it has none.
template <class Summary>
struct Figure {
  FigureInfo info;
  double (*of)(const Summary& summary);
};
template <class Summary>
using FigureTable = std::vector<Figure<Summary>>;

/// One after the other.
template <class Summary>
[[nodiscard]] FigureTable<Summary> joined(FigureTable<Summary> table,
                                          const FigureTable<Summary>& more) {
  table.insert(table.end(), more.begin(), more.end());
  return table;
}

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

/// `info` points into the table of the kind of run, which lives as long as the program.
struct FigureValue {
  const FigureInfo* info;
  double value;  ///< In SI units; kAbsent where the run has none.
};

/// The number as files tell it: few digits, finer than anything that is measured, without what
/// sums leave behind them, and no negative zero.
[[nodiscard]] double plain_number(double value, int digits = 12);

/// All that is told of one run.
struct RunFigures {
  std::vector<FigureValue> values;
  const char* limits_text = "";  ///< What the shares below are of.
  LimitShares limit_share;
};

template <class Summary>
[[nodiscard]] RunFigures figures_of(const FigureTable<Summary>& table, const Summary& summary,
                                    const char* limits_text) {
  RunFigures figures = {{}, limits_text, summary.limit_share};
  for (const Figure<Summary>& figure : table) {
    figures.values.push_back({&figure.info, figure.of(summary)});
  }
  return figures;
}

/// Puts the figures of these names first, in this order.
void lead_with(const std::vector<std::string>& names, RunFigures& figures);

/// "8.6", in the figure's unit.
[[nodiscard]] std::string shown_value(const FigureValue& figure);
/// A line for each figure that the run has, then one for each share.
[[nodiscard]] std::string figures_text(const RunFigures& figures);

/// Median: the upper one of two in the middle, 0 of nothing.
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Maximum and root mean square of what is fed in.
class Spread {
 public:
  void add(double value) {
    max_ = std::max(max_, value);
    squares_ += value * value;
    ++count_;
  }
  [[nodiscard]] double max() const { return max_; }
  [[nodiscard]] double rms() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0;
  }

 private:
  double max_ = 0.0;
  double squares_ = 0.0;
  long count_ = 0;
};

/// Pace of a run, and of the controller within it on this computer.
struct RunPace {
  double duration_s = 0.0;  ///< Of the whole run, simulated.
  double real_time_factor = 0.0;
  long cycles = 0;
  double cycle_median_us = 0.0;
  double cycle_max_us = 0.0;
};

/// Of samples that have time_s and cycle_us, one for each control cycle.
template <class Sample>
[[nodiscard]] RunPace pace_of(const std::vector<Sample>& samples, double wall_s) {
  RunPace pace;
  std::vector<double> cycle_us;
  for (const Sample& sample : samples) {
    cycle_us.push_back(sample.cycle_us);
    pace.cycle_max_us = std::max(pace.cycle_max_us, sample.cycle_us);
  }
  pace.cycle_median_us = median(cycle_us);
  pace.cycles = static_cast<long>(samples.size());
  pace.duration_s = samples.empty() ? 0.0 : samples.back().time_s;
  pace.real_time_factor = wall_s > 0.0 ? pace.duration_s / wall_s : 0.0;
  return pace;
}

/// The table with the figures of the summary's member `pace`, which every kind of run has.
template <class Summary>
[[nodiscard]] FigureTable<Summary> with_pace(FigureTable<Summary> table) {
  using S = Summary;
  return joined<S>(
      std::move(table),
      {
          {{"duration_s", "simulated time of the run", kSeconds},
           [](const S& s) { return s.pace.duration_s; }},
          {{"real_time_factor", "times faster than real", kTimes},
           [](const S& s) { return s.pace.real_time_factor; }},
          {{"cycles", "control cycles", kCount},
           [](const S& s) { return static_cast<double>(s.pace.cycles); }},
          {{"cycle_median_us", "controller's cycle, on this computer, median", kMicroseconds},
           [](const S& s) { return s.pace.cycle_median_us; }},
          {{"cycle_max_us", "controller's cycle, on this computer, max", kMicroseconds},
           [](const S& s) { return s.pace.cycle_max_us; }},
      });
}

}  // namespace graben::runs
