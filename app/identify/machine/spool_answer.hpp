// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Dead time and lags between a duty and its measured spool.
///
/// duty -> dead time (its side's) -> pilot, first order -> spool, two equal lags -> travel. The
/// dead time is looked for from several starts; the lags come with it. Robust, since a spool that
/// sticks once must not make the machine slow.

#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

/// Of one axis; nothing is `known` where its spool is not measured or was hardly moved. What is not
/// keeps the value that it comes with.
void find_spool_answer(const std::vector<MachineLog>& logs, int axis, DriveEstimate& drive);

}  // namespace graben::identify
