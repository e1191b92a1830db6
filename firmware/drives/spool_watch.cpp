#include "firmware/drives/spool_watch.hpp"

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

/// Of one spool: it is stuck.
bool follow(const DriveRow& drive, double duty_ratio, double spool_ratio, bool received,
            SpoolState& state) {
  state.sent.add(duty_ratio);
  if (!received) {
    state.wrong_cycles = 0;
    return false;
  }
  const CommandHistory::Range range = state.sent.range(cycles_under_way(spool_arrives_s(drive)));
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

int cycles_under_way(double time_s) {
  const double cycles = std::ceil(time_s / kCycle_s);
  return static_cast<int>(std::clamp(cycles, 1.0, double{CommandHistory::kMostCycles}));
}

FaultSet watch_spools(DriveRows drives, const SentCommand& sent, Span<const ValidDrive> seen,
                      const ValveFeedback& feedback, Span<SpoolState> spool, int& echo_cycles) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    if (drives[i].watch.senses_spool &&
        follow(drives[i], sent.duty_ratio[i], seen[i].spool_ratio, feedback.received, spool[i])) {
      faults.add(Fault::kSpoolStuck);
    }
  }
  const bool differs = feedback.received && feedback.has_echo && feedback.enabled != sent.enable;
  echo_cycles = differs ? std::min(echo_cycles + 1, kEchoCycles) : 0;
  if (echo_cycles >= kEchoCycles) {
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
