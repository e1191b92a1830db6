#pragma once
/// The last gate before the bus: what it lets through is finite, in range, rate-limited and
/// enabled, whatever computed it.

#include <array>

#include "firmware/core/guarded.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// What the gate needs of the last cycle.
struct GateState {
  std::array<Guarded<double>, kDriveCount> opening;  ///< x / x_m that was let through, -1 .. 1.
};

struct GateResult {
  bool enable = false;
  Fault fault = Fault::kNone;  ///< kCommandNotFinite or kMemoryCorrupt when it had to refuse.
  std::array<double, kDriveCount> duty_ratio{};  ///< -1 .. 1.
  GateState state;
};

/// Spool positions -> duties. Not active, or any position not finite, or a stored opening that
/// differs from its complement: neutral in this cycle, enable withdrawn. Otherwise x / x_m is
/// clamped to +-1, opens by at most spool_rate_ps (closing is never delayed), and is kept at
/// neutral below spool_threshold; the duty then follows spool_to_duty. `period_s` is the time since
/// the last cycle. A drive that the machine hasn't got stays at neutral.
[[nodiscard]] GateResult gate(const ExcavatorProfile& profile, const GateState& last, bool active,
                              const std::array<double, kDriveCount>& spool_m, double period_s);

}  // namespace graben
