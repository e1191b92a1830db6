// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Second stage of a dozer's cycle: where the machine is and what the blade has cut, what its pump
/// gives, its load, how the body would fall, and how far a pass has come.

#include "firmware/dozer/blade_control.hpp"
#include "firmware/dozer/flow_share.hpp"
#include "firmware/dozer/inputs/inputs.hpp"
#include "firmware/dozer/tilt_control.hpp"
#include "firmware/dozer/travel/blade_load.hpp"
#include "firmware/dozer/travel/fall.hpp"
#include "firmware/dozer/travel/passes.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "firmware/drives/drive_servo.hpp"

namespace graben {

/// State from cycle to cycle.
struct DozerEstimates {
  /// As before the first cycle, with the whole design to be cut.
  DozerEstimates(const GradeProfile& whole, const GradeDesign& grade);

  std::array<ServoState, kBladeCount> servo;  ///< What is under way to lift and tilt.
  PositionState position;
  PushState load;
  Foretelling foretelling;
  FlowShareState flow;
  FallState fall;
  PassState pass;
  PassSituation in_pass;
  GroundMap ground;
  GradeProfile design;  ///< Of this pass.
};

/// A cycle on. `preview` looks ahead over the ground, and is left as it is while the pose or a
/// stroke is missing, as all of it but what is under way to the blade.
void estimate(const DozerModel& machine, const DozerValid& valid, const Cycle& cycle,
              const DozerLastCycle& last, DozerEstimates& state, Preview& preview);

/// Out of motion load, fall and pass begin anew; a fall counts in a cut alone.
void estimates_after(const GradeDesign& grade, bool active, DozerEstimates& state);

}  // namespace graben
