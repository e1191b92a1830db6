// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Signals of the drives -> values that may be used: freshness, validity and plausibility of each
/// row, whatever the machine.

#include "firmware/machine/drive_bank.hpp"
#include "firmware/safety/plausibility.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// A drive's inputs that may be used.
struct ValidDrive {
  /// In the range that is sensed, now; of a motor the travel at its lever.
  double stroke_m = 0.0;
  double cap_pressure_pa = 0.0;
  double rod_pressure_pa = 0.0;
  double spool_ratio = 0.0;
  bool stroke_known = false;   ///< It is there, valid and in time.
  bool load_known = false;     ///< Both pressures may be used.
  bool stroke_is_new = false;  ///< It came since the last cycle.
};

/// State of a stroke from cycle to cycle.
struct AcceptedStroke {
  Believed believed;
  double speed_mps = 0.0;  ///< By its frames, low-passed.
};

/// Reads stroke and, where they are sensed, spool and pressures of each row. kStrokeMissing,
/// kStrokeImplausible, kStrokeJump, kSpoolMissing, kSensorError, kPressureMissing,
/// kPressureImplausible. A stroke that changed faster than its drive can is rejected, see
/// plausibility.hpp; `accepted` keeps the last one of each drive. Not `moving`, it is begun newly:
/// the machine may be moved by hand.
///
/// A stroke whose frame came before this cycle is carried on to now by its own speed, by a period
/// of its frames at most: where one drive's frame has just missed the cycle and another's has not,
/// strokes of two times would be a place where the tool has never been.
void read_drives(DriveRows drives, Span<const DriveInputs> inputs, bool moving,
                 const Freshness& fresh, Span<AcceptedStroke> accepted, Span<ValidDrive> valid,
                 FaultSet& faults);

}  // namespace graben
