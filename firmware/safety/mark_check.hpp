// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tool at a known mark: the operator sets it there by hand and says so; where it is shown is
/// compared with where the mark is. What no watch sees, a sensor that has slipped or drifts slowly,
/// shows here.

#include <Eigen/Core>

#include "firmware/machine/mark.hpp"
#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// What the check has to know of a cycle.
struct MarkSeen {
  bool touched = false;     ///< The operator says that the tool is at the mark; so often it is
  std::uint8_t number = 0;  ///< said, and each touch has a number of its own.
  bool by_hand = false;     ///< He has the machine.
  bool at_rest = false;     ///< Nothing drives it, as far as is known.
  bool known = false;       ///< Where the tool is.
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();  ///< Shown tool less mark: see MarkTold.
  TouchKind kind = TouchKind::kMark;                ///< What else it is at.
};

/// State from cycle to cycle. Nothing of it outlives a restart: after one no check was made.
struct MarkState {
  bool heard = false;  ///< The touch of the last cycle, and its number.
  std::uint8_t number = 0;
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();  ///< Where the tool came to rest,
  double rest_s = 0.0;                               ///< and for how long it has been there.
  MarkTold told;
};

/// A fresh touch, or none.
void read_touch(const Signal<TouchWord>& touch, TimeUs now_us, MarkSeen& seen);

/// The tool's place can be relied on: no fault but the mark's own.
[[nodiscard]] bool is_place_known(const FaultSet& faults);

/// Adds kMarkMissed, which lets nothing arm, where the last check was out of its tolerance; warns
/// of kMarkDue where it is too old or was never made, which, `required`, lets nothing arm either. A
/// machine that is `moving` goes on: the next start needs the check.
void tell_mark(const MarkProfile& mark, const MarkState& state, bool moving, CommonValid& inputs);

/// A cycle on. A touch counts once. It is refused, and `told.touch` says why, where the operator
/// does not have the machine, where the tool has not been still for kMarkRest_s, or where its place
/// is not known: then the last check stays what it was. True for one that is taken and of no mark:
/// `told.touch` says kNoPoint of it, for whoever does not know better. That the tracks have moved
/// is taken whatever else is.
bool next_mark(const MarkProfile& mark, const MarkSeen& seen, double elapsed_s, MarkState& state);

}  // namespace graben
