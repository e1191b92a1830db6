// SPDX-License-Identifier: Apache-2.0
#include "tests/margins/linkage_on_oil.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "app/plant/cylinder.hpp"
#include "app/plant/linkage_geometry.hpp"

namespace graben::margins {
namespace {

constexpr double kCycle_s = 0.01;
constexpr double kTwoPi = 6.283185307179586;
/// Of the viscous friction: a machine as found may have so little of it.
constexpr double kFrictionLeft = 0.5;

/// Over the orifices of a drive, in and out.
constexpr double kDrop_pa = 5e6;

/// Places in the state: of three axes, then of the two spools.
constexpr int kStroke = 0;
constexpr int kSpeed = 3;
constexpr int kFlowed = 6;
constexpr int kFiltered = 9;
constexpr int kFlow = 12;
constexpr int kFlowRate = 14;
constexpr int kStates = 16;

/// M by the joint angles, from what each turn does to each mass centre.
Eigen::Matrix3d joint_inertia_kgm2(const plant::ExcavatorPlantProfile& machine,
                                   const plant::JointArray& angle_rad) {
  const std::array<double, kAxisCount> length_m = {machine.machine.geometry.boom_length_m,
                                                   machine.machine.geometry.arm_length_m, 0.0};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::array<Eigen::Vector2d, kAxisCount> pin_m;
  Eigen::Vector2d next_m = Eigen::Vector2d::Zero();
  double direction_rad = 0.0;
  for (unsigned link = 0; link < kAxisCount; ++link) {
    direction_rad += angle_rad[link];
    pin_m[link] = next_m;
    const Eigen::Rotation2Dd turn(direction_rad);
    const plant::LinkBody& body = machine.link[link];
    const Eigen::Vector2d centre_m = next_m + turn * body.mass_centre_m;
    Eigen::Matrix<double, 2, 3> moves = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::RowVector3d turns = Eigen::RowVector3d::Zero();
    for (unsigned joint = 0; joint <= link; ++joint) {
      moves.col(joint) = plant::turned(centre_m - pin_m[joint]);
      turns[joint] = 1.0;
    }
    inertia +=
        body.mass_kg * moves.transpose() * moves + body.inertia_kgm2 * turns.transpose() * turns;
    next_m += turn * Eigen::Vector2d(length_m[link], 0.0);
  }
  return inertia;
}

plant::JointArray as_array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// w' and p' of an axis that gives way by `give_mpsn`; p in kForceUnit_n.
template <class Rate>
void give_way(double give_mpsn, double filter_s, double spring_npm, int axis, Rate& rate) {
  rate(kFlowed + axis, kFlowed + axis) = -give_mpsn * spring_npm;
  rate(kFlowed + axis, kStroke + axis) = give_mpsn * spring_npm;
  rate(kFlowed + axis, kFiltered + axis) = give_mpsn * kForceUnit_n;
  rate(kFiltered + axis, kFlowed + axis) = spring_npm / kForceUnit_n / filter_s;
  rate(kFiltered + axis, kStroke + axis) = -spring_npm / kForceUnit_n / filter_s;
  rate(kFiltered + axis, kFiltered + axis) = -1.0 / filter_s;
}

/// The duty arrives so many cycles after it was given.
Discrete delayed(const Discrete& system, int cycles) {
  const Eigen::Index states = system.a.rows();
  const Eigen::Index inputs = system.b.cols();
  const Eigen::Index held = inputs * cycles;
  if (cycles == 0) {
    return system;
  }
  Discrete late;
  late.a = Eigen::MatrixXd::Zero(states + held, states + held);
  late.a.topLeftCorner(states, states) = system.a;
  late.a.block(0, states, states, inputs) = system.b;
  // What was given last stands at the end and moves up.
  late.a.block(states, states + inputs, held - inputs, held - inputs).setIdentity();
  late.b = Eigen::MatrixXd::Zero(states + held, inputs);
  late.b.bottomRows(inputs).setIdentity();
  late.c = Eigen::MatrixXd::Zero(system.c.rows(), states + held);
  late.c.leftCols(states) = system.c;
  late.d = system.d;
  return late;
}

}  // namespace

Eigen::Matrix3d inertia_kg(const plant::ExcavatorPlantProfile& machine,
                           const Eigen::Vector3d& strokes_m, double mass_ratio) {
  const plant::LinkageGeometry geometry(machine.machine.geometry);
  const plant::JointArray angle_rad = geometry.angles_at(as_array(strokes_m));
  const auto lever = geometry.levers(plant::rotations_of(angle_rad));
  Eigen::Vector3d turn_radpm;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    turn_radpm[i] = 1.0 / lever[i].stroke_per_angle_m;
  }
  return mass_ratio * (turn_radpm.asDiagonal() * joint_inertia_kgm2(machine, angle_rad) *
                       turn_radpm.asDiagonal());
}

Eigen::Vector3d stiffness_npm(const plant::ExcavatorPlantProfile& machine,
                              const Eigen::Vector3d& strokes_m, double bulk_modulus_pa) {
  Eigen::Vector3d stiffness;
  for (int i = 0; i < kAxisCount; ++i) {
    const plant::CylinderData data = machine.cylinder(i);
    const double cap_m3 = data.dead_volume_m3 + data.area.cap_m2 * strokes_m[i];
    const double rod_m3 = data.dead_volume_m3 + data.area.rod_m2 * (data.stroke_m - strokes_m[i]);
    stiffness[i] = bulk_modulus_pa * (data.area.cap_m2 * data.area.cap_m2 / cap_m3 +
                                      data.area.rod_m2 * data.area.rod_m2 / rod_m3);
  }
  return stiffness;
}

Eigen::Vector3d modes_hz(const plant::ExcavatorPlantProfile& machine,
                         const Eigen::Vector3d& strokes_m, const Truth& truth) {
  const Eigen::Matrix3d spring =
      stiffness_npm(machine, strokes_m, truth.bulk_modulus_pa).asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      spring, inertia_kg(machine, strokes_m, truth.mass_ratio));
  return solver.eigenvalues().cwiseSqrt() / kTwoPi;
}

Discrete linkage_on_oil(const plant::ExcavatorPlantProfile& machine,
                        const Eigen::Vector3d& strokes_m, const Truth& truth) {
  const Eigen::Matrix3d inverse = inertia_kg(machine, strokes_m, truth.mass_ratio).inverse();
  const Eigen::Vector3d spring_npm = stiffness_npm(machine, strokes_m, truth.bulk_modulus_pa);
  Eigen::Matrix<double, kStates + 2, kStates + 2> rate;
  rate.setZero();
  rate.block<3, 3>(kStroke, kSpeed).setIdentity();
  rate.block<3, 3>(kSpeed, kStroke) = -inverse * spring_npm.asDiagonal();
  rate.block<3, 3>(kSpeed, kFlowed) = inverse * spring_npm.asDiagonal();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double friction_nspm =
        kFrictionLeft * machine.friction[static_cast<unsigned>(axis)].viscous_nspm;
    rate.block<3, 1>(kSpeed, kSpeed + axis) = -friction_nspm * inverse.col(axis);
    give_way(truth.speed_mps / (2.0 * machine.cylinder(axis).area.cap_m2 * kDrop_pa),
             machine.machine.control.pressure_filter_s, spring_npm[axis], axis, rate);
  }
  rate(kFlowed + kBucket, kFlowed + kBucket) -= machine.machine.control.servo_gain_ps;
  const double pull_ps = 1.0 / truth.spool_time_constant_s;
  for (int axis = 0; axis < 2; ++axis) {
    rate(kFlowed + axis, kFlow + axis) = 1.0;
    rate(kFlow + axis, kFlowRate + axis) = 1.0;
    rate(kFlowRate + axis, kFlow + axis) = -pull_ps * pull_ps;
    rate(kFlowRate + axis, kFlowRate + axis) = -2.0 * pull_ps;
    rate(kFlowRate + axis, kStates + axis) = pull_ps * pull_ps;
  }
  const Eigen::MatrixXd step = Eigen::MatrixXd(kCycle_s * rate).exp();
  Discrete system;
  system.a = step.topLeftCorner(kStates, kStates);
  system.b = step.topRightCorner(kStates, 2);
  system.c = Eigen::MatrixXd::Zero(4, kStates);
  for (int axis = 0; axis < 2; ++axis) {
    system.c(axis, kStroke + axis) = 1.0;
    system.c(2 + axis, kFlowed + axis) = spring_npm[axis] / kForceUnit_n;
    system.c(2 + axis, kStroke + axis) = -spring_npm[axis] / kForceUnit_n;
  }
  system.d = Eigen::MatrixXd::Zero(4, 2);
  return delayed(system, truth.late_cycles);
}

}  // namespace graben::margins
