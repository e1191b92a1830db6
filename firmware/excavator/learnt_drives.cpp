// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/learnt_drives.hpp"

#include <cmath>

#include "firmware/drives/learnt/tuning.hpp"

namespace graben {
namespace {

void begin_side(double edge, LearntSide& side) {
  side = LearntSide();
  side.edge = edge;
}

}  // namespace

bool is_sound(const LearntDrives& learnt) {
  for (const LearntDeadBand& edge : learnt) {
    // What is no number is within no bound.
    if (!(std::abs(edge.extend) <= kLearntEdgeMost && std::abs(edge.retract) <= kLearntEdgeMost)) {
      return false;
    }
  }
  return true;
}

LearntDrives learnt_of(const DriveWatchState<kDriveCount>& state) {
  LearntDrives learnt;
  for (std::size_t i = 0; i < learnt.size(); ++i) {
    learnt[i] = {state.learnt[i].extend.edge, state.learnt[i].retract.edge};
  }
  return learnt;
}

void begin_learnt(const LearntDrives& learnt, DriveWatchState<kDriveCount>& state) {
  for (std::size_t i = 0; i < learnt.size(); ++i) {
    begin_side(learnt[i].extend, state.learnt[i].extend);
    begin_side(learnt[i].retract, state.learnt[i].retract);
  }
}

}  // namespace graben
