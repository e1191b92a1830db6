// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/external_limit.hpp"

#include <algorithm>

#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

/// Share of full speed that the word leaves; a share that is no number leaves none.
double left_by(const ExternalWord& word) {
  if (word.level == ExternalLevel::kFree) {
    return 1.0;
  }
  const bool slows = word.level == ExternalLevel::kSlow && word.speed_ratio > 0.0;
  return slows ? std::min(word.speed_ratio, 1.0) : 0.0;
}

/// kNone: it slows at most.
Fault fault_of(const Signal<ExternalWord>& word, bool moving, TimeUs now_us) {
  const ExternalWord& said = word.value;
  const double deadline_s =
      said.deadline_s <= kExternalMostDeadline_s ? said.deadline_s : kExternalMostDeadline_s;
  if (!Freshness(deadline_s, now_us).holds(word) || !std::isfinite(said.speed_ratio)) {
    return Fault::kExternalSilent;
  }
  const bool stops = said.level != ExternalLevel::kFree && said.level != ExternalLevel::kSlow;
  return stops && !(moving && said.resumes) ? Fault::kExternalStop : Fault::kNone;
}

}  // namespace

void tell_external(const Signal<ExternalWord>& word, bool moving, TimeUs now_us, double period_s,
                   ExternalState& state, CommonValid& inputs) {
  state.known = state.known || word.validity > Validity::kNotAvailable;
  if (!state.known) {
    return;
  }
  if (word.validity == Validity::kValid) {
    state.source = word.value.source;
  }
  const Fault fault = fault_of(word, moving, now_us);
  FaultSet stops;
  stops.add(fault);
  stop(stops, inputs);
  const double left = fault == Fault::kNone ? left_by(word.value) : 0.0;
  const double risen = state.speed_ratio + kExternalRise_ps * period_s;
  state.speed_ratio = moving ? std::min(left, risen) : left;
  inputs.external = {state.speed_ratio, state.speed_ratio < inputs.speed_override_ratio,
                     state.source};
  if (inputs.external.holds) {
    inputs.speed_override_ratio = state.speed_ratio;
  }
}

}  // namespace graben
