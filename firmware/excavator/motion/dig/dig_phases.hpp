// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The phases of a dig in layers. Each is entered for a step of the program (`state.step` is still
/// the step before), goes on by a cycle until it is through, and leaves to the one that comes next.
///
/// | phase    | entered            | through                          | leaves to           |
/// |----------|--------------------|----------------------------------|---------------------|
/// | kNone    | a step of drives   | the teeth have come near its end | the next step       |
/// | kTares   | the first return   | each of its two moves has ended  | that return         |
/// | kTouches | before any cut     | the ground bore it, and it is up | the move before cut |
/// | kEnters  | the layered step   | down, or can't be pressed down   | kCuts               |
/// | kCuts    | from kEnters       | full, at the end, or held        | kLifts              |
/// | kLifts   | from kCuts         | folded in; out of the ground     | kLifts; next step   |

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

struct MovePhase {
  static constexpr CutPhase kPhase = CutPhase::kNone;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

struct TarePhase {
  static constexpr CutPhase kPhase = CutPhase::kTares;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

/// Finds the ground: the bucket's floor is set down on it, flat, and what the sensors then say of
/// its height is where heights are counted from. Zeros of stroke sensors put the edge centimetres
/// off in the same way all over a task's small area; so they drop out. `dug.zero_m` is 0 where
/// there was no ground within 50 mm of where the task has it.
struct TouchPhase {
  static constexpr CutPhase kPhase = CutPhase::kTouches;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

/// How the edge comes down to a cut: quickly through the air, into the ground as hard as it may,
/// and then its oil lets off: pressed oil would throw it down as soon as it goes along and the
/// ground bears it no more. Ends where it is down, or can't be pressed down further: the rest it
/// comes down on the way.
struct EnterPhase {
  static constexpr CutPhase kPhase = CutPhase::kEnters;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

/// Along the layer, giving way upwards where it gets too heavy.
struct CutsPhase {
  static constexpr CutPhase kPhase = CutPhase::kCuts;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

/// Folds the bucket in, and lifts it out.
struct LiftPhase {
  static constexpr CutPhase kPhase = CutPhase::kLifts;
  static void enter(const DigCycle& cycle, int step, TaskState& state);
  [[nodiscard]] static bool go_on(const DigCycle& cycle, TaskState& state);
  static void leave(const DigCycle& cycle, TaskState& state);
};

/// Enters a phase; the step's time begins. The phase is of the code and not of a table: what it
/// costs at most is then that of this phase, not of the dearest (tests/bound).
template <class Phase>
void enter_phase(const DigCycle& cycle, int step, TaskState& state) {
  Phase::enter(cycle, step, state);
  state.dig.phase = Phase::kPhase;
  state.time_s = 0.0;
  state.settle_s = 0.0;
}

/// Enters a step of the program by the phase that it begins with.
void enter_step(const DigCycle& cycle, int step, TaskState& state);

/// The phase that a dig begins with: the ground is felt for once.
[[nodiscard]] CutPhase first_phase(const TaskProgram& program, const TaskState& state);

/// Where the drives are planned to be now.
[[nodiscard]] DriveVector drives_now(const DigCycle& cycle, const TaskState& state);

}  // namespace graben
