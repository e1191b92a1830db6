#include "firmware/drives/command_history.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
constexpr double kCycle_s = 0.01;

CommandHistory::Range widened(CommandHistory::Range range, const double* begin, const double* end) {
  for (const double* sent = begin; sent < end; ++sent) {
    range = {std::min(range.least, *sent), std::max(range.most, *sent)};
  }
  return range;
}
}  // namespace

CommandHistory::CommandHistory(double neutral) { sent_.fill(neutral); }

void CommandHistory::add(double sent) {
  newest_ = newest_ + 1 == kMostCycles ? 0 : newest_ + 1;
  sent_[static_cast<unsigned>(newest_)] = sent;
}

CommandHistory::Range CommandHistory::range(int cycles) const {
  const double* const ring = sent_.data();
  const int first = newest_ + 1 - cycles;
  const Range range = widened({newest(), newest()}, ring + std::max(first, 0), ring + newest_);
  return widened(range, ring + kMostCycles + std::min(first, 0), ring + kMostCycles);
}

int cycles_under_way(double time_s) {
  const double cycles = std::ceil(time_s / kCycle_s);
  return static_cast<int>(std::clamp(cycles, 1.0, double{CommandHistory::kMostCycles}));
}

}  // namespace graben
