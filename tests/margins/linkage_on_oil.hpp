// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The linear truth that the margins are measured on: boom, arm and bucket on their oil columns,
/// each spool's lag before its flow, a cycle at a time. It has the plant's numbers and geometry and
/// no formula of the controller.

#include <Eigen/Core>

#include "app/plant/excavator_plant_profile.hpp"

namespace graben::margins {

/// x' = a x + b u, y = c x + d u, from one cycle to the next.
struct Discrete {
  Eigen::MatrixXd a;
  Eigen::MatrixXd b;
  Eigen::MatrixXd c;
  Eigen::MatrixXd d;
};

/// Forces are counted in this, or eigenvalues would drown in the rounding of numbers so unlike.
inline constexpr double kForceUnit_n = 1e7;

/// What a controller does not know of its machine.
struct Truth {
  double bulk_modulus_pa = 0.0;
  double mass_ratio = 1.0;             ///< Of the profile's, all links alike.
  double spool_time_constant_s = 0.0;  ///< 1 / natural frequency.
  int late_cycles = 0;                 ///< From a command to the duty's arrival, beside the hold.
  double speed_mps = 0.0;  ///< Of each drive: what flows is what its orifices damp with.
};

/// M of M l'' = F by the strokes l of boom, arm and bucket: kg.
[[nodiscard]] Eigen::Matrix3d inertia_kg(const plant::ExcavatorPlantProfile& machine,
                                         const Eigen::Vector3d& strokes_m, double mass_ratio);

/// Of each axis' two oil columns, N/m.
[[nodiscard]] Eigen::Vector3d stiffness_npm(const plant::ExcavatorPlantProfile& machine,
                                            const Eigen::Vector3d& strokes_m,
                                            double bulk_modulus_pa);

/// Of boom, arm and bucket with shut spools, without friction, slowest first, Hz.
[[nodiscard]] Eigen::Vector3d modes_hz(const plant::ExcavatorPlantProfile& machine,
                                       const Eigen::Vector3d& strokes_m, const Truth& truth);

/// From the duties of boom and arm, as the speeds that they stand for, m/s, held over a cycle, to
/// their strokes (m) and their oil's forces (kForceUnit_n), about rest at a pose:
///
///   M l'' = F - D l',  F = K (w - l),  w' = q - g (F - p),  q'' = (u - q) / T^2 - 2 q' / T
///
/// w is what has flowed, over the area. D is half of the profile's viscous friction, the least that
/// a machine is found with. The flow gives way to the force by g = v / (2 A 5 MPa), as it does
/// through orifices that take that pressure at a speed v; p is F through the controller's low-pass
/// of the load, which its valve's model makes good. At rest, g = 0, nothing is left but friction.
/// The bucket's servo takes back what has flowed. A cycle is exact: the matrix exponential.
[[nodiscard]] Discrete linkage_on_oil(const plant::ExcavatorPlantProfile& machine,
                                      const Eigen::Vector3d& strokes_m, const Truth& truth);

}  // namespace graben::margins
