// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The mobile manipulator's Jacobian (1)-(5): what body and blade together do to the cutting edge.
/// World frame, x along the grade, z up; velocities are linear over angular.

#include <Eigen/Core>

#include "firmware/dozer/blade.hpp"

namespace graben {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The body frame in the world.
struct BodyPose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    ///< r_V
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< R_V: body to world.
};

/// R_V of a body that is pitched (nose up is positive) and neither rolled nor turned.
[[nodiscard]] Eigen::Matrix3d rotation_from_pitch(double pitch_rad);

/// Cutting edge in the body frame, ^V r_e^V of (2); y is 0.
[[nodiscard]] Eigen::Vector3d edge_in_body_m(const BladeKinematics& blade, double angle_rad);

/// The same in the world.
[[nodiscard]] Eigen::Vector3d edge_in_world_m(const BladeKinematics& blade, const BodyPose& body,
                                              double angle_rad);

/// J_V of (2): 6 x 6, from the body's velocity to the edge's.
[[nodiscard]] Matrix6d body_jacobian(const BladeKinematics& blade, const BodyPose& body,
                                     double angle_rad);

/// J_m of (3): 6 x 1, from theta_1-dot to the edge's velocity. theta_1 turns about -y of the body.
[[nodiscard]] Vector6d blade_jacobian(const BladeKinematics& blade, const BodyPose& body,
                                      double angle_rad);

/// theta_1-dot of (5), rad/s, that gives the edge the velocity `wanted_mps` along `normal`, a unit
/// vector of the world, whatever the body's velocity x_V-dot is. The blade has one joint: the five
/// other degrees of freedom of x_e,des keep what they measure, so that only this row is left. 0
/// where the joint does not act along the normal.
[[nodiscard]] double joint_rate_radps(const BladeKinematics& blade, const BodyPose& body,
                                      double angle_rad, const Vector6d& body_velocity,
                                      const Eigen::Vector3d& normal, double wanted_mps);

}  // namespace graben
