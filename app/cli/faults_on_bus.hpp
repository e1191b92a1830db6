// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an ECU on a bus says of its faults, and clearing their records.

#include <string>

namespace graben::cli {

struct FaultsOnBus {
  std::string interface;
  int address = 0;
  std::string clear;  ///< "active", "previous", or none.
  bool json = false;
};

/// Asks and prints. Throws std::runtime_error, with what the ECU said, where it does not answer or
/// does not do it.
void faults_on_bus(const FaultsOnBus& options);

}  // namespace graben::cli
