#pragma once
/// graben-ecu from its start to its end: what is needed for real time, the cycle, the way out.

#include "app/ecu/ecu_options.hpp"
#include "firmware/core/time.hpp"

namespace graben::ecu {

/// Runs until SIGTERM or SIGINT; returns the exit status. Everything that keeps it from starting
/// is told on standard error, before a single frame was sent: status 2 if it is the profile, which
/// no second try mends; 1 if it is something that may come, such as the interface. `began_us` is
/// when the process began, on the monotonic clock.
///
/// Told to end, it sends neutral for 5 cycles, so that no valve has to wait for its own timeout.
int run(const EcuOptions& options, TimeUs began_us);

}  // namespace graben::ecu
