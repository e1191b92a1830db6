#pragma once
/// The commands that something may still be answering to.

#include <array>

namespace graben {

/// What was sent in the cycles of late.
class CommandHistory {
 public:
  static constexpr int kMostCycles = 96;

  struct Range {
    double least = 0.0;
    double most = 0.0;
  };

  /// As if `neutral` had been sent all the time.
  explicit CommandHistory(double neutral = 0.0);

  void add(double sent);
  /// Of the newest `cycles`, 1 .. kMostCycles.
  [[nodiscard]] Range range(int cycles) const;
  [[nodiscard]] double newest() const { return sent_[static_cast<unsigned>(newest_)]; }

 private:
  std::array<double, kMostCycles> sent_{};  ///< Ring.
  int newest_ = 0;
};

/// Cycles that a command of `time_s` ago has been under way; as many as are kept at most.
[[nodiscard]] int cycles_under_way(double time_s);

}  // namespace graben
