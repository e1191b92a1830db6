// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Zeros of sensors from touches of the stroke's ends: a piston that is pressed against its end
/// stands at a length that the drawing says, and its draining side, where nothing flows, has the
/// tank's pressure.

#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "app/identify/machine/steady_points.hpp"

namespace graben::identify {

/// Zeros of each axis whose end was touched, into `machine`: the stroke's by the extended end, or
/// by the other where only that was touched; the pressures' by the draining side. A sensor that
/// reads nothing there is at or below zero, by no one knows how much. `points`: a valve that is not
/// open as far as it was where its drive moved, presses nothing.
void find_zeros(const std::vector<MachineLog>& logs, const DriveModel& model,
                const std::vector<SteadyPoint>& points, MachineEstimate& machine);

}  // namespace graben::identify
