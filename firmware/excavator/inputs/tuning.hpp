// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the excavator's inputs: each was chosen.

namespace graben {

// IMUs on the links (imu_joints.cpp)

/// Time without an open spool after which the machine counts as at rest, and the gyros' biases are
/// learnt. [s; chosen: by then the links have swung out on their oil; not tried]
inline constexpr double kImuRest_s = 1.0;
/// Time between two readings beyond which the angle begins again: nothing says what was between
/// them. [s; chosen: not tried]
inline constexpr double kImuGapMost_s = 0.1;
/// Bias of a gyro that is an error, in its standard deviations: gyro or accelerometer has failed.
/// [-; chosen: not tried]
inline constexpr double kImuBiasMost = 5.0;
/// Turn by the gyro after which an unchanged force is a frozen accelerometer. [rad; chosen: 20
/// counts of the force, of which a falling link may hide some ten; 0.01 and 0.03 were tried]
inline constexpr double kImuFrozenTurn_rad = 0.02;
/// Readings with the same force in a row that may be a frozen accelerometer. [-; chosen: a link
/// that shakes may show the same force twice; not tried]
inline constexpr int kImuSameForces = 4;
/// Readings with the same rates that are a frozen gyro, where the force has changed each time.
/// [-; chosen: no gyro that lives does so; not tried]
inline constexpr int kImuSameRates = 20;
/// Standard deviation of a link's angle, beside its constant error, up to which its stroke is
/// available. [rad; chosen: 0.4 deg; not tried]
inline constexpr double kLinkKnown_rad = 0.007;

// Joint angles of another bus (measured_joints.cpp)

/// Way by which a joint may show its cylinder beyond its end: rounding of the bus, zero and bias.
/// [m; chosen: not tried]
inline constexpr double kBeyondEnd_m = 0.01;

}  // namespace graben
