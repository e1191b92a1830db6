// SPDX-License-Identifier: Apache-2.0
#include "app/commission/dozer_ear.hpp"

#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::commission {
namespace {

namespace bus = dbc::dozer;

/// Four frames of the machine in a row, and one more.
constexpr TimeUs kTimeout_us = 50 * kMillisecondUs;

bool is_fresh(TimeUs at_us, TimeUs now_us) { return now_us - at_us < kTimeout_us; }

}  // namespace

/// What is not valid leaves the last value and makes it old.
void DozerEar::take(const dbc::Physical& value, TimeUs now_us, double& to, TimeUs& at_us) {
  const bool valid = value.state == dbc::RawState::kValid;
  to = valid ? value.value : to;
  at_us = valid ? now_us : kNever_us;
}

void DozerEar::hear(const CanFrame& frame, TimeUs now_us) {
  constexpr std::uint8_t kLength = 8;
  if (!frame.extended || frame.remote || frame.error || frame.fd || frame.length != kLength) {
    return;
  }
  if (same_message(frame.id, bus::BladeStroke::kId)) {
    take(bus::BladeStroke::decode(frame.data).blade_stroke_m, now_us, seen_.stroke_m[0],
         stroke_us_[0]);
  } else if (same_message(frame.id, bus::TiltState::kId)) {
    take(bus::TiltState::decode(frame.data).tilt_stroke_m, now_us, seen_.stroke_m[1],
         stroke_us_[1]);
  } else if (same_message(frame.id, bus::BodyPosition::kId)) {
    take(bus::BodyPosition::decode(frame.data).position_m, now_us, seen_.position_m, position_us_);
  } else if (same_message(frame.id, bus::BodyVelocity::kId)) {
    take(bus::BodyVelocity::decode(frame.data).forward_mps, now_us, seen_.velocity_mps,
         velocity_us_);
  } else if (same_message(frame.id, bus::SpoolCommand::kId)) {
    const auto spools = bus::SpoolCommand::decode(frame.data);
    const auto ratio = [](const dbc::Physical& duty, double last) {
      return duty.state == dbc::RawState::kValid ? duty.value : last;
    };
    seen_.sent_ratio = {ratio(spools.blade_duty_ratio, seen_.sent_ratio[0]),
                        ratio(spools.tilt_duty_ratio, seen_.sent_ratio[1])};
  } else if (same_message(frame.id, bus::EcuStatus::kId)) {
    seen_.active = bus::EcuStatus::decode(frame.data).mode.value == bus::EcuStatus::Mode::kActive;
  }
}

std::optional<double> DozerEar::stroke_m(std::size_t drive, TimeUs now_us) const {
  return is_fresh(stroke_us_[drive], now_us) ? std::optional(seen_.stroke_m[drive]) : std::nullopt;
}

std::optional<double> DozerEar::position_m(TimeUs now_us) const {
  return is_fresh(position_us_, now_us) ? std::optional(seen_.position_m) : std::nullopt;
}

bool DozerEar::hears_machine(bool has_tilt, TimeUs now_us) const {
  return stroke_m(0, now_us) && position_m(now_us) && is_fresh(velocity_us_, now_us) &&
         (!has_tilt || stroke_m(1, now_us));
}

}  // namespace graben::commission
