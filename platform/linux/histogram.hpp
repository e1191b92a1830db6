#pragma once
/// Durations counted in bins of fixed number: what a cycle can record without memory or time to
/// spare. The maximum is exact, however far out it lies.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "firmware/core/time.hpp"

namespace graben {

/// Bins of 1 us below 1 ms, then of 1 ms below 100 ms; the last takes all from 100 ms on. 9 KB.
class Histogram {
 public:
  static constexpr std::size_t kFineBins = 1000;
  static constexpr std::size_t kCoarseBins = 100;
  static constexpr TimeUs kCoarseUs = kMillisecondUs;

  /// Constant cost. A negative duration counts as 0.
  void add(TimeUs duration_us);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The three are 0 when nothing was added.
  [[nodiscard]] TimeUs min_us() const { return min_us_; }
  [[nodiscard]] TimeUs max_us() const { return max_us_; }
  [[nodiscard]] TimeUs mean_us() const;
  /// How many took from `us` to less than `us` + 1; us in [0, 1000).
  [[nodiscard]] std::uint64_t fine(std::size_t us) const { return fine_[us]; }
  /// How many took from `ms` to less than `ms` + 1 milliseconds; ms in [1, 100], and 100 has all
  /// that took longer.
  [[nodiscard]] std::uint64_t coarse(std::size_t ms) const { return coarse_[ms - 1]; }

  /// One line, as cyclictest -q: count, min, mean and max in microseconds.
  void print_summary(std::FILE* to, const char* name) const;
  /// As cyclictest -h: a row `microseconds count` for each bin that is not empty, the lower edge
  /// first, then the totals. Rows from 001000 on are 1 ms wide.
  void print_bins(std::FILE* to, const char* name) const;

 private:
  std::array<std::uint64_t, kFineBins> fine_{};
  std::array<std::uint64_t, kCoarseBins> coarse_{};
  std::uint64_t count_ = 0;
  TimeUs min_us_ = 0;
  TimeUs max_us_ = 0;
  TimeUs sum_us_ = 0;
};

}  // namespace graben
