// SPDX-License-Identifier: Apache-2.0
#include "app/plant/second_sensors.hpp"

#include <algorithm>
#include <cmath>

#include "app/plant/random.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

constexpr double kCycle_s = 0.01;

}  // namespace

SecondSensorModel::SecondSensorModel(const ExcavatorPlantProfile& profile) {
  const SensorErrors& errors = profile.sensors;
  const double age_off_s = 0.5 * (errors.second_age_s[1] - errors.second_age_s[0]);
  Random random(profile.seed, Draw::kSecondBias);
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    Sensor& sensor = sensor_[i];
    sensor.is_there = profile.machine.second.has[i];
    sensor.age_cycles = (errors.second_age_s[0] + age_off_s) / kCycle_s;
    if (profile.sensor_errors) {
      sensor.bias =
          random.symmetric(i == kSwing ? errors.second_swing_bias_rad : errors.second_bias_m);
      sensor.scale += random.symmetric(errors.second_scale);
      sensor.age_cycles += random.symmetric(age_off_s) / kCycle_s;
    }
  }
}

void SecondSensorModel::look(const ExcavatorPlant& plant, const ExcavatorFaults& faults) {
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    Sensor& sensor = sensor_[i];
    if (!sensor.is_there) {
      continue;
    }
    const double now = i == kSwing ? plant.swing_rad() : plant.strokes_m()[i];
    if (!has_looked_) {
      sensor.last.fill(now);
    }
    std::rotate(sensor.last.rbegin(), sensor.last.rbegin() + 1, sensor.last.rend());
    sensor.last[0] = now;
    const auto before = static_cast<std::size_t>(sensor.age_cycles);
    const double newer = sensor.last[before];
    const double then = newer + (sensor.age_cycles - std::floor(sensor.age_cycles)) *
                                    (sensor.last[before + 1] - newer);
    const double read = sensor.scale * then + sensor.bias;
    shown_[i] = i == kSwing ? sensor.faulty.show(std::remainder(read, kTwoPi),
                                                 ReadingFault(faults.swing.second))
                            : sensor.faulty.show(read, ReadingFault(faults.axis[i].second));
  }
  has_looked_ = true;
}

}  // namespace graben::plant
