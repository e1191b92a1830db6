// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/emergency_note.hpp"

#include <array>
#include <cstdio>

namespace graben::ecu {

void EmergencyNote::look(const NodeEmergency& now) {
  if (now.id == stands_.id && now.code == stands_.code) {
    return;
  }
  stands_ = now;
  if (now.id == 0) {
    static_cast<void>(manager_.status(status_));
    return;
  }
  last_ = now;
  count_ += count_ < UINT32_MAX ? 1U : 0U;
  std::array<char, 128> line{};
  static_cast<void>(std::snprintf(line.data(), line.size(), "%s; node %u has emergency %04Xh",
                                  status_, static_cast<unsigned>(now.id),
                                  static_cast<unsigned>(now.code)));
  static_cast<void>(manager_.status(line.data()));
}

std::string EmergencyNote::words() const {
  if (count_ == 0) {
    return "";
  }
  std::array<char, 128> line{};
  static_cast<void>(
      std::snprintf(line.data(), line.size(), "node %u had emergency %04Xh, the last of %u",
                    static_cast<unsigned>(last_.id), static_cast<unsigned>(last_.code), count_));
  return line.data();
}

}  // namespace graben::ecu
