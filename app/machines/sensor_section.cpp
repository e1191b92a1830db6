// SPDX-License-Identifier: Apache-2.0
#include "app/machines/sensor_section.hpp"

#include <algorithm>
#include <vector>

#include "app/machines/imu_section.hpp"
#include "app/machines/second_section.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

/// A number for each cylinder, 0 where nothing is said.
std::array<double, kAxisCount> read_zeros(TomlReader& reader, const std::string& key,
                                          const Range& range, const char* help) {
  std::array<double, kAxisCount> zeros{};
  if (reader.has(key)) {
    const std::vector<double> said = reader.numbers(key, range, kAxisCount, help);
    std::copy(said.begin(), said.end(), zeros.begin());
  }
  return zeros;
}

SensorZeros read_sensor_zeros(TomlReader& reader) {
  const Range pressure{-3e6, 3e6, "Pa"};
  SensorZeros zero;
  zero.stroke_m =
      read_zeros(reader, "sensors.stroke_zero", {-0.05, 0.05, "m"},
                 "boom, arm, bucket: what the stroke sensor shows of a closed cylinder");
  zero.cap_pa = read_zeros(reader, "sensors.cap_zero", pressure,
                           "the same of the cap side's pressure sensor, without pressure");
  zero.rod_pa = read_zeros(reader, "sensors.rod_zero", pressure,
                           "the same of the rod side's pressure sensor");
  return zero;
}

}  // namespace

void read_joint_sensors(TomlReader& reader, ExcavatorProfile& profile) {
  profile.sensor_zero = read_sensor_zeros(reader);
  profile.imu = read_imus(reader);
  profile.second = read_seconds(reader, profile.has_swing());
}

}  // namespace graben::machines
