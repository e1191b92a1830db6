// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages that are none of our DBC: those of a machine's own bus, by its bus profile, and those
/// of SAE J1939 that sensors on a machine's links send.

#include <cstdint>
#include <optional>
#include <vector>

#include "app/export/json_message.hpp"
#include "app/machines/bus_file.hpp"

namespace graben::app_export {

/// Each message that the bus profile has, received and sent, as "/zx200/FrontAngle", its signals by
/// the profile's names in the SI unit of what they are: rad, m, Pa, rad/s, or none (shares,
/// states). Two signals of one place, as the pilot pressures of two sides, stay two. A value beyond
/// its allowed range, failed or not available is not there. And what CANopen's nodes say of
/// themselves.
[[nodiscard]] std::vector<JsonMessage> bus_messages(const machines::BusFile& bus);

/// Of a sensor on a link, known by its message's group whatever its priority, as "/sensor/E2/ARI":
/// its source address and the standard's name. None where the 29-bit id is not of these.
[[nodiscard]] std::optional<JsonMessage> link_sensor_message(std::uint32_t id);

}  // namespace graben::app_export
