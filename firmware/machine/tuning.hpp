// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of this room: each value with its unit, why it is so, and what else was tried.

namespace graben {

// Valves (valve.hpp, drive_bank.hpp)

/// Largest rise of a duty on the wire where the profile says none, of its whole range. [1/s;
/// chosen: half of it in a cycle; not tried]
inline constexpr double kDutyRate_ps = 50.0;
/// Share of a spool's `settle_s` by which its start may be late; two lags share the rest. [-;
/// chosen: one time after which a spool is there, tried before, stopped sound ones with SpoolStuck]
inline constexpr double kLateShare = 0.3;
/// Factor within which a valve's times are known. [-; chosen: 30 %; not tried]
inline constexpr double kTimeBand = 1.3;

// Cylinders (drive_bank.hpp)

/// Time after which a cylinder's oil has rung down once its spool has closed. [s; chosen: not
/// tried]
inline constexpr double kCylinderRest_s = 0.5;
/// Way of a drive that nobody asks to move from which it is seen to. [m; chosen: more than oil
/// gives way under a load; not tried]
inline constexpr double kRestMoved_m = 0.05;
/// Distance outside its cylinder's range at which a stroke may be measured. [m; chosen: a zero that
/// nobody has found yet, and what an end gives way to a piston; 0.010 tried before]
inline constexpr double kStrokeMargin_m = 0.015;
/// Change of a stroke at once, beyond what the cylinder can. [m; chosen: noise, and frames that
/// were lost; not tried]
inline constexpr double kJumpMargin_m = 0.020;
/// Factor on the pumps' flow up to which a cylinder's speed is possible. [-; chosen: its own oil
/// that feeds its other side, or its load, never makes it twice as fast; not tried]
inline constexpr double kFasterThanPumps = 2.0;

}  // namespace graben
