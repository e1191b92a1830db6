// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A joint with two sensors: both always compared. Neither is believed more than the other: which
/// of them is wrong nobody knows, and what they disagree on stops the machine. Out of motion that
/// is learnt which they are apart by as installed, so that in motion the band need not allow for
/// it.

#include "firmware/core/time.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// How far two sound sensors of a joint may differ, in the joint's unit.
struct WitnessBand {
  double offset = 0.0;       ///< Zeros of both as they are installed, anywhere in the travel.
  double play = 0.0;         ///< So far that may change: noise, play of pins.
  double scale = 0.0;        ///< So much more for each unit: of what is shown, and of a way.
  double least_age_s = 0.0;  ///< The second's reading is older than the first's by at least so much
  double most_age_s = 0.0;   ///< and at most so much as its frame comes.
  double fastest_ps = 0.0;   ///< Faster the joint does not go, whatever is shown.
};

/// Of a joint from cycle to cycle.
struct WitnessState {
  double first = 0.0;       ///< What the first sensor showed as the second's last frame came.
  bool begun = false;       ///< There was one.
  TimeUs stamp_us = 0;      ///< Of that frame.
  bool known = false;       ///< Of the next two.
  double difference = 0.0;  ///< Of second and first as they are installed,
  double at = 0.0;          ///< learnt where the first showed this.
  int apart = 0;            ///< Frames in a row that were farther apart than the band.
};

/// True while the two contradict each other. Each frame of the second is compared as it comes with
/// what the first shows now, `first`, taken back by the frames' age at the speed since the frame
/// before; that speed times what the age may be off widens every band. They may differ by `offset`
/// anywhere, and that difference may change by `play` from what it was before motion: `learns` says
/// that the machine is not in motion. The first frame after a beginning is not compared; one that
/// comes in motion begins with what it shows. A frame that is not newer changes nothing.
[[nodiscard]] bool contradicts(const WitnessBand& band, double first, const Signal<double>& second,
                               bool learns, TimeUs now_us, WitnessState& state);

}  // namespace graben
