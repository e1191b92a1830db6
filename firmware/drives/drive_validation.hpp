#pragma once
/// Signals of the drives -> values that may be used: freshness, validity and plausibility of each
/// row, whatever the machine.

#include "firmware/machine/drive_bank.hpp"
#include "firmware/safety/plausibility.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// A drive's inputs that may be used.
struct ValidDrive {
  double stroke_m = 0.0;  ///< In the range that is sensed; of a motor the travel at its lever.
  double cap_pressure_pa = 0.0;
  double rod_pressure_pa = 0.0;
  double spool_ratio = 0.0;
  bool load_known = false;     ///< Both pressures may be used.
  bool stroke_is_new = false;  ///< It came since the last cycle.
};

/// Reads stroke and, where they are sensed, spool and pressures of each row. kStrokeMissing,
/// kStrokeImplausible, kStrokeJump, kSpoolMissing, kSensorError, kPressureMissing,
/// kPressureImplausible. A stroke that changed faster than its drive can is rejected, see
/// plausibility.hpp; `accepted` keeps the last one of each drive. Not `moving`, it is begun newly:
/// the machine may be moved by hand.
void read_drives(DriveRows drives, Span<const DriveInputs> inputs, bool moving,
                 const Freshness& fresh, Span<Believed> accepted, Span<ValidDrive> valid,
                 FaultSet& faults);

}  // namespace graben
