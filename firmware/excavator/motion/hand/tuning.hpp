// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about motion by the operator's levers: each was chosen.

namespace graben {

/// Acceleration of teeth that the operator steers, in accelerations of a line. [-; chosen: not
/// tried]
inline constexpr double kHandBrisk = 4.0;
/// Time from rest until the attitude turns at its fastest. [s; chosen: not tried]
inline constexpr double kHandAttitudeRise_s = 0.6;
/// Time ahead at which there has to be a pose: else the teeth stop. [s; chosen: not tried]
inline constexpr double kHandAhead_s = 0.05;
/// Distance from a cylinder's end at which a line ends. [m; chosen: nearer, cushions bend it; not
/// tried]
inline constexpr double kLineEnds_m = 0.05;

}  // namespace graben
