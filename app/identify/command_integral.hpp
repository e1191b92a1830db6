// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a command held between any two times, also before its recording began.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace graben::identify {

class CommandIntegral {
 public:
  /// Where to look first; times that are asked for one after another only go on.
  struct Place {
    std::size_t row = 0;
  };

  /// Both must outlive it. `held_before`: the first row's command was there before; else none was.
  CommandIntegral(const std::vector<double>& time_s, const std::vector<double>& command,
                  bool held_before)
      : time_s_(time_s), command_(command), before_(held_before ? command.front() : 0.0) {}

  /// Calls take(command, share of the time) for each piece of `from_s` to `until_s`.
  template <class Take>
  void pieces(double from_s, double until_s, Place& place, const Take& take) const {
    const double whole_s = until_s - from_s;
    double at_s = from_s;
    if (at_s < time_s_.front()) {
      const double end_s = std::min(until_s, time_s_.front());
      take(before_, (end_s - at_s) / whole_s);
      at_s = end_s;
    }
    std::size_t row = place.row;
    while (row > 0 && time_s_[row] > at_s) {
      --row;
    }
    while (at_s < until_s) {
      while (row + 1 < time_s_.size() && time_s_[row + 1] <= at_s) {
        ++row;
      }
      const double end_s = row + 1 < time_s_.size() ? std::min(until_s, time_s_[row + 1]) : until_s;
      take(command_[row], (end_s - at_s) / whole_s);
      at_s = end_s;
    }
    place.row = row;
  }

 private:
  const std::vector<double>& time_s_;
  const std::vector<double>& command_;
  double before_;
};

}  // namespace graben::identify
