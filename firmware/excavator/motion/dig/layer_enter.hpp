// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How the edge comes down to a cut: quickly through the air, into the ground as hard as it may,
/// and then its oil lets off: pressed oil would throw it down as soon as it goes along and the
/// ground bears it no more.

#include "firmware/excavator/motion/dig/layer_height.hpp"

namespace graben {

/// A cycle on. Begins the cut where it is down, or can't be pressed down further: the rest it comes
/// down on the way.
void enter_on(const LayerCycle& cycle, const CutSeen& seen, TaskState& state);

}  // namespace graben
