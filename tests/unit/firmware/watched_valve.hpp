// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A valve whose spools are watched, cycle by cycle.

#include <cmath>

#include "firmware/drives/spool_watch.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

namespace graben::test::valve {

inline constexpr double kTolerance = 0.125;
/// Of 0.1 s to settle three tenths until it starts, and 20 ms that its frame may be old, in cycles.
inline constexpr int kStarts = 5;
/// A cycle's share of a lag of 0.035 s.
inline constexpr double kShare = 0.01 / 0.045;

/// Cycles until a spool that stays where it is while its duty goes `way` off is found stuck. What
/// two equal lags have left of a step after n of their cycles is (1 - k)^n (1 + n k).
inline int cycles_to_find(int starts, double way, double share = kShare) {
  int n = 1;
  while (way * (1.0 - std::pow(1.0 - share, n) * (1.0 + n * share)) <= kTolerance) {
    ++n;
  }
  return starts - 1 + n + kSpoolWrongCycles - 1;
}

inline void all_at(ExcavatorValid& valid, double spool_ratio) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    valid.drive[i].spool_ratio = spool_ratio;
  }
}

/// A valve and what is sent to it, cycle by cycle. Its spools are where `measured` says.
struct Valve {
  ExcavatorProfile profile = test::plain_machine();
  test::SpoolWatch state;
  LastCommands<kDriveCount> sent;
  ExcavatorValid valid;

  /// Whether this cycle finds a spool stuck.
  bool stuck() { return step().has(Fault::kSpoolStuck); }
  /// Whether it finds that the valve side does not say what we say.
  bool deaf() { return step().has(Fault::kValveNotFollowing); }
  FaultSet step() { return test::watch_spools(profile, state, sent, valid); }
  /// Cycles until a fault, counting the one that has it; -1 if none comes.
  int cycles_until(Fault fault) {
    for (int n = 1; n <= 200; ++n) {
      if (step().has(fault)) {
        return n;
      }
    }
    return -1;
  }
  void settle(double duty) {
    sent.duty_ratio = {duty, duty, duty};
    all_at(valid, duty);
    repeat(CommandHistory::kMostCycles, [&] { assert_false(stuck()); });
  }
  /// Settled there, and told to close.
  void close_from(double duty) {
    settle(duty);
    sent.duty_ratio = {0.0, 0.0, 0.0};
  }
  /// Settled at rest, and its first spool tried.
  void try_boom(bool tried = true) {
    settle(0.0);
    sent.tried = tried;
    sent.duty_ratio = {0.8, 0.0, 0.0};
  }
};

}  // namespace graben::test::valve
