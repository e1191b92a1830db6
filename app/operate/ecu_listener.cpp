// SPDX-License-Identifier: Apache-2.0
#include "app/operate/ecu_listener.hpp"

#include "can_dbc/codec.hpp"
#include "hal/link/dm1.hpp"

namespace graben::operate {
namespace {

using Dbc = EcuListener::Dbc;

/// Three frames of a stroke in a row, and one more.
constexpr TimeUs kStrokeTimeout_us = 50 * kMillisecondUs;
constexpr std::uint32_t kAddressMask = 0xFF;

bool is_data(const CanFrame& frame) {
  constexpr std::uint8_t kLength = 8;
  return frame.extended && !frame.remote && !frame.error && !frame.fd && frame.length == kLength;
}

/// The same message by whatever source.
bool is_operator_command(std::uint32_t id) {
  constexpr std::uint32_t kPgnMask = 0x03FFFF00;
  return ((id ^ Dbc::OperatorCommand::kId) & kPgnMask) == 0;
}

}  // namespace

template <class Message>
void EcuListener::take(const CanFrame& frame, TimeUs now, Heard<Message>& to) {
  if (same_message(frame.id, Message::kId)) {
    to.said = Message::decode(frame.data);
    to.at_us = now;
  }
}

template <class Message>
void EcuListener::take_stroke(const CanFrame& frame, dbc::Physical Message::*signal, TimeUs now,
                              Stroke& to) {
  if (same_message(frame.id, Message::kId)) {
    to = {Message::decode(frame.data).*signal, now};
  }
}

void EcuListener::take_trouble(const CanFrame& frame, TimeUs now) {
  if (same_message(frame.id, Dbc::DM1::kId)) {
    note_trouble(frame, now);
  } else if (troubles_.hear(frame, now)) {
    const j1939::LongMessage& all = troubles_.message();
    for (std::size_t i = 0; i < j1939::codes_of(all); ++i) {
      note_trouble(j1939::single_code(all, i, kOwnAddress, now), now);
    }
  }
}

void EcuListener::note_trouble(const CanFrame& frame, TimeUs now) {
  const auto trouble = Dbc::DM1::decode(frame.data);
  const std::uint32_t spn = trouble.spn_low.value | trouble.spn_high.value << 16U;
  if (spn > kDm1FirstSpn && spn < kDm1FirstSpn + kFaultCount) {
    trouble_us_[spn] = now;
  }
}

void EcuListener::hear(const CanFrame& frame, TimeUs now) {
  if (!is_data(frame)) {
    return;
  }
  if (is_operator_command(frame.id)) {
    other_station_ = static_cast<std::uint8_t>(frame.id & kAddressMask);
  }
  echo_.hear(frame);
  take(frame, now, status_);
  take(frame, now, health_);
  take(frame, now, identity_);
  take(frame, now, task_);
  take(frame, now, tip_load_);
  take(frame, now, checks_);
  take(frame, now, motion_);
  take(frame, now, spools_);
  take(frame, now, swing_spool_);
  take_stroke(frame, &Dbc::SwingState::swing_angle_rad, now, swing_);
  take_stroke(frame, &Dbc::BoomStroke::boom_stroke_m, now, strokes_[0]);
  take_stroke(frame, &Dbc::ArmStroke::arm_stroke_m, now, strokes_[1]);
  take_stroke(frame, &Dbc::BucketStroke::bucket_stroke_m, now, strokes_[2]);
  take_trouble(frame, now);
}

std::optional<double> EcuListener::swing_rad(TimeUs now) const {
  const bool heard =
      swing_.value.state == dbc::RawState::kValid && now - swing_.at_us < kStrokeTimeout_us;
  return heard ? std::optional(swing_.value.value) : std::nullopt;
}

double EcuListener::swing_sent_ratio() const {
  return swing_spool_.said ? swing_spool_.said->swing_duty_ratio.value : 0.0;
}

std::array<std::optional<double>, 3> EcuListener::strokes_m(TimeUs now) const {
  std::array<std::optional<double>, 3> strokes_m;
  for (std::size_t i = 0; i < strokes_.size(); ++i) {
    const Stroke& stroke = strokes_[i];
    if (stroke.value.state == dbc::RawState::kValid && now - stroke.at_us < kStrokeTimeout_us) {
      strokes_m[i] = stroke.value.value;
    }
  }
  return strokes_m;
}

std::array<double, 3> EcuListener::sent_ratio() const {
  if (!spools_.said) {
    return {};
  }
  const auto ratio = [](const dbc::Physical& duty) {
    return duty.state == dbc::RawState::kValid ? duty.value : 0.0;
  };
  return {ratio(spools_.said->boom_duty_ratio), ratio(spools_.said->arm_duty_ratio),
          ratio(spools_.said->bucket_duty_ratio)};
}

std::vector<Fault> EcuListener::faults(TimeUs now) const {
  std::vector<Fault> faults;
  for (const auto& [spn, at_us] : trouble_us_) {
    if (now - at_us < kTroubleFor_us) {
      faults.push_back(static_cast<Fault>(spn - kDm1FirstSpn));
    }
  }
  return faults;
}

std::optional<EcuMode> EcuListener::mode(TimeUs now) const {
  if (!hears_ecu(now) || status_.said->mode.state != dbc::RawState::kValid) {
    return std::nullopt;
  }
  return static_cast<EcuMode>(status_.said->mode.value);
}

std::optional<std::uint32_t> EcuListener::other_version() const {
  if (!identity_.said) {
    return std::nullopt;
  }
  const dbc::Count& version = identity_.said->dbc_version;
  const bool is_ours = version.state == dbc::RawState::kValid && version.value == dbc_version_;
  return is_ours ? std::nullopt : std::optional<std::uint32_t>(version.value);
}

}  // namespace graben::operate
