#pragma once
/// lambda from cycle to cycle: falls as the machine needs, rises slowly and only with force to
/// spare.

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/mcv/optimiser.hpp"

namespace graben {

/// This cycle's solution after one that ended at `last_lambda` (0 from rest), `period_s` ago.
///
/// It rises to what is feasible with the reserve, no further than the rate allows; otherwise it
/// stays where it was, or falls to the next feasible value below. The search goes down from the
/// bound that the rate sets, so lambda climbs through feasible values and never jumps up over a gap
/// of the feasible set wider than one cycle's rise. Why that cannot chatter: to come back above a
/// gap that it fell across, it needs the gap gone for all of the climb, with the reserve on top;
/// pressure noise worth less than the reserve can then neither open the gap under it nor close it
/// again. The price: below a stretch of lambda that is feasible, but not with the reserve, it stays
/// too. At most two solves. Where it stays, `limit` is what lacks the reserve. A rise or a period
/// that is no number, or a reserve below 0, is kBadInput.
[[nodiscard]] McvSolution steady_lambda(const McvMachine& machine, const McvInput& input,
                                        McvPolicy policy, const LambdaRise& rise,
                                        double last_lambda, double period_s);

}  // namespace graben
