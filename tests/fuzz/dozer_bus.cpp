// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/dozer_bus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tracks.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

namespace graben::test {
namespace {

namespace bus = dbc::dozer;
using dbc::RawState;

constexpr double kLinePressure_pa = 10e6;
/// Of a pump and of a motor on the bus.
constexpr double kPumpStep = 5e-5;
constexpr double kMotorStep = 2e-5;

constexpr dbc::Physical physical(double value) { return {value, RawState::kValid}; }

}  // namespace

const DozerBus::Machine& DozerBus::shipped() { return dozer(); }

bool DozerBus::is_needed(std::uint32_t id) {
  return id != bus::EEC1::kId && id != bus::MachineIdentity::kId;
}

DozerBus::Body::Body(const Profile& profile)
    : profile_(profile), blade_(profile.blade), stroke_m_(blade_.stroke_m(0.0)) {}

void DozerBus::Body::hear(const CanFrame& frame) {
  switch (frame.id) {
    case Dbc::SpoolCommand::kId:
      command_ = Dbc::SpoolCommand::decode(frame.data);
      break;
    case PumpCommand::kId: {
      const auto pumps = PumpCommand::decode(frame.data);
      pump_ratio_ = {pumps.left_pump_ratio.value, pumps.right_pump_ratio.value};
      break;
    }
    case MotorCommand::kId: {
      const auto motors = MotorCommand::decode(frame.data);
      motor_ratio_ = {motors.left_motor_ratio.value, motors.right_motor_ratio.value};
      break;
    }
    case bus::EcuMotion::kId:
      motion_ = bus::EcuMotion::decode(frame.data);
      break;
    default:
      break;
  }
}

void DozerBus::Body::close() {
  command_ = {};
  pump_ratio_ = {};
  motor_ratio_ = {1.0, 1.0};
}

double DozerBus::Body::speed_mps() const {
  return track_speed_mps(profile_.hst, profile_.hst.engine_radps, pump_ratio_[kLeft],
                         motor_ratio_[kLeft]);
}

void DozerBus::Body::move(double elapsed_s) {
  const bool follows = command_.enable.value == Dbc::SpoolCommand::Enable::kOn;
  const double blade_mps = follows ? motion_.wanted_blade_velocity_mps.value : 0.0;
  stroke_m_ =
      std::clamp(stroke_m_ + (blade_mps + pushed_mps[0]) * elapsed_s, 0.0, blade_.stroke_max_m());
  position_m_ += (speed_mps() + pushed_mps[1]) * elapsed_s;
  height_m_ += pushed_mps[2] * elapsed_s;
}

void DozerBus::Body::mend() {
  if (pushed_mps != std::array<double, kPushed>{}) {
    height_m_ = 0.0;
  }
  pushed_mps = {};
}

dbc::Payload DozerBus::Body::payload_of(std::uint32_t id) const {
  const auto path = [this](unsigned track, auto message) {
    message.pump_ratio = physical(pump_ratio_[track]);
    message.motor_ratio = physical(motor_ratio_[track]);
    message.line_pressure_pa = physical(kLinePressure_pa);
    return message.encode();
  };
  switch (id) {
    case bus::BladeStroke::kId:
      return bus::BladeStroke{physical(stroke_m_)}.encode();
    case bus::BodyPosition::kId:
      return bus::BodyPosition{physical(position_m_), physical(height_m_)}.encode();
    case bus::BodyPitch::kId:
      return bus::BodyPitch{physical(0.0), physical(0.0)}.encode();
    case bus::BodyVelocity::kId:
      return bus::BodyVelocity{physical(speed_mps()), physical(0.0)}.encode();
    case bus::LeftTransmission::kId:
      return path(kLeft, bus::LeftTransmission());
    case bus::RightTransmission::kId:
      return path(kRight, bus::RightTransmission());
    case bus::TrackSpeed::kId:
      return bus::TrackSpeed{physical(speed_mps()), physical(speed_mps())}.encode();
    case bus::EEC1::kId:
      return bus::EEC1{physical(profile_.hst.engine_radps)}.encode();
    default:
      break;
  }
  const bool enabled = command_.enable.value == Dbc::SpoolCommand::Enable::kOn;
  return Dbc::ValveState{
      {enabled ? Dbc::ValveState::Enabled::kOn : Dbc::ValveState::Enabled::kOff, RawState::kValid},
      physical(command_.blade_duty_ratio.value)}
      .encode();
}

/// A pump away from 0 has a rate, the way back none.
std::string DozerBus::OtherCommands::check_pumps(const PumpCommand& command, bool moves,
                                                 double elapsed_s) {
  const double most = profile_.hst.pump_rate_ps * elapsed_s + 2.0 * kPumpStep;
  const std::array<double, kTrackCount> ratio = {command.left_pump_ratio.value,
                                                 command.right_pump_ratio.value};
  for (unsigned i = 0; i < kTrackCount; ++i) {
    if (!moves && ratio[i] != 0.0) {
      return "a pump stroked without enable";
    }
    const double last = ratio[i] * pump_ratio_[i] > 0.0 ? std::abs(pump_ratio_[i]) : 0.0;
    if (std::abs(ratio[i]) > 1.0 || std::abs(ratio[i]) > last + most) {
      return fmt::format("pump {} from {} to {} in {} s", i, pump_ratio_[i], ratio[i], elapsed_s);
    }
  }
  if (moves && command.brake.value == PumpCommand::Brake::kOn) {
    return "the brake closed with enable";
  }
  pump_ratio_ = ratio;
  return "";
}

/// A motor down from full displacement has a rate, the way back none.
std::string DozerBus::OtherCommands::check_motors(const MotorCommand& command, bool moves,
                                                  double elapsed_s) {
  const double most = profile_.hst.motor_rate_ps * elapsed_s + 2.0 * kMotorStep;
  const std::array<double, kTrackCount> ratio = {command.left_motor_ratio.value,
                                                 command.right_motor_ratio.value};
  for (unsigned i = 0; i < kTrackCount; ++i) {
    if (!moves && ratio[i] != 1.0) {
      return "a motor below full displacement without enable";
    }
    if (ratio[i] > 1.0 || ratio[i] < profile_.hst.motor_ratio_min - kMotorStep ||
        ratio[i] < motor_ratio_[i] - most) {
      return fmt::format("motor {} from {} to {} in {} s", i, motor_ratio_[i], ratio[i], elapsed_s);
    }
  }
  motor_ratio_ = ratio;
  return "";
}

std::string DozerBus::OtherCommands::check(const std::vector<SentFrame>& sent, bool moves,
                                           TimeUs now) {
  const double elapsed_s = last_us_ < 0 ? 0.0 : static_cast<double>(now - last_us_) * 1e-6;
  last_us_ = now;
  bool pumps = false;
  bool motors = false;
  std::string wrong;
  for (std::size_t i = 0; i < sent.size() && wrong.empty(); ++i) {
    const CanFrame& frame = sent[i].frame;
    if (frame.id == PumpCommand::kId) {
      pumps = true;
      wrong = check_pumps(PumpCommand::decode(frame.data), moves, elapsed_s);
    } else if (frame.id == MotorCommand::kId) {
      motors = true;
      wrong = check_motors(MotorCommand::decode(frame.data), moves, elapsed_s);
    }
  }
  return !wrong.empty() || (pumps && motors) ? wrong : "a cycle without pumps or motors";
}

}  // namespace graben::test
