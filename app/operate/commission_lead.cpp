// SPDX-License-Identifier: Apache-2.0
#include "app/operate/commission_lead.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/commission/wrong_way.hpp"

namespace graben::operate {
namespace {

double seconds_of(TimeUs now) { return static_cast<double>(now) * 1e-6; }

}  // namespace

ExcavatorLead::ExcavatorLead(const Options& options,
                             const std::vector<commission::StepResult>& done)
    : options_(options), sequence_(options) {
  sequence_.resume(done);
}

/// The listener has the strokes.
void ExcavatorLead::hear(const CanFrame& /*frame*/, TimeUs /*now*/) {}

bool ExcavatorLead::look(const EcuListener& ecu, TimeUs now) {
  const auto strokes_m = ecu.strokes_m(now);
  for (std::size_t k = 0; k < strokes_m.size(); ++k) {
    stroke_m_[k] = strokes_m[k].value_or(stroke_m_[k]);
  }
  const auto swing_rad = ecu.swing_rad(now);
  swing_rad_ = swing_rad.value_or(swing_rad_);
  return (swing_rad || !options_.swing) &&
         std::all_of(strokes_m.begin(), strokes_m.end(),
                     [](const auto& stroke_m) { return stroke_m.has_value(); });
}

void ExcavatorLead::step(const EcuListener& ecu, bool moving, TimeUs now) {
  sequence_.step(seconds_of(now),
                 {stroke_m_, ecu.sent_ratio(), moving, swing_rad_, ecu.swing_sent_ratio()});
}

TriedDuties ExcavatorLead::tried(bool on) const {
  TriedDuties tried;
  tried.window = options_.window;
  tried.has_window = options_.drives;
  if (on) {
    tried.duty_ratio = sequence_.duty();
  }
  return tried;
}

bool ExcavatorLead::touches() const {
  return !sequence_.is_done() &&
         sequence_.steps()[sequence_.at()].kind == commission::StepKind::kTouch;
}

std::string ExcavatorLead::step_text(std::size_t at) const {
  return commission::step_text(sequence_.steps()[at]);
}

std::string ExcavatorLead::speed_text(std::size_t at) const {
  return commission::speed_text(sequence_.steps()[at], sequence_.results()[at]);
}

std::string ExcavatorLead::wrong_text() const { return commission::wrong_text(*sequence_.wrong()); }

DozerLead::DozerLead(const Options& options, const std::vector<commission::StepResult>& done)
    : options_(options), sequence_(options) {
  sequence_.resume(done);
}

bool DozerLead::look(const EcuListener& /*ecu*/, TimeUs now) {
  return ear_.hears_machine(options_.has_tilt, now);
}

void DozerLead::step(const EcuListener& /*ecu*/, bool moving, TimeUs now) {
  commission::DozerSeen seen = ear_.seen();
  seen.active = moving;
  sequence_.step(seconds_of(now), seen);
}

DozerTries DozerLead::tried(bool on) const {
  DozerTries tries;
  if (on) {
    tries.tried = sequence_.tried();
  }
  const commission::SequenceOptions& blade = options_.blade;
  tries.window = {blade.window[0], blade.window[1], options_.way};
  tries.has_window = {blade.drives[0], blade.drives[1], options_.tracks};
  return tries;
}

std::string DozerLead::speed_text(std::size_t at) const {
  return fmt::format("{:.0f} mm/s", 1e3 * sequence_.results()[at].speed_mps);
}

std::string DozerLead::wrong_text() const {
  return commission::dozer_wrong_text(*sequence_.wrong());
}

}  // namespace graben::operate
