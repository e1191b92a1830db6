// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of this room: each value with its unit, why it is so, and what else was tried.

namespace graben {

/// Period of a controller's cycle, what a place of a ring of commands stands for. [s; chosen: that
/// of the drives' strokes and commands on the bus; not tried]
inline constexpr double kCyclePeriod_s = 0.01;
/// Cycles after the last one beyond which a cycle is a stall, which stops. [cycles; chosen: what
/// the machine did meanwhile is not known; not tried]
inline constexpr int kMostCyclesLate = 5;

}  // namespace graben
