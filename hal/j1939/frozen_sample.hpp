// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One sample of the machine as a fault came, as DM24 and DM25 of J1939-73 tell it.
///
/// | SPN | | raw |
/// |---|---|---|
/// | 520448 to 520451 | strokes, m; a swing's angle, rad | 16 bit, 0.0001 a bit, from -3.2 |
/// | 520452 to 520459 | pressures | 16 bit, 1 kPa a bit, from 0 |
/// | 520460 to 520463 | duties, displacements, 1 is full | 16 bit, 0.0001 a bit, from -3.2 |
/// | 520464 | lambda | 16 bit, 0.0001 a bit, from -3.2 |
/// | 520465 | mode | 8 bit |
///
/// What was not measured, or does not fit, is FFFFh. Which stroke is which: CycleSample of app/ecu.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "hal/j1939/transport.hpp"
#include "hal/j1939/trouble_codes.hpp"

namespace graben::j1939 {

/// Behind those of the faults, in the range that J1939 leaves to makers (520192 to 524287).
inline constexpr std::uint32_t kFirstParameterSpn = 520448;
inline constexpr std::size_t kSampleWords = 17;
inline constexpr std::uint16_t kNoWord = 0xFFFF;

struct FrozenSample {
  Fault fault = Fault::kNone;  ///< None: there is no sample.
  std::array<std::uint16_t, kSampleWords> word{};
  std::uint8_t mode = 0;
};

/// `value` in bits of `resolution` from `offset`; kNoWord if it does not fit or is no number.
[[nodiscard]] std::uint16_t sample_word(double value, double resolution, double offset);

/// DM24: each parameter, that it is in the freeze frame and nowhere else, and its bytes.
[[nodiscard]] LongMessage supported_parameters();

/// DM25: the fault's code and the parameters in the order of DM24. Without a sample, or where its
/// fault is stored no more, that there is none: eight bytes, 00 00 00 00 00 FF FF FF.
[[nodiscard]] LongMessage freeze_frame(const FrozenSample& sample, const Occurrences& stored);

}  // namespace graben::j1939
