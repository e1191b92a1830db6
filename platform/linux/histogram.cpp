#include "platform/linux/histogram.hpp"

#include <algorithm>
#include <cinttypes>

namespace graben {
namespace {

void print_row(std::FILE* to, std::size_t from_us, std::uint64_t count) {
  if (count > 0) {
    static_cast<void>(std::fprintf(to, "%06zu %06" PRIu64 "\n", from_us, count));
  }
}

}  // namespace

void Histogram::add(TimeUs duration_us) {
  const TimeUs duration = std::max<TimeUs>(duration_us, 0);
  const auto us = static_cast<std::size_t>(duration);
  if (us < kFineBins) {
    ++fine_[us];
  } else {
    ++coarse_[std::min<std::size_t>(us / kCoarseUs, kCoarseBins) - 1];
  }
  min_us_ = count_ == 0 ? duration : std::min(min_us_, duration);
  max_us_ = std::max(max_us_, duration);
  sum_us_ += duration;
  ++count_;
}

TimeUs Histogram::mean_us() const {
  return count_ == 0 ? 0 : sum_us_ / static_cast<TimeUs>(count_);
}

void Histogram::print_summary(std::FILE* to, const char* name) const {
  static_cast<void>(
      std::fprintf(to, "%s: C:%7" PRIu64 " Min:%7" PRId64 " Avg:%5" PRId64 " Max:%8" PRId64 "\n",
                   name, count_, min_us_, mean_us(), max_us_));
}

void Histogram::print_bins(std::FILE* to, const char* name) const {
  static_cast<void>(std::fprintf(to, "# Histogram: %s, us\n", name));
  for (std::size_t us = 0; us < kFineBins; ++us) {
    print_row(to, us, fine(us));
  }
  std::uint64_t overflows = 0;
  for (std::size_t ms = 1; ms <= kCoarseBins; ++ms) {
    print_row(to, ms * kCoarseUs, coarse(ms));
    overflows += coarse(ms);
  }
  static_cast<void>(std::fprintf(to,
                                 "# Total: %09" PRIu64 "\n# Min Latencies: %05" PRId64
                                 "\n# Avg Latencies: %05" PRId64 "\n# Max Latencies: %05" PRId64
                                 "\n# Histogram Overflows: %05" PRIu64 "\n",
                                 count_, min_us_, mean_us(), max_us_, overflows));
}

}  // namespace graben
