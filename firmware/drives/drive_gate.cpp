// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/drive_gate.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/spool_opening.hpp"

namespace graben {
namespace {

double change_max(const DriveRow& drive, double period_s) {
  return drive.control.spool_rate_ps * std::max(0.0, period_s);
}

bool is_finite(DriveRows drives, Span<const double> spool_m, double period_s) {
  bool finite = true;
  for (int i = 0; i < drives.count(); ++i) {
    finite = finite && std::isfinite(spool_m[i]) && std::isfinite(change_max(drives[i], period_s));
  }
  return finite;
}

bool is_intact(DriveRows drives, Span<Guarded<double>> opening) {
  bool intact = true;
  for (int i = 0; i < drives.count(); ++i) {
    intact = intact && opening[i].intact();
  }
  return intact;
}

double duty_of(const DriveRow& drive, double opening) {
  if (opening != 0.0 && std::abs(opening) >= drive.control.spool_threshold) {
    return std::copysign(
        std::clamp(duty_at(drive.answer.towards(opening), std::abs(opening)), 0.0, 1.0), opening);
  }
  return 0.0;
}

GateResult neutral(Fault fault, Span<Guarded<double>> opening, Span<double> duty_ratio) {
  std::fill(opening.begin(), opening.end(), Guarded(0.0));
  std::fill(duty_ratio.begin(), duty_ratio.end(), 0.0);
  return {false, fault};
}

/// kNone: the command may go on.
Fault refusal(DriveRows drives, Span<const double> command, double period_s,
              Span<Guarded<double>> kept) {
  if (!is_finite(drives, command, period_s)) {
    return Fault::kCommandNotFinite;
  }
  return is_intact(drives, kept) ? Fault::kNone : Fault::kMemoryCorrupt;
}

}  // namespace

double slew_limited(double wanted, double last, double change_max) {
  const double open = std::max(0.0, std::signbit(wanted) ? -last : last);  // on wanted's side
  const double limit = open + change_max;
  return std::clamp(wanted, -limit, limit);
}

GateResult gate_drives(DriveRows drives, bool active, Span<const double> spool_m, double period_s,
                       Span<Guarded<double>> opening, Span<double> duty_ratio) {
  const Fault refused = active ? refusal(drives, spool_m, period_s, opening) : Fault::kNone;
  if (!active || refused != Fault::kNone) {
    return neutral(refused, opening, duty_ratio);
  }
  for (int i = 0; i < drives.count(); ++i) {
    const double wanted = std::clamp(spool_m[i] / drives[i].metering.spool_travel_m, -1.0, 1.0);
    const double next = slew_limited(wanted, opening[i].value(), change_max(drives[i], period_s));
    opening[i] = next;
    duty_ratio[i] = duty_of(drives[i], next);
  }
  return {true, Fault::kNone};
}

GateResult gate_duties(DriveRows drives, bool active, Span<const double> wanted_ratio,
                       double period_s, Span<Guarded<double>> sent, Span<double> duty_ratio) {
  const Fault refused = active ? refusal(drives, wanted_ratio, period_s, sent) : Fault::kNone;
  if (!active || refused != Fault::kNone) {
    return neutral(refused, sent, duty_ratio);
  }
  for (int i = 0; i < drives.count(); ++i) {
    const double wanted = std::clamp(wanted_ratio[i], -1.0, 1.0);
    duty_ratio[i] =
        slew_limited(wanted, sent[i].value(), kTriedDutyRate_ps * std::max(0.0, period_s));
    sent[i] = duty_ratio[i];
  }
  return {true, Fault::kNone};
}

}  // namespace graben
