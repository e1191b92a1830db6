// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simulated IMUs on the links: what gyro and accelerometer show of how the machine really moved.
///
/// A sensor's rate is that of its link between two moments 10 ms either side of the one that it
/// tells of, its acceleration the second difference of the path that its place took through space
/// in them: a bandwidth of some 25 Hz, and no formula of the links' motion.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "app/plant/excavator_plant.hpp"
#include "app/plant/linkage_geometry.hpp"
#include "app/plant/random.hpp"
#include "can_dbc/generated/j1939_dbc.hpp"

namespace graben::plant {

/// Of a machine whose profile has IMUs. `seed`: with the errors of `SensorErrors`; without, exact.
class LinkImuModel {
 public:
  LinkImuModel(const ExcavatorPlantProfile& profile, std::optional<std::uint64_t> seed);

  /// To be called every 10 ms, before the readings of that cycle are taken.
  void look(const ExcavatorPlant& plant);

  /// Readings of an IMU; noise is drawn anew.
  [[nodiscard]] dbc::j1939::ARI rates(std::size_t imu);
  [[nodiscard]] dbc::j1939::ACS forces(std::size_t imu);

 private:
  /// The machine at a moment: angle of each IMU's body against the horizontal, and its place.
  struct Moment {
    std::array<double, kImuCount> angle_rad{};
    std::array<Eigen::Vector3d, kImuCount> place_m;
    double swing_rad = 0.0;
  };
  struct Bias {
    double tilt_rad = 0.0;
    std::array<double, 3> rate_radps{};  ///< Pitch, roll, yaw.
  };

  [[nodiscard]] Moment moment_of(const ExcavatorPlant& plant) const;
  /// A vector of the body in the sensor's axes: long, upright.
  [[nodiscard]] Eigen::Vector2d seen(std::size_t imu, const Eigen::Vector2d& v) const;
  [[nodiscard]] double noise(double deviation);

  ImuProfile imu_;
  ExcavatorGeometry geometry_;
  LinkageGeometry linkage_;
  SensorErrors errors_;
  double gravity_mps2_;
  std::optional<Random> noise_;
  std::array<Bias, kImuCount> bias_{};
  std::array<Moment, 4> past_;  ///< Newest first; 10 ms apart.
  bool has_past_ = false;
};

}  // namespace graben::plant
