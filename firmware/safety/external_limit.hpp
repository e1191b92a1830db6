// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Somebody outside, a people detector or the site, slows or stops the machine: a cap on the
/// operator's speed. It never makes anything faster.

#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// State from cycle to cycle.
struct ExternalState {
  bool known = false;       ///< A word was heard since the start: from then on one has to be there.
  std::uint8_t source = 0;  ///< Who gave the last word.
  double speed_ratio = 1.0;  ///< Followed in the last cycle.
};

/// Caps `inputs.speed_override_ratio` at what the source's word leaves and names it in
/// `inputs.external`. The cap falls at once and rises at kExternalRise_ps.
///
/// A stop that ends by itself is a cap of 0 while the machine is `moving`. Any other, and each
/// while it is not, is kExternalStop: the operator has to arm again. A source that was there and is
/// silent for longer than its deadline, says 'error' or 'not available', or a share that is no
/// number is kExternalSilent.
void tell_external(const Signal<ExternalWord>& word, bool moving, TimeUs now_us, double period_s,
                   ExternalState& state, CommonValid& inputs);

}  // namespace graben
