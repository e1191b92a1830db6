// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Everything that a controller does around a cycle, whatever its machine: its own time, the mode,
/// the pilot pressure, and the status that the operator reads.

#include <initializer_list>

#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/mode.hpp"

namespace graben {

/// The first that is not kNone.
[[nodiscard]] Fault first_of(std::initializer_list<Fault> faults);

/// State of the controller's own time.
struct TimeState {
  TimeUs last_us = 0;
  int late_cycles = 0;  ///< In a row.
  TimeUs late_us = 0;   ///< What late cycles have filled into the bucket, see watch_time().
  bool has_stepped = false;
};

struct TimeWatchResult {
  /// kCycleStalled: so long without a cycle that it is not known what the machine did meanwhile.
  /// kCycleOverrun: the second in a row that came late, or late ones too often.
  Fault fault = Fault::kNone;
  double elapsed_s = 0.0;  ///< Since the last cycle, up to what is a stall; 0 in the first.
  double period_s = 0.0;   ///< The same for what may change by so much a second.
  TimeState state;
};

/// A cycle is late that comes more than 15 ms after the last one. Each late one fills what it is
/// late by into a bucket, which loses a tenth of the time that passes; more than 60 ms in it is an
/// overrun too. So one stall of up to 50 ms is let pass; three of 40 ms within 200 ms, or every
/// other cycle 6 ms late, are not. `now_us` must not fall from call to call.
[[nodiscard]] TimeWatchResult watch_time(const TimeState& last, TimeUs now_us);

/// State of the pilot pressure from cycle to cycle.
struct PilotState {
  bool kept_cut = false;  ///< Until the operator arms again.
  bool known = false;     ///< It has armed or asked for a cut since its start.
  bool at_rest = false;   ///< Cut as nothing may move; until he arms, or has the machine by hand.
  double fault_s = 0.0;   ///< For which a fault has stopped the machine.
};

struct PilotResult {
  bool cut = false;  ///< It has to go now.
  PilotState state;
};

/// The cut lasts until the operator has armed again: a spool that did not obey may not have its
/// pressure back because the deadman was let go.
///
/// It also goes when nothing may move: where a drive moves that nobody asks to (kUncommandedMotion
/// outside motion), where the machine was stopped by a fault and its spools are not known, and 1 s
/// after any fault that stopped it. Such a cut strands no machine: it ends as well when the
/// operator has it `by_hand`, in manual mode with enable released.
[[nodiscard]] PilotResult pilot(const PilotState& last, const ModeState& mode,
                                const FaultSet& faults, bool by_hand, double elapsed_s);

/// State from cycle to cycle, whatever the machine.
struct CycleMemory {
  ModeState mode;
  TimeState time;
  PilotState pilot;
};

/// The beginning of a cycle.
struct Cycle {
  Fault fault = Fault::kNone;  ///< Of its time, or kMemoryCorrupt.
  EcuMode last_mode = EcuMode::kSilent;
  double elapsed_s = 0.0;  ///< See TimeWatchResult.
  double period_s = 0.0;
};

/// Watches time and memory; `intact`: what the controller stores is. If not, all of it was made
/// anew by now: the mode is one that this stopped, and the pilot pressure is cut until the operator
/// arms again, as nobody knows whether it was.
[[nodiscard]] Cycle begin_cycle(CycleMemory& memory, bool intact, TimeUs now_us);

/// Mode of a cycle and what was asked of it.
struct ModeDecision {
  ModeRequest request;
  ModeState mode;
  double elapsed_s = 0.0;  ///< Since the last cycle.

  [[nodiscard]] bool active() const { return mode.mode == EcuMode::kActive; }
};

/// The mode after the inputs and whatever stops beside them: `fault` counts after theirs.
[[nodiscard]] ModeDecision decide_mode(const CycleMemory& memory, const Cycle& cycle,
                                       const CommonValid& valid, Fault fault, bool centred,
                                       bool stop_requested);

/// A gate that had to refuse stops the machine.
void take_refusal(Fault refused, ModeDecision& decision);

/// Ends the cycle: pilot pressure, what the operator reads of mode and faults, and what is kept.
void end_cycle(const ModeDecision& decision, const CommonValid& valid, CycleMemory& memory,
               MachineOutputs& outputs, MachineStatus& status);

}  // namespace graben
