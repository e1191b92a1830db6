// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive that pushes with what its pump gives, and stands: its load holds it, a rock. Not a
/// fault: what is asked of it is kept small, and its pressure eased, until the load gives way.

#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// What an eased drive does: nothing yet, lets its pressure off, rests on what is left.
enum class Easing : std::uint8_t { kPushes, kLetsOff, kRests };

/// State of one drive from cycle to cycle.
struct BlockedState {
  int way = 0;              ///< Where it is to go; 0: nowhere.
  double inlet_pa = 0.0;    ///< Low-passed, of the side that is fed.
  double asked_mps = 0.0;   ///< That way, low-passed.
  double speed_mps = 0.0;   ///< The same of what it does.
  double stroke_m = 0.0;    ///< Measured.
  double held_at_m = 0.0;   ///< Stroke at which it was blocked.
  double rests_at_m = 0.0;  ///< Stroke at which it began to rest.
  double stood_s = 0.0;     ///< That it has strained and stood.
  double for_s = 0.0;       ///< That it has pushed, let off or rested.
  double less = 0.0;        ///< 0 .. 1: share of the feedback that is left away.
  int side = 0;             ///< To which it is blocked; 0: it is not.
  int last_side = 0;        ///< To which it is, or was last.
  double wary_s = 0.0;      ///< That its load may yet give way.
  /// The fed side has most of what its pump can give, as it has where hardly any oil flows.
  bool strains = false;
  Easing easing = Easing::kPushes;
};

/// Of the last cycle, one a drive.
struct BlockedAsk {
  Span<const double> towards_mps;  ///< With feedback; before it was eased, and before lambda.
  Span<const double> asked_mps;    ///< What was asked of the spools.
  Span<const double> line_pa;      ///< Pump's line, as the valve's model had it; 0: not known.
};

/// The states go on by a cycle. Blocked: for 0.2 s the side that is fed has at least 0.8 of its
/// line's pressure and 0.7 of the relief's, and the drive moves at less than a fifth of what is
/// asked. No longer: half of that speed, less than 0.7 of these, or it is to go to the other side.
/// A drive whose pressures or whose relief are not known is never blocked.
///
/// Oil at a pump's relief is a spring that throws the tool when its load gives way. Blocked for a
/// tenth of a second at 0.85 of the relief's pressure and more, a drive lets off to 0.75 of it,
/// rests for 3 s, and pushes again. While it does so it is no longer blocked only when it has gone
/// 5 mm beyond where it was held, or where it began to rest.
void next_blocked(DriveRows drives, Span<const ValidDrive> seen, const BlockedAsk& ask,
                  double period_s, Span<BlockedState> state);

/// The speed to ask for instead of the corrected one: to the side where the load holds the drive no
/// more than is wanted without feedback, eased in within 0.3 s and out again after it; backwards
/// slowly while it lets off; nothing while it rests.
[[nodiscard]] double eased_mps(const BlockedState& state, double wanted_mps, double corrected_mps);

/// Some drive lets its pressure off or rests: all others are to go no further.
[[nodiscard]] bool any_eases(Span<const BlockedState> state);

/// Time for which all drives that ease have rested; 0 while one lets its pressure off, or none
/// eases.
[[nodiscard]] double rested_s(Span<const BlockedState> state);

/// Some drive had to let its pressure off within the last 6 s and has not come 20 mm past the
/// place: slower, so that the load's giving way throws little.
[[nodiscard]] bool any_wary(Span<const BlockedState> state);

[[nodiscard]] bool any_blocked(Span<const BlockedState> state);

/// The first drive that is blocked as what holds the machine back, kBackFlow; kNone if none is.
[[nodiscard]] Limit blocked_limit(Span<const BlockedState> state);

}  // namespace graben
