// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the deployed controller says of its nodes' emergencies (CANopen, CiA 301): to the service
/// manager as they come and go, and of the last one on the way out.

#include <cstdint>
#include <string>

#include "hal/link/message_rules.hpp"
#include "platform/linux/service_notify.hpp"

namespace graben::ecu {

class EmergencyNote {
 public:
  /// `status` is what the manager hears while there is none; it outlives this.
  EmergencyNote(ServiceNotify& manager, const char* status) : manager_(manager), status_(status) {}

  /// To be called each cycle with what stands. Allocates nothing, blocks on nothing, and says
  /// something only where it has changed: "cycling; node 17 has emergency 5010h".
  void look(const NodeEmergency& now);

  /// The last one that there was; id 0: none.
  [[nodiscard]] const NodeEmergency& last() const { return last_; }
  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// "node 17 had emergency 5010h, the last of 3"; empty where there was none.
  [[nodiscard]] std::string words() const;

 private:
  ServiceNotify& manager_;
  const char* status_;
  NodeEmergency stands_;
  NodeEmergency last_;
  std::uint32_t count_ = 0;
};

}  // namespace graben::ecu
