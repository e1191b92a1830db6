// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Durations counted in bins of fixed number: what a cycle can record without memory or time to
/// spare. Minimum, mean and maximum are exact to the nanosecond, however far out they lie.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace graben {

/// Bins of 1 us below 1 ms. What took longer is counted, and the first of it noted by number. 9 KB.
class Histogram {
 public:
  static constexpr std::size_t kBins = 1000;
  static constexpr std::size_t kNotedOverflows = 64;

  /// Constant cost. A negative duration counts as 0.
  void add(std::int64_t duration_ns);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The three are 0 when nothing was added.
  [[nodiscard]] std::int64_t min_ns() const { return min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  [[nodiscard]] std::int64_t mean_ns() const;
  /// How many took from `us` to less than `us` + 1; us in [0, 1000).
  [[nodiscard]] std::uint64_t bin(std::size_t us) const { return bins_[us]; }
  /// How many took 1 ms or more.
  [[nodiscard]] std::uint64_t overflows() const { return overflows_; }
  /// How many durations had been added before the i-th of them, from 0; i below overflows() and
  /// kNotedOverflows.
  [[nodiscard]] std::uint64_t overflow_at(std::size_t i) const { return overflow_at_[i]; }

 private:
  std::array<std::uint64_t, kBins> bins_{};
  std::array<std::uint64_t, kNotedOverflows> overflow_at_{};
  std::uint64_t overflows_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t min_ns_ = 0;
  std::int64_t max_ns_ = 0;
  std::int64_t sum_ns_ = 0;
};

/// All of them as one table, as cyclictest -h does its threads: a row `microseconds count count..`
/// for each bin, tabs between the columns, then a line of each total; all but the rows begins with
/// #.
/// `# Total:` leaves out the overflows.
void print_histograms(std::FILE* to, const std::vector<const Histogram*>& columns);

}  // namespace graben
