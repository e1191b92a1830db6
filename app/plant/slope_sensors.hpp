// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Slope sensors on links and platform, as they are sold: a gyro and an accelerometer in one
/// housing, whose own filter shows an angle against the horizontal.
///
///   rate of the shown angle = gyro - bias + kPull * (by gravity - shown)
///   rate of the bias        = -kLearn * (by gravity - shown)
///
/// (Mahony et al., IEEE Trans. Automatic Control 53, 2008, of one axis.) So it is off by its
/// alignment for good, and by what the link's own acceleration draws it aside while that lasts.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/plant/link_imus.hpp"

namespace graben::plant {

class SlopeSensors {
 public:
  /// Age of what it shows.
  static constexpr double kLatency_s = 0.02;

  /// Each in the middle of its link; errors where the profile has them.
  explicit SlopeSensors(const ExcavatorPlantProfile& profile);

  /// To be called every 10 ms, before the readings of that cycle are taken.
  void look(const ExcavatorPlant& plant);

  /// rad, -pi .. pi, of boom, arm, bucket, platform; nose up is positive.
  [[nodiscard]] double slope_rad(std::size_t link) const { return sensor_[link].shown_rad; }

 private:
  struct Sensor {
    double shown_rad = 0.0;
    double bias_radps = 0.0;
  };

  LinkImuModel inside_;
  std::array<Sensor, kImuCount> sensor_{};
  bool is_on_ = false;
};

}  // namespace graben::plant
