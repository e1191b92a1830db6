// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The operator's station on a CAN interface.

#include <string>

#include "app/operate/station.hpp"

namespace graben::operate {

struct OperateOptions {
  std::string interface;
  std::string gamepad;    ///< Path; empty: the only one there is.
  bool keyboard = false;  ///< In place of a gamepad.
  StationOptions station;
  double seconds = 0.0;  ///< 0: until a signal, or the key.
};

/// Sends OperatorCommand and OperatorAxes every 20 ms, after half a second of listening, until the
/// time is over or the process is told to end; enable off goes out before it ends, and also if it
/// dies by a signal that can be caught. Throws std::runtime_error, with the reason, if it cannot
/// begin or may not go on: no interface, no gamepad, another station.
void run_station(const OperateOptions& options);

}  // namespace graben::operate
