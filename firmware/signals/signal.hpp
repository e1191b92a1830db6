// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Received values, each with its validity and the time of its reception.

#include <cstdint>

#include "firmware/core/time.hpp"

namespace graben {

/// Why a value may or may not be used. 'Error' and 'not available' stay distinct, as J1939 has
/// them.
enum class Validity : std::uint8_t {
  kNotReceived = 0,   ///< No frame yet.
  kNotAvailable = 1,  ///< The sender says that it has no such value.
  kError = 2,         ///< The sender says that its sensor has failed.
  kOutOfRange = 3,    ///< Outside the physical range of the frame's definition.
  kValid = 4,
};

/// A received value. `value` is meaningful only while `validity` is kValid; how old it may be is
/// for the validation to judge.
template <class T>
struct Signal {
  T value{};
  Validity validity = Validity::kNotReceived;
  TimeUs stamp_us = 0;
};

}  // namespace graben
