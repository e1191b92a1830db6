// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a log says of the platform beside its valve: how heavy it is to turn, what rubs, how far it
/// goes on after its command is neutral, and what brakes it.

#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// Of all logs of this machine. By the motor's two pressures, its displacement as the profile says
/// and the platform's acceleration while the links rest: D (p_left - p_right) = I a + C sign(w) +
/// e, with e what the pressures' zeros and a slope push. The links' part of I at the log's poses is
/// taken for that of the profile's masses ([oil]) and brought to links half out, which is what
/// `swing.inertia` means; not known without [oil], or where too little was driven.
[[nodiscard]] SwingFigures find_swing(const ExcavatorProfile& profile,
                                      const std::vector<MachineLog>& logs);

/// The links about the swing axis, kg m2, at these strokes, by the profile's masses.
[[nodiscard]] double links_about_swing_kgm2(const ExcavatorProfile& profile,
                                            const Eigen::Vector3d& strokes_m);

/// "swing, left: goes on by 4.2 deg in 0.5 s from 0.52 rad/s once its command is neutral, braked by
/// up to 21 MPa" and its like, a sentence each.
[[nodiscard]] std::vector<std::string> swing_sentences(const SwingFigures& swing);

}  // namespace graben::identify
