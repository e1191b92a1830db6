#pragma once
/// What is done to frames on their way.

#include <functional>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/can_frame.hpp"
#include "hal/e2e.hpp"

namespace graben::faults {

namespace bus = dbc::excavator;

inline constexpr std::initializer_list<std::uint32_t> kStrokeIds = {
    bus::BoomStroke::kId, bus::ArmStroke::kId, bus::BucketStroke::kId};
inline constexpr std::initializer_list<std::uint32_t> kPressureIds = {
    bus::BoomPressure::kId, bus::ArmPressure::kId, bus::BucketPressure::kId};
/// All that the controller receives with counter and CRC.
inline constexpr std::initializer_list<std::uint32_t> kProtectedIds = {
    bus::BoomStroke::kId,   bus::ArmStroke::kId,   bus::BucketStroke::kId,
    bus::BoomPressure::kId, bus::ArmPressure::kId, bus::BucketPressure::kId,
    bus::PumpState::kId,    bus::ValveState::kId,  bus::OperatorCommand::kId};

[[nodiscard]] inline const dbc::MessageInfo& info_of(std::uint32_t id) {
  const dbc::MessageInfo* found = &bus::kMessages[0];
  for (const dbc::MessageInfo& message : bus::kMessages) {
    found = message.id == id ? &message : found;
  }
  return *found;
}

[[nodiscard]] inline TimeUs cycle_us_of(std::uint32_t id) {
  return info_of(id).cycle_time_ms * kMillisecondUs;
}

[[nodiscard]] inline std::uint8_t counter_of(const CanFrame& frame) {
  return static_cast<std::uint8_t>(frame.data[1] & 0x0FU);
}

/// Right again after its data were changed.
inline void protect(CanFrame& frame, std::uint8_t counter) {
  e2e_protect(frame.data, info_of(frame.id).data_id, counter);
}

/// Another value than it had, nothing else: within range for every message of ours.
inline void alter(CanFrame& frame) {
  frame.data[2] = static_cast<std::uint8_t>(frame.data[2] ^ 0x10U);
}

inline void corrupt(CanFrame& frame) {
  frame.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ 0x5AU);
}

inline void set_raw(CanFrame& frame, const dbc::Field& field, std::uint32_t raw) {
  dbc::insert(frame.data, field.start_bit, field.width, raw);
  protect(frame, counter_of(frame));
}

}  // namespace graben::faults
