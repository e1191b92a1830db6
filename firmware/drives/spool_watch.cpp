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

/// Of one spool: it is stuck.
bool follow(const DriveRow& drive, const SentCommand& command, int i, double spool_ratio,
            int cycles, bool received, SpoolState& state) {
  const double duty_ratio = command.duty_ratio[i];
  const double starts_s =
      std::max(spool_starts_s(drive), command.tried ? kUnknownSpoolStarts_s : 0.0);
  const double lag_s = std::max(spool_lag_s(drive), command.tried ? kUnknownSpoolLag_s : 0.0);
  const int starting = cycles_under_way(starts_s + kSpoolFrameCycles * kCyclePeriod_s);
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
    return false;
  }
  const CommandHistory::Range range = state.range.now();
  const double tolerance = drive.watch.spool_tolerance;
  const bool wrong = spool_ratio < range.least - tolerance || spool_ratio > range.most + tolerance;
  state.wrong_cycles = wrong ? std::min(state.wrong_cycles + 1, kSpoolWrongCycles) : 0;
  return state.wrong_cycles >= kSpoolWrongCycles;
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
    if (drives[i].watch.senses_spool && follow(drives[i], sent, i, seen[i].spool_ratio,
                                               feedback.cycles, feedback.received, spool[i])) {
      faults.add(Fault::kSpoolStuck);
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
