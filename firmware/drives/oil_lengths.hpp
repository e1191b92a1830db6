// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much oil stands in a drive's sides, as travel: what its pressure moves the drive by itself.

#include "firmware/drives/tuning.hpp"
#include "firmware/machine/drive_bank.hpp"

namespace graben {

struct OilLengths {
  double cap_m = 0.0;
  double rod_m = 0.0;
};

/// With hoses and dead volume. A motor's sides are as large wherever it stands.
inline OilLengths oil_lengths(const DriveRow& drive, double stroke_m) {
  if (!drive.control.has_end_stops) {
    return {kFlowHose_m, kFlowHose_m};
  }
  return {kFlowHose_m + stroke_m - drive.least_travel_m,
          kFlowHose_m + drive.most_travel_m - stroke_m};
}

}  // namespace graben
