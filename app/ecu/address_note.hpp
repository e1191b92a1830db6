// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the deployed controller says of an address that it has lost (SAE J1939-81): once, to the
/// service manager and on standard error.

#include "hal/j1939/address_claim.hpp"
#include "platform/linux/service_notify.hpp"

namespace graben::ecu {

class AddressNote {
 public:
  /// Both outlive this.
  AddressNote(ServiceNotify& manager, const j1939::AddressClaim& claim)
      : manager_(manager), claim_(claim) {}

  /// To be called each cycle. Allocates nothing, and writes once: in the cycle that stops the
  /// machine, behind its frames.
  void look();

 private:
  ServiceNotify& manager_;
  const j1939::AddressClaim& claim_;
  bool has_said_ = false;
};

}  // namespace graben::ecu
