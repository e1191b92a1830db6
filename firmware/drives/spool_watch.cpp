// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/spool_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

CommandHistory::Range widened(CommandHistory::Range range, const double* begin, const double* end) {
  for (const double* sent = begin; sent < end; ++sent) {
    range = {std::min(range.least, *sent), std::max(range.most, *sent)};
  }
  return range;
}

/// Cycles by which a spool's frame may be old. [cycles; derived: its frame comes every 20 ms, two
/// kCyclePeriod_s]
constexpr int kSpoolFrameCycles = 2;

/// One lag of both bounds.
CommandHistory::Range lagged(const CommandHistory::Range& last,
                             const CommandHistory::Range& towards, double newest_share) {
  return {std::min(towards.least, last.least + newest_share * (towards.least - last.least)),
          std::max(towards.most, last.most + newest_share * (towards.most - last.most))};
}

/// On its way out it has come less far than the slowest sound one.
bool is_behind(double spool_ratio, const CommandHistory::Range& range, double tolerance) {
  const double nearest = std::clamp(spool_ratio, range.least, range.most);
  return std::abs(spool_ratio) < std::abs(nearest) &&
         (spool_ratio * nearest >= 0.0 || std::abs(spool_ratio) <= tolerance);
}

/// A cycle of a spool that is behind: does it still stand where it fell behind?
void fall_behind(double spool_ratio, int cycles, SpoolState& state) {
  if (state.behind_cycles == 0) {
    state.behind_at_ratio = spool_ratio;
    state.stood_cycles = 0;
  }
  if (state.stood_cycles == state.behind_cycles &&
      std::abs(spool_ratio - state.behind_at_ratio) < kSpoolMoves) {
    state.stood_cycles += cycles;
  }
  state.behind_cycles += cycles;
}

/// It is no longer behind.
Fault caught_up(double spool_ratio, double tolerance, SpoolState& state) {
  const bool came = std::abs(spool_ratio) - std::abs(state.behind_at_ratio) > tolerance;
  const bool stood = state.stood_cycles >= kSpoolWrongCycles;
  if (came && !stood) {
    state.later_cycles = std::min(state.later_cycles + state.behind_cycles, kSpoolBehindCycles);
  }
  state.behind_cycles = 0;
  return came && stood ? Fault::kSpoolLate : Fault::kNone;
}

/// Wrong for long enough, and not on its way to where it should be.
bool is_stuck(bool wrong, double spool_ratio, const CommandHistory::Range& range,
              SpoolState& state) {
  if (!wrong) {
    state.wrong_cycles = 0;
    state.slow_cycles = 0;
    return false;
  }
  if (state.wrong_cycles == 0) {
    state.wrong_at_ratio = spool_ratio;
  }
  state.wrong_cycles = std::min(state.wrong_cycles + 1, kSpoolWrongCycles);
  if (state.wrong_cycles < kSpoolWrongCycles) {
    return false;
  }
  const double nearest = std::clamp(spool_ratio, range.least, range.most);
  const double nearer = std::abs(state.wrong_at_ratio - nearest) - std::abs(spool_ratio - nearest);
  if (nearer < kSpoolMoves || state.slow_cycles >= kSpoolBehindCycles) {
    return true;
  }
  state.slow_cycles += state.wrong_cycles;
  state.wrong_cycles = 0;
  return false;
}

/// Of one spool: what is wrong with it.
Fault follow(const DriveRow& drive, const SentCommand& command, int i, double spool_ratio,
             int cycles, bool received, SpoolState& state) {
  const double duty_ratio = command.duty_ratio[i];
  const double starts_s =
      std::max(spool_starts_s(drive), command.tried ? kUnknownSpoolStarts_s : 0.0);
  const double lag_s = std::max(spool_lag_s(drive), command.tried ? kUnknownSpoolLag_s : 0.0);
  const int starting =
      cycles_under_way(starts_s + (kSpoolFrameCycles + state.later_cycles) * kCyclePeriod_s);
  // An implicit step: a little slower than the lag itself.
  const double led = duty_ratio + command.lead_ratio[i];
  // A spool faster than the one that is led gets to where the lead points.
  for (int n = 0; n < cycles; ++n) {
    state.sent.add(duty_ratio);
    state.range.follow(widened(state.sent.range(starting), &led, &led + 1),
                       kCyclePeriod_s / (kCyclePeriod_s + lag_s));
  }
  if (!received) {
    state.wrong_cycles = 0;
    state.behind_cycles = 0;
    return Fault::kNone;
  }
  const CommandHistory::Range range = state.range.now();
  const double tolerance = drive.watch.spool_tolerance;
  const bool wrong = spool_ratio < range.least - tolerance || spool_ratio > range.most + tolerance;
  // A valve that is tried has all that time already.
  if (wrong && !command.tried && state.behind_cycles < kSpoolBehindCycles &&
      is_behind(spool_ratio, range, tolerance)) {
    fall_behind(spool_ratio, cycles, state);
    state.wrong_cycles = 0;
    return Fault::kNone;
  }
  if (!wrong && state.behind_cycles > 0) {
    state.wrong_cycles = 0;
    return caught_up(spool_ratio, tolerance, state);
  }
  return is_stuck(wrong, spool_ratio, range, state) ? Fault::kSpoolStuck : Fault::kNone;
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

void SpoolRange::follow(const CommandHistory::Range& commands, double newest_share) {
  lag_[0] = lagged(lag_[0], commands, newest_share);
  lag_[1] = lagged(lag_[1], lag_[0], newest_share);
}

int cycles_under_way(double time_s) {
  const double cycles = std::ceil(time_s / kCyclePeriod_s);
  return static_cast<int>(std::clamp(cycles, 1.0, double{CommandHistory::kMostCycles}));
}

FaultSet watch_spools(DriveRows drives, const SentCommand& sent, Span<const ValidDrive> seen,
                      const ValveFeedback& feedback, Span<SpoolState> spool, int& echo_cycles) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    if (drives[i].watch.senses_spool) {
      const Fault found = follow(drives[i], sent, i, seen[i].spool_ratio, feedback.cycles,
                                 feedback.received, spool[i]);
      if (found != Fault::kNone) {
        faults.add(found);
      }
    }
  }
  const bool differs = feedback.received && feedback.has_echo && feedback.enabled != sent.enable;
  echo_cycles = differs ? std::min(echo_cycles + 1, feedback.echo_cycles) : 0;
  if (echo_cycles >= feedback.echo_cycles) {
    faults.add(Fault::kValveNotFollowing);
  }
  return faults;
}

bool spools_centred(DriveRows drives, Span<const ValidDrive> seen) {
  bool centred = true;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& bounds = drives[i].watch;
    centred = centred &&
              (!bounds.senses_spool || std::abs(seen[i].spool_ratio) <= bounds.spool_tolerance);
  }
  return centred;
}

}  // namespace graben
