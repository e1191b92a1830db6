// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a freeze frame keeps of a cycle, whatever the machine's kind: numbers, and which of them
/// were measured. SI units.
///
/// | | excavator | dozer |
/// |---|---|---|
/// | stroke | boom, arm, bucket, m; swing, rad | blade, tilt, m |
/// | pressure | cap and rod side of boom, arm, bucket; left and right port of the swing, Pa | left,
/// right transmission, Pa | | duty | boom, arm, bucket, swing | blade, tilt, left pump, right pump
/// |

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/dozer/dozer_signals.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben::ecu {

inline constexpr std::size_t kSampleStrokes = 4;
inline constexpr std::size_t kSamplePressures = 8;
inline constexpr std::size_t kSampleDuties = 4;

/// The kind of a record's machine; the numbers are in the files.
enum class SampleKind : std::uint8_t { kExcavator = 0, kDozer = 1 };

struct CycleSample {
  TimeUs now_us = 0;
  std::array<float, kSampleStrokes> stroke{};
  std::array<float, kSamplePressures> pressure_pa{};
  std::array<float, kSampleDuties> duty_ratio{};
  float lambda = 0.0F;
  /// Bits of the values that were valid: strokes from bit 0 on, then the pressures. Others are 0.
  std::uint16_t known = 0;
  EcuMode mode = EcuMode::kSilent;
};

[[nodiscard]] CycleSample sample_of(const ExcavatorInputs& in, const ExcavatorOutputs& out,
                                    TimeUs now_us);
[[nodiscard]] CycleSample sample_of(const DozerInputs& in, const DozerOutputs& out, TimeUs now_us);

[[nodiscard]] constexpr SampleKind sample_kind_of(const ExcavatorInputs* /*in*/) {
  return SampleKind::kExcavator;
}
[[nodiscard]] constexpr SampleKind sample_kind_of(const DozerInputs* /*in*/) {
  return SampleKind::kDozer;
}

/// Of what a sample has, in its order; null where the kind has no such value.
struct SampleNames {
  std::array<const char*, kSampleStrokes> stroke;
  std::array<const char*, kSamplePressures> pressure;
  std::array<const char*, kSampleDuties> duty;
};
[[nodiscard]] const SampleNames& sample_names(SampleKind kind);

}  // namespace graben::ecu
