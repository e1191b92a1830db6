// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sixth stage of a dozer's cycle: what the operator and the next cycle are told of it.

#include "firmware/dozer/outputs/outputs.hpp"

namespace graben {

/// The edge at the profile's mark: looked at where the operator says so, and told.
void check_mark(const DozerModel& machine, const DozerValid& valid, const DozerEstimates& estimates,
                const Signal<TouchWord>& touch, TimeUs now_us, double elapsed_s, MarkState& state,
                DozerStatus& status);

/// What is told of a motion that is followed.
void tell_motion(const DozerModel& machine, const PassState& pass, const BladeMotion& motion,
                 const Travel& travel, const CommonValid& valid, DozerStatus& status);

/// The same while drives are tried: what holds one back.
void tell_tried(const TriedCommand& tried, const CommonValid& valid, DozerStatus& status);

/// What the next cycle has to know of this one.
void remember(const DozerModel& machine, const DozerValid& valid, const DozerEstimates& estimates,
              const BladeMotion& motion, const Travel& travel, const TriedCommand& tried,
              const ModeDecision& decision, const DozerOutputs& outputs, double period_s,
              DozerLastCycle& last);

}  // namespace graben
