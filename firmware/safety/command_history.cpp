#include "firmware/safety/command_history.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {
constexpr double kCycle_s = 0.01;
}

CommandHistory::CommandHistory(double neutral) { sent_.fill(neutral); }

void CommandHistory::add(double sent) {
  newest_ = newest_ + 1 == kMostCycles ? 0 : newest_ + 1;
  sent_[static_cast<unsigned>(newest_)] = sent;
}

CommandHistory::Range CommandHistory::range(int cycles) const {
  Range range{newest(), newest()};
  int at = newest_;
  for (int n = 1; n < cycles; ++n) {
    at = at == 0 ? kMostCycles - 1 : at - 1;
    const double sent = sent_[static_cast<unsigned>(at)];
    range = {std::min(range.least, sent), std::max(range.most, sent)};
  }
  return range;
}

int cycles_under_way(double time_s) {
  const double cycles = std::ceil(time_s / kCycle_s);
  return static_cast<int>(std::clamp(cycles, 1.0, double{CommandHistory::kMostCycles}));
}

}  // namespace graben
