// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine's cutting edge by what its controller takes in: with the same validation and
/// kinematics.

#include <array>
#include <optional>

#include "app/ecu/ground/edge_place.hpp"
#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/inputs/imu_joints.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben::ground {

class ExcavatorFinder {
 public:
  /// `setup` outlives it. The edge is as wide as its profile says; 0: the teeth's middle.
  explicit ExcavatorFinder(const ExcavatorSetup& setup) : setup_(setup) {}
  /// Each kPeriod_us. Nothing where not all of the pose is known; the force is left out.
  [[nodiscard]] std::optional<EdgePlace> look(const ExcavatorInputs& inputs, TimeUs now_us);

 private:
  [[nodiscard]] bool by_angles() const {
    return setup_.profile.imu.known() || setup_.profile.bus.joint_angles;
  }
  [[nodiscard]] const std::array<Signal<double>, kAxisCount>& strokes(
      const ExcavatorInputs& inputs);
  [[nodiscard]] bool is_still(const ExcavatorInputs& inputs) const;

  const ExcavatorSetup& setup_;
  std::array<AcceptedStroke, kDriveCount> accepted_;
  ImuState imus_;
  std::array<Signal<double>, kAxisCount> strokes_m_{};
};

class DozerFinder {
 public:
  /// `setup` outlives it.
  DozerFinder(const DozerSetup& setup, double width_m) : setup_(setup), width_m_(width_m) {}
  [[nodiscard]] std::optional<EdgePlace> look(const DozerInputs& inputs, TimeUs now_us);

 private:
  const DozerSetup& setup_;
  DozerValidationState state_;
  double width_m_;
};

// Of a controller's own, in its process.
[[nodiscard]] inline ExcavatorFinder finder_of(const ExcavatorSetup& setup) {
  return ExcavatorFinder(setup);
}
[[nodiscard]] inline DozerFinder finder_of(const DozerSetup& setup) {
  return {setup, setup.profile.tilt.edge_width_m};
}
/// Of the edge, m, as the profile says it; 0: it does not.
[[nodiscard]] inline double edge_width_m(const ExcavatorSetup& setup) {
  return setup.profile.geometry.body.bucket_width_m;
}
[[nodiscard]] inline double edge_width_m(const DozerSetup& setup) {
  return setup.profile.tilt.edge_width_m;
}

}  // namespace graben::ground
