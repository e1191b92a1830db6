// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's NAME on J1939, as it is told or found.

#include <cstdint>
#include <optional>
#include <string>

namespace graben::ecu {

/// 16 hexadecimal digits. Nothing, with the reason in `error`, if it is none or says what this
/// controller can't do: move to another address.
[[nodiscard]] std::optional<std::uint64_t> parse_name(const std::string& text, std::string& error);

/// The same on each start of a computer, and as good as never that of another one: its identity is
/// the low 21 bits of the CRC-32 of the text in `machine_id_file` (machine-id(5)); 0 if that
/// cannot be read. No manufacturer's number: the SAE gives those.
[[nodiscard]] std::uint64_t found_name(const std::string& machine_id_file);

}  // namespace graben::ecu
