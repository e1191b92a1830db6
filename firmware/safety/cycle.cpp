// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/cycle.hpp"

#include <algorithm>

#include "firmware/core/whole.hpp"
#include "firmware/safety/fault_table.hpp"
#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

/// Period of a cycle. [us; derived: kCyclePeriod_s]
constexpr auto kCycle_us = static_cast<TimeUs>(kCyclePeriod_s * kMicrosecondsPerSecond);
/// Time without a cycle beyond which a cycle is a stall. [us; derived: kMostCyclesLate]
constexpr TimeUs kStalled_us = kMostCyclesLate * kCycle_us;

/// The bucket a cycle on.
TimeUs bucket_after(TimeUs late_us, TimeUs elapsed_us) {
  const TimeUs left_us = late_us - quotient(std::max<TimeUs>(elapsed_us, 0), kLateBucketLeak);
  const TimeUs filled_us =
      elapsed_us > kCycleLate_us ? std::min(elapsed_us, kStalled_us) - kCycle_us : 0;
  return std::max<TimeUs>(left_us, 0) + filled_us;
}

}  // namespace

Fault first_of(std::initializer_list<Fault> faults) {
  const auto* there =
      std::find_if(faults.begin(), faults.end(), [](Fault fault) { return fault != Fault::kNone; });
  return there == faults.end() ? Fault::kNone : *there;
}

TimeWatchResult watch_time(const TimeState& last, TimeUs now_us) {
  const TimeUs elapsed_us = last.has_stepped ? now_us - last.last_us : 0;
  TimeWatchResult result;
  result.elapsed_s = as_double(std::clamp<TimeUs>(elapsed_us, 0, kStalled_us)) * 1e-6;
  result.period_s = std::min(result.elapsed_s, kLongestPeriod_s);
  result.state = {now_us, elapsed_us > kCycleLate_us ? std::min(last.late_cycles + 1, 2) : 0,
                  bucket_after(last.late_us, elapsed_us), true};
  if (elapsed_us > kStalled_us) {
    result.fault = Fault::kCycleStalled;
  } else if (result.state.late_cycles >= 2 || result.state.late_us > kLateBucket_us) {
    result.fault = Fault::kCycleOverrun;
  }
  return result;
}

PilotResult pilot(const PilotState& last, const ModeState& mode, const FaultSet& faults,
                  bool by_hand, double elapsed_s) {
  // Outside motion a spool is stuck only where it should have closed after it. Whatever stopped the
  // machine first must not hide it.
  const bool stopped = mode.mode == EcuMode::kFault;
  FaultSet in_motion_too = faults;
  if (last.fault_s > 0.0) {
    in_motion_too.remove(Fault::kUncommandedMotion);  // By then it is one at rest.
  }
  const bool disobeyed = faults.has(Fault::kSpoolStuck) ||
                         (stopped && (cuts_pilot(mode.fault) || cuts_pilot(in_motion_too)));
  PilotResult result;
  result.state.kept_cut = !in_motion(mode.mode) && (last.kept_cut || disobeyed);
  result.state.fault_s = stopped ? std::min(last.fault_s + elapsed_s, 2.0 * kDrivesStop_s) : 0.0;
  const bool moves = !in_motion(mode.mode) && faults.has(Fault::kUncommandedMotion);
  const bool unknown = stopped && faults.has(Fault::kSpoolMissing);
  const bool asked = moves || unknown || result.state.fault_s > kDrivesStop_s;
  result.state.at_rest = !in_motion(mode.mode) && !by_hand && (last.at_rest || asked);
  result.cut =
      result.state.kept_cut || result.state.at_rest || cuts_pilot(mode.fault) || cuts_pilot(faults);
  result.state.known = last.known || in_motion(mode.mode) || result.cut;
  return result;
}

Cycle begin_cycle(CycleMemory& memory, bool intact, TimeUs now_us) {
  const Fault corrupt = intact ? Fault::kNone : Fault::kMemoryCorrupt;
  if (!intact) {
    memory.mode = {EcuMode::kFault, corrupt};
    memory.pilot = {true, true};
  }
  const TimeWatchResult time = watch_time(memory.time, now_us);
  memory.time = time.state;
  return {first_of({time.fault, corrupt}), memory.mode.mode, time.elapsed_s, time.period_s};
}

ModeDecision decide_mode(const CycleMemory& memory, const Cycle& cycle, const CommonValid& valid,
                         Fault fault, bool centred, bool stop_requested) {
  const ModeRequest request = {first_of({cycle.fault, valid.fault, fault}),
                               valid.enable,
                               valid.automatic,
                               valid.task != Task::kNone,
                               centred,
                               stop_requested};
  return {request, next_mode(memory.mode, request), cycle.elapsed_s};
}

void take_refusal(Fault refused, ModeDecision& decision) {
  if (refused != Fault::kNone) {
    decision.mode = {EcuMode::kFault, refused};
  }
}

void end_cycle(const ModeDecision& decision, const CommonValid& valid, CycleMemory& memory,
               MachineOutputs& outputs, MachineStatus& status) {
  const ModeState& mode = decision.mode;
  const PilotResult pressure =
      pilot(memory.pilot, mode, valid.faults, valid.by_hand() && !decision.request.enable,
            decision.elapsed_s);
  outputs.pilot_cut = pressure.cut;
  outputs.pilot_known = pressure.state.known;
  status.mode = mode.mode;
  status.stand_in = valid.stand_in;
  status.faults = valid.faults;
  status.faults.add(decision.request.fault);
  status.why_not_armed = why_not_armed(mode, decision.request, status.faults);
  status.faults.add(mode.fault);
  status.faults.add(valid.warned);
  status.fault = first_of({mode.fault, valid.degraded.first(), valid.warned.first()});
  memory.mode = mode;
  memory.pilot = pressure.state;
}

}  // namespace graben
