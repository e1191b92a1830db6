// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How boom and arm swing on the oil of their cylinders: inertia and stiffness in strokes, and the
/// two modes that they make. The bucket, whose mode is faster than both, counts as locked to the
/// arm.

#include <Eigen/Core>

#include "firmware/core/span.hpp"
#include "firmware/drives/drive_servo.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben {

/// What the bucket carries, by the force of the boom's cylinder at rest: 1.6 times what the links
/// do not weigh, since friction and transducers may hide a third of it; 0 .. 2000 kg, and 0 with
/// the bucket nearer than 2 m. `now` must be kOk.
[[nodiscard]] double payload_kg(const OilProfile& oil, const ExcavatorGeometry& geometry,
                                const KinematicState& now, double boom_force_n);

/// M of M l'' = F + f: kg, by the strokes of boom and arm; the payload lies in the bucket's centre.
/// `now` must be kOk.
[[nodiscard]] Eigen::Matrix2d stroke_inertia_kg(const OilProfile& oil,
                                                const ExcavatorGeometry& geometry,
                                                const KinematicState& now, double payload_kg);

/// Stiffness of both oil columns of an axis, N/m: beta (A_A^2 / V_A + A_B^2 / V_B). A chamber that
/// runs empty gives less and less of its share.
[[nodiscard]] double oil_column_npm(const OilProfile& oil, const CylinderGeometry& cylinder,
                                    double dead_volume_m3, double stroke_m, const LoadState& load);

/// Travels and speeds of boom and arm = shape * those of the modes; both are lengths, and each
/// column of `shape` is of length 1. Slower mode first.
struct OilModes {
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Identity();
  Eigen::Vector2d omega_radps = Eigen::Vector2d::Ones();
  Eigen::Vector2d stiffness_npm = Eigen::Vector2d::Ones();  ///< Of boom and arm.
};

/// K shape = M shape omega^2. `load` has the filtered pressures of boom and arm; the oil is
/// `stiffness_share` as stiff as the profile tells.
[[nodiscard]] OilModes oil_modes(const OilProfile& oil, const ExcavatorGeometry& geometry,
                                 const KinematicState& now, Span<const LoadState> load,
                                 double payload_kg, double stiffness_share);

}  // namespace graben
