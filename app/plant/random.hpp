// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Random numbers that are the same with every standard library: the standard fixes its engines,
/// not its distributions.

#include <cmath>
#include <cstdint>
#include <random>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {

/// What is drawn. Each has a stream of its own, so that what is switched on beside it changes
/// nothing.
enum class Draw : std::uint32_t {
  kParameters = 1,
  kSensorBias,
  kSensorNoise,
  kSoil,
  kDeadTime,
  kStart,
  kPoseNoise,
  kTrackNoise,
  kAsFound,
  kHidden,
  kSoilKind,
  kFencedTask,
  kImuBias,
  kImuNoise,
  kDesign,
  kJointBias,
  kLoad,
  kImuMounting,
  kEye,
  kSecondBias,
};

class Random {
 public:
  Random(std::uint64_t seed, Draw stream) : engine_(seeded(seed, stream)) {}
  /// One of many streams of the same name.
  Random(std::uint64_t seed, Draw stream, std::uint32_t place)
      : engine_(seeded(seed, stream, place)) {}

  /// [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// [-most, most).
  double symmetric(double most) { return most * (2.0 * uniform() - 1.0); }
  /// Mean 0, standard deviation 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(kTwoPi * uniform());
  }

 private:
  template <class... Place>
  static std::mt19937_64 seeded(std::uint64_t seed, Draw stream, Place... place) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(stream), place...};
    return std::mt19937_64(sequence);
  }

  std::mt19937_64 engine_;
};

}  // namespace graben::plant
