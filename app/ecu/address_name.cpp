// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/address_name.hpp"

#include <cstdlib>
#include <fstream>
#include <vector>

#include "app/ecu/store/record_format.hpp"
#include "hal/j1939/address_claim.hpp"

namespace graben::ecu {
namespace {
constexpr std::size_t kDigits = 16;
constexpr std::uint64_t kArbitraryCapable = std::uint64_t{1} << 63U;
constexpr std::uint64_t kReserved = std::uint64_t{1} << 48U;
}  // namespace

std::optional<std::uint64_t> parse_name(const std::string& text, std::string& error) {
  if (text.size() != kDigits ||
      text.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    error = "'" + text + "' is no NAME of J1939: 16 hexadecimal digits, the highest byte first";
    return std::nullopt;
  }
  const std::uint64_t name = std::strtoull(text.c_str(), nullptr, 16);
  if ((name & kArbitraryCapable) != 0) {
    error = "'" + text +
            "' says that its station moves to another address (bit 63); this one keeps its own, as "
            "the machine's end knows commands by it";
    return std::nullopt;
  }
  if ((name & kReserved) != 0) {
    error = "'" + text + "' sets bit 48, which J1939-81 keeps 0";
    return std::nullopt;
  }
  return name;
}

std::uint64_t found_name(const std::string& machine_id_file) {
  std::ifstream in(machine_id_file);
  std::string id;
  j1939::NameFields fields;
  if (in >> id) {
    const std::vector<std::uint8_t> bytes(id.begin(), id.end());
    fields.identity = crc32(bytes.data(), bytes.size());
  }
  return j1939::name_of(fields);
}

}  // namespace graben::ecu
