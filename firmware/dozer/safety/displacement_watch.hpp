// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that a displacement, of a pump or a motor, follows its command.

#include "firmware/dozer/safety/tuning.hpp"
#include "firmware/drives/spool_watch.hpp"

namespace graben {

struct DisplacementLimits {
  double tolerance = 0.0;  ///< Of full displacement.
  double settle_s = 0.0;   ///< Within which it reaches its command.
};

/// Of a displacement that is judged.
struct DisplacementCourse {
  bool judged = false;
  double nearest = 0.0;  ///< To the commands of late, since it was last within them.
  int off_side = 0;      ///< On which side of its command it is off; 0: it isn't.
  double off_s = 0.0;    ///< How long it has been so.
  int runaway_cycles = 0;
};

/// State of the watch from cycle to cycle.
struct DisplacementState {
  /// As if it had been told `neutral` all the time.
  explicit DisplacementState(double neutral);

  CommandHistory sent;
  DisplacementCourse course;
};

/// Task of a displacement: nothing; to follow its command; or, after motion, to have come to
/// neutral.
enum class DisplacementTask { kNone, kFollow, kReturn };

struct DisplacementResult {
  bool disagrees = false;
  bool runs_away = false;
};

/// `state` goes on by a cycle. Disagrees: off its command, on the same side, by more than the
/// tolerance for longer than the time to settle.
///
/// Runs away: for kRunawayCycles it is further than the tolerance from all that it was told within
/// the time to settle, and either has moved away from that by as much, or stands on the other side
/// of 0 than its command. One that has to return has run away without having moved, too: what stays
/// where it was then drives the machine. `sent` is the last cycle's command, `measured` what has
/// come in since.
[[nodiscard]] DisplacementResult watch_displacement(const DisplacementLimits& limits,
                                                    DisplacementState& state, double sent,
                                                    DisplacementTask task, double measured,
                                                    double period_s);

}  // namespace graben
