#include "app/scope/sim/sim_pacer.hpp"

#include <algorithm>

namespace graben::scope {

void SimPacer::set_pace(double pace, Clock::time_point now) {
  constexpr std::chrono::duration<double> kCycle(0.01);
  period_ = std::chrono::round<Clock::duration>(kCycle / pace);
  next_ = std::min(next_, now + period_);
}

int SimPacer::due(Clock::time_point now) {
  if (now < next_) {
    return 0;
  }
  const auto behind = static_cast<std::uint64_t>((now - next_) / period_) + 1;
  const std::uint64_t done = std::min<std::uint64_t>(behind, kMostAtOnce);
  dropped_ += behind - done;
  next_ += static_cast<Clock::duration::rep>(behind) * period_;
  return static_cast<int>(done);
}

}  // namespace graben::scope
