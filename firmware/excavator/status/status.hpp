// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sixth stage of a cycle: what the operator and the next cycle are told of it.

#include "firmware/excavator/outputs/outputs.hpp"

namespace graben {

/// What is told in every mode.
void tell_seen(const ExcavatorModel& machine, const InputState& inputs,
               const EstimationState& estimates, ExcavatorStatus& status);

/// The teeth at the profile's mark: looked at where the operator says so, and told.
void check_mark(const ExcavatorModel& machine, const ExcavatorValid& valid,
                const KinematicState& pose, const Signal<std::uint8_t>& touch, TimeUs now_us,
                double elapsed_s, MarkState& state, ExcavatorStatus& status);

/// What is told of a motion that is followed.
void tell_motion(const ExcavatorModel& machine, const InputState& inputs, const Motion& motion,
                 const Followed& followed, const CommonValid& valid, ExcavatorStatus& status);

/// What the next cycle has to know of this one.
void remember(const ExcavatorModel& machine, const ExcavatorValid& valid, const InputState& inputs,
              const Motion& motion, const Followed& followed, const ModeDecision& decision,
              const OutputState& output, const SentDuties& sent, bool enable, double period_s,
              LastCycle& last);

}  // namespace graben
