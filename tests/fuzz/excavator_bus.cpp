// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/excavator_bus.hpp"

#include <algorithm>

#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;

constexpr std::array<double, kAxisCount> kStart_m = {1.05, 1.1, 0.4};
constexpr double kEndMargin_m = 0.02;
constexpr double kSwash = 0.643;
constexpr double kEngine_radps = 188.5;
constexpr double kCap_pa = 4e6;
constexpr double kRod_pa = 3e6;
constexpr double kPressurePerStroke_papm = 1e6;  ///< No pressure stands still in motion.

constexpr dbc::Physical physical(double value) { return {value, RawState::kValid}; }

}  // namespace

const ExcavatorBus::Machine& ExcavatorBus::shipped() { return excavator(); }

bool ExcavatorBus::is_needed(std::uint32_t id) {
  switch (id) {
    case bus::BoomStroke::kId:
    case bus::ArmStroke::kId:
    case bus::BucketStroke::kId:
    case bus::PumpState::kId:
    case bus::ValveState::kId:
    case bus::OperatorCommand::kId:
      return true;
    default:
      return false;
  }
}

std::array<double, kAxisCount> ExcavatorBus::duties(const Dbc::SpoolCommand& command) {
  return {command.boom_duty_ratio.value, command.arm_duty_ratio.value,
          command.bucket_duty_ratio.value};
}

ExcavatorBus::Body::Body(const Profile& profile) : profile_(profile), strokes_m_(kStart_m) {}

void ExcavatorBus::Body::hear(const CanFrame& frame) {
  if (frame.id == bus::SpoolCommand::kId) {
    command_ = bus::SpoolCommand::decode(frame.data);
  } else if (frame.id == bus::EcuStatus::kId) {
    status_ = bus::EcuStatus::decode(frame.data);
  } else if (frame.id == bus::EcuMotion::kId) {
    motion_ = bus::EcuMotion::decode(frame.data);
  }
}

void ExcavatorBus::Body::move(double elapsed_s) {
  const bool follows = command_.enable.value == bus::SpoolCommand::Enable::kOn;
  const double lambda = follows ? status_.lambda.value : 0.0;
  const std::array<double, kAxisCount> wanted_mps = {motion_.boom_wanted_velocity_mps.value,
                                                     motion_.arm_wanted_velocity_mps.value,
                                                     motion_.bucket_wanted_velocity_mps.value};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double most_m = profile_.geometry.cylinder[i].stroke_m - kEndMargin_m;
    strokes_m_[i] += (lambda * wanted_mps[i] + pushed_mps[i]) * elapsed_s;
    strokes_m_[i] = std::clamp(strokes_m_[i], kEndMargin_m, most_m);
  }
}

void ExcavatorBus::Body::mend() {
  const auto is_pushed = [](double mps) { return mps != 0.0; };
  if (std::any_of(pushed_mps.begin(), pushed_mps.end(), is_pushed)) {
    strokes_m_ = kStart_m;
  }
  pushed_mps = {};
}

dbc::Payload ExcavatorBus::Body::payload_of(std::uint32_t id) const {
  const auto cap = [this](unsigned i) {
    return physical(kCap_pa + kPressurePerStroke_papm * strokes_m_[i]);
  };
  const auto rod = [this](unsigned i) {
    return physical(kRod_pa - kPressurePerStroke_papm * strokes_m_[i]);
  };
  switch (id) {
    case bus::BoomStroke::kId:
      return bus::BoomStroke{physical(strokes_m_[0])}.encode();
    case bus::ArmStroke::kId:
      return bus::ArmStroke{physical(strokes_m_[1])}.encode();
    case bus::BucketStroke::kId:
      return bus::BucketStroke{physical(strokes_m_[2])}.encode();
    case bus::BoomPressure::kId:
      return bus::BoomPressure{cap(0), rod(0)}.encode();
    case bus::ArmPressure::kId:
      return bus::ArmPressure{cap(1), rod(1)}.encode();
    case bus::BucketPressure::kId:
      return bus::BucketPressure{cap(2), rod(2)}.encode();
    case bus::PumpState::kId:
      return bus::PumpState{physical(kSwash), physical(kSwash)}.encode();
    case bus::EEC1::kId:
      return bus::EEC1{physical(kEngine_radps)}.encode();
    case bus::OperatorAxes::kId:
      return bus::OperatorAxes{physical(0.0), physical(0.0), physical(0.0), physical(0.0)}.encode();
    case bus::CommissionDuty::kId:
      return bus::CommissionDuty{physical(0.0), physical(0.0), physical(0.0)}.encode();
    case bus::CommissionWindow::kId:
      return bus::CommissionWindow{}.encode();
    case bus::SecondStrokes::kId:
      return bus::SecondStrokes{physical(strokes_m_[0]), physical(strokes_m_[1]),
                                physical(strokes_m_[2])}
          .encode();
    case bus::SecondSwing::kId:
      return bus::SecondSwing{physical(0.0)}.encode();
    default:
      break;
  }
  using Valve = bus::ValveState;
  const bool enabled = command_.enable.value == bus::SpoolCommand::Enable::kOn;
  return Valve{{enabled ? Valve::Enabled::kOn : Valve::Enabled::kOff, RawState::kValid},
               physical(command_.boom_duty_ratio.value),
               physical(command_.arm_duty_ratio.value),
               physical(command_.bucket_duty_ratio.value)}
      .encode();
}

std::string ExcavatorBus::OtherCommands::check(const std::vector<SentFrame>& sent, bool moves,
                                               TimeUs /*now*/) {
  for (const SentFrame& each : sent) {
    if (each.frame.id != bus::PumpCommand::kId) {
      continue;
    }
    const auto swash = bus::PumpCommand::decode(each.frame.data);
    if ((swash.pump1_swash_ratio.state == RawState::kValid) != moves ||
        (swash.pump2_swash_ratio.state == RawState::kValid) != moves) {
      return "a swash without enable, or none with it";
    }
  }
  return "";
}

}  // namespace graben::test
