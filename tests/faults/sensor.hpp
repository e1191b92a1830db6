#pragma once
/// A sensor as the rows break it: a message of the machine's and what the controller makes of its
/// absence.

#include <vector>

#include "can_dbc/codec.hpp"
#include "firmware/core/codes.hpp"

namespace graben::faults {

struct Sensor {
  std::uint32_t id = 0;
  std::vector<dbc::Field> fields;  ///< Each of them measured, and of no use without its value.
  Fault missing = Fault::kNone;
};

/// A reading of some sensor that can be moved away from what is true.
struct Reading {
  double* offset = nullptr;
  double jump = 0.0;             ///< More than the quantity can change within a cycle.
  Fault jumped = Fault::kNone;   ///< While the last one is believed instead.
  Fault missing = Fault::kNone;  ///< When that has become too old.
};

/// A line of the shipped profile, what becomes of it, and the key that the message has to name.
struct Defect {
  const char* line = "";
  const char* instead = "";
  const char* key = "";
};

}  // namespace graben::faults
