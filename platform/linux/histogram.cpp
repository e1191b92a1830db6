// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/histogram.hpp"

#include <algorithm>
#include <cinttypes>

namespace graben {
namespace {

constexpr std::int64_t kMicrosecond_ns = 1000;

std::uint64_t whole_us(std::int64_t duration_ns) {
  return static_cast<std::uint64_t>(duration_ns / kMicrosecond_ns);
}

void print_row(std::FILE* to, std::size_t us, const std::vector<const Histogram*>& columns) {
  static_cast<void>(std::fprintf(to, "%06zu", us));
  char before = ' ';
  for (const Histogram* column : columns) {
    static_cast<void>(std::fprintf(to, "%c%06" PRIu64, before, column->bin(us)));
    before = '\t';
  }
  static_cast<void>(std::fprintf(to, "\n"));
}

template <class Value>
void print_line(std::FILE* to, const char* name, int digits,
                const std::vector<const Histogram*>& columns, Value value) {
  static_cast<void>(std::fprintf(to, "# %s:", name));
  for (const Histogram* column : columns) {
    static_cast<void>(std::fprintf(to, " %0*" PRIu64, digits, value(*column)));
  }
  static_cast<void>(std::fprintf(to, "\n"));
}

void print_overflows(std::FILE* to, std::size_t number, const Histogram& column) {
  static_cast<void>(std::fprintf(to, "# Thread %zu:", number));
  const auto noted = std::min<std::uint64_t>(column.overflows(), Histogram::kNotedOverflows);
  for (std::size_t i = 0; i < noted; ++i) {
    static_cast<void>(std::fprintf(to, " %05" PRIu64, column.overflow_at(i)));
  }
  if (noted < column.overflows()) {
    static_cast<void>(std::fprintf(to, " # %05" PRIu64 " others", column.overflows() - noted));
  }
  static_cast<void>(std::fprintf(to, "\n"));
}

}  // namespace

void Histogram::add(std::int64_t duration_ns) {
  const std::int64_t duration = std::max<std::int64_t>(duration_ns, 0);
  const std::uint64_t us = whole_us(duration);
  if (us < kBins) {
    ++bins_[static_cast<std::size_t>(us)];
  } else {
    if (overflows_ < kNotedOverflows) {
      overflow_at_[static_cast<std::size_t>(overflows_)] = count_;
    }
    ++overflows_;
  }
  min_ns_ = count_ == 0 ? duration : std::min(min_ns_, duration);
  max_ns_ = std::max(max_ns_, duration);
  sum_ns_ += duration;
  ++count_;
}

std::int64_t Histogram::mean_ns() const {
  return count_ == 0 ? 0 : sum_ns_ / static_cast<std::int64_t>(count_);
}

void print_histograms(std::FILE* to, const std::vector<const Histogram*>& columns) {
  static_cast<void>(std::fprintf(to, "# Histogram\n"));
  for (std::size_t us = 0; us < Histogram::kBins; ++us) {
    print_row(to, us, columns);
  }
  print_line(to, "Total", 9, columns,
             [](const Histogram& of) { return of.count() - of.overflows(); });
  print_line(to, "Min Latencies", 5, columns,
             [](const Histogram& of) { return whole_us(of.min_ns()); });
  print_line(to, "Avg Latencies", 5, columns,
             [](const Histogram& of) { return whole_us(of.mean_ns()); });
  print_line(to, "Max Latencies", 5, columns,
             [](const Histogram& of) { return whole_us(of.max_ns()); });
  print_line(to, "Histogram Overflows", 5, columns,
             [](const Histogram& of) { return of.overflows(); });
  static_cast<void>(std::fprintf(to, "# Histogram Overflow at cycle number:\n"));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    print_overflows(to, i, *columns[i]);
  }
}

}  // namespace graben
