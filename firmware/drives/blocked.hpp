#pragma once
/// A drive that pushes with what its pump gives, and stands: its load holds it, a rock. Not a
/// fault: what the feedback asks for is kept small until the load gives way.

#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct BlockedState {
  int way = 0;             ///< Where its open spool is to drive it; 0: nowhere.
  double inlet_pa = 0.0;   ///< Low-passed, of the side that is fed.
  double asked_mps = 0.0;  ///< That way, low-passed.
  double speed_mps = 0.0;
  double stroke_m = 0.0;
  /// The fed side has most of the line's pressure, as it has where hardly any oil flows. Whether
  /// its stroke moves or not, it may be blocked.
  bool strains = false;
  double since_s = 0.0;  ///< That it has strained and stood.
  int side = 0;          ///< To which it is blocked; 0: it is not.
  int eased_side = 0;    ///< To which it is, or was last.
  double eased = 0.0;    ///< 0 .. 1: how much of what feedback adds to that side is left away.
};

/// What was asked of the drives in the last cycle, and with what pressure their pumps' lines.
struct BlockedAsk {
  Span<const double> asked_mps;
  Span<const double> line_pa;  ///< As the valve's model has it; 0: not known.
};

/// The states go on by a cycle. Blocked to the side that it is asked to: for 0.1 s the side that is
/// fed has at least seven tenths of its line's pressure and the drive moves at less than a fifth of
/// what is asked. No longer: half of that speed, six tenths of that pressure, or it is asked to the
/// other side. A drive whose pressures are not known is never blocked.
void next_blocked(DriveRows drives, Span<const ValidDrive> seen, const BlockedAsk& ask,
                  double period_s, Span<BlockedState> state);

/// The speed to ask for: where the load holds the drive no more than is wanted without feedback.
/// Eased in within 0.3 s, and out again after it.
[[nodiscard]] double eased_mps(const BlockedState& state, double wanted_mps, double corrected_mps);

[[nodiscard]] bool any_blocked(Span<const BlockedState> state);

/// The first drive that is blocked as what holds the machine back, kBackFlow; kNone if none is.
[[nodiscard]] Limit blocked_limit(Span<const BlockedState> state);

}  // namespace graben
