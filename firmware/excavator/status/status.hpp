// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sixth stage of a cycle: what the operator and the next cycle are told of it.

#include "firmware/excavator/outputs/outputs.hpp"

namespace graben {

/// What is told in every mode.
void tell_seen(const ExcavatorModel& machine, const InputState& inputs,
               const EstimationState& estimates, ExcavatorStatus& status);

/// The teeth at the profile's mark or at a point of the site: looked at where the operator says so,
/// and told. `turning_radps`: of the platform, by its gyro, where it swings and has one.
void check_touches(const ExcavatorModel& machine, const TaskBook& book, const ExcavatorValid& valid,
                   const KinematicState& pose, const Signal<TouchWord>& touch, double turning_radps,
                   TimeUs now_us, double elapsed_s, LastCycle& last, ExcavatorStatus& status);

/// Warns of kFrameUnknown where the chosen task has a design that is not known to lie anywhere. A
/// program with a design was planned where the task file has it: elsewhere it must not run.
void tell_site(const TaskBook& book, const SiteState& site, ExcavatorValid& valid);

/// What is told of a motion that is followed.
void tell_motion(const ExcavatorModel& machine, const InputState& inputs, const Motion& motion,
                 const Followed& followed, const CommonValid& valid, ExcavatorStatus& status);

/// What the next cycle has to know of this one.
void remember(const ExcavatorModel& machine, const ExcavatorValid& valid, const InputState& inputs,
              const Motion& motion, const Followed& followed, const ModeDecision& decision,
              const OutputState& output, const SentDuties& sent, bool enable, double period_s,
              LastCycle& last);

}  // namespace graben
