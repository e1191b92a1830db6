// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/mobile_jacobian.hpp"

#include <cmath>

#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// [a]x with [a]x b = a x b.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

}  // namespace

Eigen::Matrix3d rotation_from_pitch(double pitch_rad) {
  const double c = std::cos(pitch_rad);
  const double s = std::sin(pitch_rad);
  Eigen::Matrix3d rotation;
  rotation << c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c;
  return rotation;
}

Eigen::Vector3d edge_in_body_m(const BladeKinematics& blade, double angle_rad) {
  const Eigen::Vector2d edge_m = blade.edge_m(angle_rad);
  return {edge_m.x(), 0.0, edge_m.y()};
}

Eigen::Vector3d edge_in_world_m(const BladeKinematics& blade, const BodyPose& body,
                                double angle_rad) {
  return body.position_m + body.rotation * edge_in_body_m(blade, angle_rad);
}

Matrix6d body_jacobian(const BladeKinematics& blade, const BodyPose& body, double angle_rad) {
  Matrix6d jacobian = Matrix6d::Identity();
  jacobian.topRightCorner<3, 3>() =
      -body.rotation * cross_matrix(edge_in_body_m(blade, angle_rad)) * body.rotation.transpose();
  return jacobian;
}

Vector6d blade_jacobian(const BladeKinematics& blade, const BodyPose& body, double angle_rad) {
  const Eigen::Vector2d rate = blade.edge_rate_mprad(angle_rad);
  Vector6d jacobian;
  jacobian << body.rotation * Eigen::Vector3d(rate.x(), 0.0, rate.y()),
      body.rotation * Eigen::Vector3d(0.0, -1.0, 0.0);
  return jacobian;
}

double joint_rate_radps(const BladeKinematics& blade, const BodyPose& body, double angle_rad,
                        const Vector6d& body_velocity, const Eigen::Vector3d& normal,
                        double wanted_mps) {
  Vector6d row = Vector6d::Zero();
  row.head<3>() = normal;
  const double lever_m = row.dot(blade_jacobian(blade, body, angle_rad));
  if (std::abs(lever_m) < kBladeLeastLever_m) {
    return 0.0;
  }
  const double carried_mps = row.dot(body_jacobian(blade, body, angle_rad) * body_velocity);
  return (wanted_mps - carried_mps) / lever_m;
}

}  // namespace graben
