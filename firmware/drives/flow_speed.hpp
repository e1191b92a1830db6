// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a drive can do at its measured opening and pressures.

#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/learnt/learnt_valve.hpp"

namespace graben {

/// Speeds that are possible, m/s; extension is positive.
struct SpeedRange {
  double least_mps = 0.0;
  double most_mps = 0.0;
};

/// What the drive can do at these measured values, quasi-steady.
///
/// Metering edges (Kim 3.1 - 3.3): the oil that leaves the draining side passes an opening and a
/// pressure that are both measured, whatever pump, load or obstacle do, and its flow is the speed.
/// On the regenerating side it passes the drain too, and at most the check valve besides. Held by a
/// rock, the draining side has no pressure and no flow; where none is left, the other side's oil
/// may push the drive back against its spool.
///
/// Metered inlet (DriveSupply): the opening's flow, at least as far as the pump gives it.
///
/// Openings are known within 12 %, and as far as they are learnt, but no nearer than 3.5 % of the
/// spool's travel; drain and check within 33 %,
/// pressures within 1.2 MPa, a metered inlet within 20 %. The return line keeps up to 0.2 MPa. A
/// motor may lose what it leaks (`leak_mpspa`) besides.
/// `learnt`: null where the valve is not learnt; of a metered inlet it is not looked at.
[[nodiscard]] SpeedRange possible_speed(const DriveRow& drive, const LearntValve* learnt,
                                        const ValidDrive& seen, double engine_radps);

}  // namespace graben
