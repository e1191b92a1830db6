// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/drive_gate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/drives/spool_opening.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

double duty_of(const DriveRow& drive, double opening) {
  if (opening != 0.0 && std::abs(opening) >= drive.control.spool_threshold) {
    return std::copysign(
        std::clamp(duty_at(drive.answer.towards(opening), std::abs(opening)), 0.0, 1.0), opening);
  }
  return 0.0;
}

double change_max(const DriveRow& drive, double period_s) {
  return drive.control.duty_rate_ps * std::max(0.0, period_s);
}

bool is_finite(DriveRows drives, Span<const double> wanted_ratio, double period_s) {
  bool finite = true;
  for (int i = 0; i < drives.count(); ++i) {
    finite =
        finite && std::isfinite(wanted_ratio[i]) && std::isfinite(change_max(drives[i], period_s));
  }
  return finite;
}

}  // namespace

double slew_limited(double wanted, double last, double change_max) {
  const double open = std::max(0.0, std::signbit(wanted) ? -last : last);  // on wanted's side
  const double limit = open + change_max;
  return std::clamp(wanted, -limit, limit);
}

void open_spools(DriveRows drives, Span<const double> spool_m, double period_s,
                 Span<double> opening, Span<double> duty_ratio) {
  for (int i = 0; i < drives.count(); ++i) {
    const double change = drives[i].control.spool_rate_ps * std::max(0.0, period_s);
    if (!std::isfinite(spool_m[i]) || !std::isfinite(change)) {
      opening[i] = 0.0;
      duty_ratio[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const double wanted = std::clamp(spool_m[i] / drives[i].metering.spool_travel_m, -1.0, 1.0);
    opening[i] = slew_limited(wanted, opening[i], change);
    duty_ratio[i] = duty_of(drives[i], opening[i]);
  }
}

void step_duties(DriveRows drives, Span<const double> tried_ratio, double period_s,
                 Span<const double> sent, Span<double> duty_ratio) {
  const double change = kTriedDutyRate_ps * std::max(0.0, period_s);
  for (int i = 0; i < drives.count(); ++i) {
    duty_ratio[i] = slew_limited(tried_ratio[i], sent[i], change);
  }
}

GateResult gate_duties(DriveRows drives, bool active, Span<const double> wanted_ratio,
                       double period_s, Span<double> sent, Span<double> duty_ratio) {
  const bool sends = active && is_finite(drives, wanted_ratio, period_s);
  if (!sends) {
    std::fill(sent.begin(), sent.end(), 0.0);
    std::fill(duty_ratio.begin(), duty_ratio.end(), 0.0);
    return {false, active ? Fault::kCommandNotFinite : Fault::kNone};
  }
  for (int i = 0; i < drives.count(); ++i) {
    const double wanted = std::clamp(wanted_ratio[i], -1.0, 1.0);
    sent[i] = slew_limited(wanted, sent[i], change_max(drives[i], period_s));
    duty_ratio[i] = sent[i];
  }
  return {true, Fault::kNone};
}

}  // namespace graben
