// SPDX-License-Identifier: Apache-2.0
#include "app/plant/slope_sensors.hpp"

#include <cmath>

namespace graben::plant {
namespace {

constexpr double kCycle_s = 0.01;
constexpr double kPull_ps = 0.05;
constexpr double kLearn_ps2 = 0.0005;
/// At rest, before the machine moves: it has been switched on for a while.
constexpr int kReadingsAtRest = 500;
constexpr double kTurn_rad = 6.283185307179586;

ExcavatorPlantProfile with_housings(ExcavatorPlantProfile profile) {
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  profile.machine.imu = {};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    profile.machine.imu.mount[i].at_m = {0.5 * length_m[i], 0.0};
  }
  return profile;
}

double by_gravity(const dbc::j1939::ACS& force) {
  return std::atan2(force.longitudinal_mps2.value, force.vertical_mps2.value);
}

}  // namespace

SlopeSensors::SlopeSensors(const ExcavatorPlantProfile& profile)
    : inside_(with_housings(profile),
              profile.sensor_errors ? std::optional(profile.seed) : std::nullopt) {}

void SlopeSensors::look(const ExcavatorPlant& plant) {
  inside_.look(plant);
  for (std::size_t i = 0; i < sensor_.size(); ++i) {
    Sensor& sensor = sensor_[i];
    if (!is_on_) {
      double rate_radps = 0.0;
      double sine = 0.0;
      double cosine = 0.0;
      for (int n = 0; n < kReadingsAtRest; ++n) {
        rate_radps += inside_.rates(i).pitch_rate_radps.value;
        const double angle_rad = by_gravity(inside_.forces(i));
        sine += std::sin(angle_rad);
        cosine += std::cos(angle_rad);
      }
      sensor = {std::atan2(sine, cosine), rate_radps / kReadingsAtRest};
      continue;
    }
    const double rate_radps = inside_.rates(i).pitch_rate_radps.value;
    const double off_rad =
        std::remainder(by_gravity(inside_.forces(i)) - sensor.shown_rad, kTurn_rad);
    const double turned_rad = kCycle_s * (rate_radps - sensor.bias_radps + kPull_ps * off_rad);
    sensor.bias_radps -= kCycle_s * kLearn_ps2 * off_rad;
    sensor.shown_rad = std::remainder(sensor.shown_rad + turned_rad, kTurn_rad);
  }
  is_on_ = true;
}

}  // namespace graben::plant
