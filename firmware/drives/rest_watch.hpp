// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Watch over drives that nobody asks to move: after a stop, at rest, and in the operator's hands.

#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct RestState {
  double anchor_m = 0.0;   ///< Where it stood, or stopped.
  double coast_m = 0.0;    ///< Way that its last command explains; 0 once it has settled.
  double stopped_s = 0.0;  ///< Since it was last asked to move.
  double off_s = 0.0;      ///< For so long it has been away from its anchor.
  double calm_m = 0.0;     ///< Stroke, low-passed.
  double still_m = 0.0;    ///< That at its last change.
  double still_s = 0.0;    ///< Since then.
  double sunk_m = 0.0;     ///< Way that it has sunk since it came to rest.
  bool anchored = false;
  bool asked = false;    ///< Whether and how fast it was asked is known.
  bool by_hand = false;  ///< The operator had it in the last cycle.
  bool moves = false;    ///< It has been seen to move, and has not come to rest since.
};

/// What a drive that nobody asks may do.
struct RestBounds {
  double rest_m = 0.0;       ///< Way that it may go.
  double rest_s = 0.0;       ///< Until it has come to rest after its last command.
  double coast_s = 0.0;      ///< Its way until then, over the speed that it was asked for ...
  double fastest_mps = 0.0;  ///< ... and this where that is not known.
  double sink_mps = 0.0;     ///< No faster it sinks, with its spool in its middle.
};
[[nodiscard]] RestBounds rest_bounds(const DriveRow& drive);

/// What is known of a drive in a cycle.
struct RestSeen {
  double stroke_m = 0.0;
  bool centred = false;  ///< Its spool is measured, and in its middle.
  bool by_hand = false;  ///< The operator has the machine, in manual mode.
  bool known = true;     ///< Its stroke is.
};

enum class RestVerdict : std::uint8_t {
  kRests,
  kSinks,  ///< With its spool in its middle, no faster than `sink_mps`, by `rest_m`.
  kMoves,  ///< By more than `rest_m` beyond what settling explains, and for longer than 0.3 s.
};

/// The drive was asked to move in the last cycle, as fast as `asked_mps`; not finite counts as 0.
void ask_of(const RestBounds& bounds, double asked_mps, RestState& state);

/// A cycle on without being asked. What settling explains: the way of the last command during dead
/// time and lags, of a platform that brakes too; that of its fastest where nobody knows what it was
/// asked for, at the start and when the operator gives it back. A place is taken for a new rest
/// only after the drive has stood still for 1 s, and only where it was seen to move or is in the
/// operator's hands. So a drive that creeps is seen however slow it is; only once seen, and slower
/// than 3 mm/s, it counts as standing until it has gone `rest_m` anew. A cycle in which the stroke
/// is not known changes nothing.
[[nodiscard]] RestVerdict watch_rest(const RestBounds& bounds, const RestSeen& seen,
                                     double elapsed_s, RestState& state);

}  // namespace graben
