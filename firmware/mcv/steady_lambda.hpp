#pragma once
/// lambda from cycle to cycle: falls as the machine needs, rises slowly and only with force to
/// spare.

#include "firmware/drives/drive_servo.hpp"
#include "firmware/mcv/optimiser.hpp"

namespace graben {

/// Of a bank of drives: V_L^d, chamber pressures, and the pumps' flow at zero pressure.
[[nodiscard]] McvInput mcv_input(Span<const double> velocity_mps, Span<const LoadState> load,
                                 Span<const double> pump_flow_m3ps);

/// This cycle's solution after one that ended at `last_lambda` (0 from rest), `period_s` ago.
///
/// It rises to what is feasible with the reserve, no further than the rate allows; otherwise it
/// stays where it was, or falls to the next value below at which the share of the reserve that
/// holding asks for is there. That share is for the model: where hardly any force is left over, c_L
/// of (9) hangs on the last newtons, and a pressure read a little wrong is a speed much wrong. The
/// rest is for peace: the search goes down from the bound that the rate sets, so lambda climbs
/// through feasible values and never jumps up over a gap of the feasible set wider than one cycle's
/// rise. To come back above a gap that it fell across, it needs the gap gone for all of the climb,
/// with the rest of the reserve on top; pressure noise worth less than that can then neither open
/// the gap under it nor close it again. The price: below a stretch of lambda that is feasible, but
/// not with the reserve, it stays too. Where it stays, `limit` is what lacks
/// the reserve. A rise or a period that is no number, a reserve below 0, or a share outside 0 .. 1
/// is kBadInput.
[[nodiscard]] McvSolution steady_lambda(const McvMachine& machine, const McvInput& input,
                                        McvPolicy policy, const LambdaRise& rise,
                                        double last_lambda, double period_s);

}  // namespace graben
