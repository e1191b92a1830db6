// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bank of drives against its commands: all watches together, and what they take away.

#include <array>

#include "firmware/drives/blocked.hpp"
#include "firmware/drives/direction_watch.hpp"
#include "firmware/drives/flow_watch.hpp"
#include "firmware/drives/learnt/learnt_valve.hpp"
#include "firmware/drives/motion_watch.hpp"
#include "firmware/drives/rest_watch.hpp"
#include "firmware/drives/spool_watch.hpp"
#include "firmware/drives/way_watch.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// Commands of the last cycle.
template <int kMost>
struct LastCommands {
  bool moving = false;  ///< Armed or Active.
  bool enable = false;
  std::array<double, kMost> duty_ratio{};
  /// What the spools were opened for: lambda times the wanted velocity with its corrections. A
  /// stroke that stands still puts its drive behind, and that alone can run it to its end.
  std::array<double, kMost> asked_mps{};
  /// Openings (x / x_m) that the valve's model had for that, as far as the gate let them through.
  std::array<double, kMost> opening{};
  /// Where the drives are to go, before that is slowed or eased (blocked.hpp).
  std::array<double, kMost> towards_mps{};
  /// Pressure of the pump's line that the valve's model had last; 0: not known.
  std::array<double, kMost> line_pa{};
  /// What the valve was sent beyond `duty_ratio`, to lead its spools through their lag.
  std::array<double, kMost> lead_ratio{};
  bool tried = false;   ///< The duties were tried, on valves of which nothing is known.
  bool active = false;  ///< Something may have been asked of the drives; Armed nothing is.
};

/// The same of any bank.
struct DriveCommands {
  template <int kMost>
  // NOLINTNEXTLINE(google-explicit-constructor): a view of it.
  DriveCommands(const LastCommands<kMost>& last)
      : moving(last.moving),
        active(last.active),
        sent{last.enable, last.duty_ratio, last.lead_ratio, last.tried},
        ask{last.towards_mps, last.asked_mps, last.line_pa},
        opening(last.opening) {}

  bool moving;
  bool active;
  SentCommand sent;
  BlockedAsk ask;
  Span<const double> opening;
};

/// State of the watches of a bank from cycle to cycle; its valves are learnt, or none is.
template <int kMost, int kLearnt = kMost>
struct DriveWatchState {
  std::array<SpoolState, kMost> spool;
  std::array<BlockedState, kMost> blocked{};
  std::array<MotionState, kMost> motion{};
  std::array<RestState, kMost> rest{};
  std::array<WayState, kMost> way{};
  std::array<DirectionState, kMost> direction{};
  std::array<FlowState, kMost> flow{};
  std::array<LearntValve, kLearnt> learnt{};  ///< Kept when the machine stands.
  std::array<PressurePair, kMost> pressure{};
  int echo_cycles = 0;     ///< In a row, that the echo has differed.
  double pressed_s = 0.0;  ///< For which no motion is one in the air, since a load has pressed.
  double tried_s = 0.0;    ///< For which duties that were tried may still be under way.
  bool closing = false;    ///< It was in motion, and some spool has not been in its middle since.
};

/// The same of any bank.
struct DriveWatchView {
  template <int kMost, int kLearnt>
  // NOLINTNEXTLINE(google-explicit-constructor): a view of it.
  DriveWatchView(DriveWatchState<kMost, kLearnt>& state)
      : spool(state.spool),
        blocked(state.blocked),
        motion(state.motion),
        rest(state.rest),
        way(state.way),
        direction(state.direction),
        flow(state.flow),
        learnt(state.learnt),
        pressure(state.pressure),
        echo_cycles(state.echo_cycles),
        pressed_s(state.pressed_s),
        tried_s(state.tried_s),
        closing(state.closing) {}

  Span<SpoolState> spool;
  Span<BlockedState> blocked;
  Span<MotionState> motion;
  Span<RestState> rest;
  Span<WayState> way;
  Span<DirectionState> direction;
  Span<FlowState> flow;
  Span<LearntValve> learnt;
  Span<PressurePair> pressure;
  int& echo_cycles;
  double& pressed_s;
  double& tried_s;
  bool& closing;
};

/// Faults that stop: kSpoolStuck, kValveNotFollowing, kUncommandedMotion, kStrokeStuck. A wrong
/// pressure only degrades (kPressureImplausible), and its drive's load is not known then. The state
/// goes on by a cycle. A spool that is not measured counts as where it was sent.
///
/// While nothing is asked of the drives, in any mode, watch_rest() looks at them: one that moves is
/// kUncommandedMotion; in manual mode, and one that sinks, it is only said. In manual mode a spool
/// that is seen open was opened by the operator's levers, and is no motion that nobody asked for.
///
/// Outside motion the machine may be moved by hand in manual mode: spools, pressures and what
/// drives do with them are then not checked, and these watches begin newly. Only spools are, until
/// all have been in their middle once or the operator has taken over in manual mode: one that stays
/// open when the deadman is let go is stuck.
///
/// While duties are tried, and for 1 s after, what rests on the valve's model is not looked at:
/// only spools, for as long as the slowest takes, and pressures (commission_guard.hpp has the
/// rest).
[[nodiscard]] FaultSet watch_drives(DriveRows drives, const BusCapabilities& bus,
                                    const DriveCommands& last, Span<ValidDrive> seen,
                                    double period_s, DriveWatchView state, CommonValid& valid);

}  // namespace graben
