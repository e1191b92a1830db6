// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr int kSteps = 8;

const SwingKinematics& machine_12t() {
  static const SwingKinematics kinematics(test::excavator_12t().profile.geometry);
  return kinematics;
}

const SwingKinematics& machine_22t() {
  static const SwingKinematics kinematics(test::excavator().profile.geometry);
  return kinematics;
}

/// Calls `check(machine, drive)` over a grid with every end of every stroke, all round.
template <class Check>
void over_the_whole_range(Check check) {
  for (const SwingKinematics* machine : {&machine_12t(), &machine_22t()}) {
    const auto& cylinder = machine->geometry().cylinder;
    for (int n = 0; n < (kSteps + 1) * (kSteps + 1) * (kSteps + 1); ++n) {
      const int i = n % (kSteps + 1);
      const int j = n / (kSteps + 1) % (kSteps + 1);
      const int k = n / ((kSteps + 1) * (kSteps + 1));
      check(*machine,
            DriveVector(cylinder[kBoom].stroke_m * i / kSteps, cylinder[kArm].stroke_m * j / kSteps,
                        cylinder[kBucket].stroke_m * k / kSteps, 3.0 * std::sin(1.7 * n)));
    }
  }
}

double theta_deg(int drive, double stroke_m) {
  DriveVector value = DriveVector::Zero();
  value[drive] = stroke_m;
  const DriveResult joints = machine_12t().joints_from_drive(value);
  assert_int_equal(joints.blind.kind, BlindKind::kNone);
  return joints.value[drive] / kDegree;
}

/// Section 3.2.2 at the stroke ends. At 2.400 m (6) gives 71.570 deg; what is printed, 68.810,
/// belongs to 2.387 m.
TEST(angle_ranges_of_the_paper) {
  assert_near(theta_deg(kBoom, 0.0), -45.179, 0.001);
  assert_near(theta_deg(kBoom, 0.950), 71.570, 0.001);
  assert_near(theta_deg(kBoom, 2.387 - 1.450), 68.810, 0.1);
  assert_near(theta_deg(kArm, 0.0), -29.760, 0.1);
  assert_near(theta_deg(kArm, 1.130), -149.206, 0.1);
  assert_near(theta_deg(kBucket, 0.0), 35.1927, 0.1);
  assert_near(theta_deg(kBucket, 0.875), -147.425, 0.1);
}

/// (6) as printed, over the boom's stroke, from the figures of the paper and not from the pins.
TEST(boom_angle_is_the_paper_s_formula) {
  for (double stroke_m = 0.0; stroke_m <= 0.950; stroke_m += 0.05) {
    const double length_m = 1.450 + stroke_m;
    const double cosine =
        (0.560 * 0.560 + 1.922 * 1.922 - length_m * length_m) / (2.0 * 0.560 * 1.922);
    assert_near(theta_deg(kBoom, stroke_m), std::acos(cosine) / kDegree - 28.208 - 44.714, 1e-4);
  }
}

/// One Denavit-Hartenberg row: turn about z, along z, along x, turn about x.
Eigen::Isometry3d row(double theta_rad, double d_m, double a_m, double alpha_rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(theta_rad, Eigen::Vector3d::UnitZ())) *
         Eigen::Translation3d(a_m, 0.0, d_m) *
         Eigen::Isometry3d(Eigen::AngleAxisd(alpha_rad, Eigen::Vector3d::UnitX()));
}

/// (1): the product of the rows; its last column is the position of (2), its x axis points from
/// the bucket pin to the teeth.
TEST(teeth_are_where_the_rows_put_them) {
  over_the_whole_range([](const SwingKinematics& machine, const DriveVector& drive) {
    const ExcavatorGeometry& links = machine.geometry();
    const DriveVector q = machine.joints_from_drive(drive).value;
    const Eigen::Isometry3d t =
        row(q[kSwing], links.boom_foot_m.y(), links.boom_foot_m.x(), 0.5 * kPi) *
        row(q[kBoom], 0.0, links.boom_length_m, 0.0) * row(q[kArm], 0.0, links.arm_length_m, 0.0) *
        row(q[kBucket], 0.0, links.bucket_length_m, 0.0);
    const TeethPose teeth = machine.teeth_from_joints(q);
    assert_true((teeth.position_m - t.translation()).norm() < 1e-12);
    const Eigen::Vector3d to_pin(std::cos(teeth.attitude_rad) * std::cos(q[kSwing]),
                                 std::cos(teeth.attitude_rad) * std::sin(q[kSwing]),
                                 std::sin(teeth.attitude_rad));
    assert_true((to_pin + t.linear().col(0)).norm() < 1e-12);
  });
}

/// Bent over backwards the machine would face away from its teeth.
bool faces_its_teeth(const SwingKinematics& machine, const DriveVector& drive) {
  const DriveVector joints = machine.joints_from_drive(drive).value;
  const TeethPose teeth = machine.teeth_from_joints({joints[0], joints[1], joints[2], 0.0});
  return teeth.position_m.x() > kLeastSwingRadius_m;
}

TEST(drives_to_teeth_and_back) {
  int count = 0;
  over_the_whole_range([&](const SwingKinematics& machine, const DriveVector& drive) {
    if (!faces_its_teeth(machine, drive)) {
      return;
    }
    const DriveResult joints = machine.joints_from_drive(drive);
    const DriveResult back = machine.drive_from_teeth(machine.teeth_from_joints(joints.value));
    assert_int_equal(back.blind.kind, BlindKind::kNone);
    assert_true((back.value - drive).cwiseAbs().maxCoeff() < 1e-9);
    ++count;
  });
  assert_true(count > 1000);
}

/// (4) as printed against joints that are known: theta_1 and theta_2 come out, theta_3 does not,
/// not even with every k_3; with +xi - pi it does.
TEST(the_printed_theta_3_is_not_the_joint) {
  const ExcavatorGeometry& links = machine_12t().geometry();
  const DriveVector q(0.3, -1.2, -0.2, 0.4);
  const TeethPose teeth = machine_12t().teeth_from_joints(q);
  const double xi = teeth.attitude_rad;
  const double across =
      teeth.position_m.head<2>().norm() + links.bucket_length_m * std::cos(xi) - 0.14;
  const double up = teeth.position_m.z() + links.bucket_length_m * std::sin(xi) - 1.424;
  const double l13 = std::hypot(across, up);
  const auto angle = [](double a, double b, double opposite) {
    return std::acos((a * a + b * b - opposite * opposite) / (2.0 * a * b));
  };
  const double beta = std::atan2(up, across);
  const double t1 = angle(links.boom_length_m, l13, links.arm_length_m);
  const double t2 = angle(links.boom_length_m, links.arm_length_m, l13);
  const double t3 = angle(links.arm_length_m, l13, links.boom_length_m);
  assert_near(wrap_near(t1 + beta, 0.0), q[kBoom], 1e-12);
  assert_near(wrap_near(kPi + t2, 0.0), q[kArm], 1e-12);
  assert_true(std::abs(wrap_near(t3 - beta - xi - q[kBucket], 0.0)) > 0.1);
  assert_near(wrap_near(t3 - beta + xi - kPi, 0.0), q[kBucket], 1e-12);
}

BlindSpot spot(double x_m, double y_m, double z_m, double attitude_rad) {
  return machine_12t().drive_from_teeth({{x_m, y_m, z_m}, attitude_rad}).blind;
}

void assert_spot(const BlindSpot& spot, BlindKind kind, int drive) {
  assert_int_equal(spot.kind, kind);
  assert_int_equal(spot.drive, drive);
}

TEST(what_can_t_be_had_names_its_joint) {
  assert_spot(spot(6.0, 3.0, 0.0, 2.0), BlindKind::kNone, kBoom);
  assert_spot(spot(9.0, 0.0, 0.0, 2.0), BlindKind::kOutOfReach, kArm);
  assert_spot(spot(0.01, 0.01, -2.0, 2.0), BlindKind::kSingular, kSwing);
  assert_spot(spot(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 2.0), BlindKind::kNotFinite,
              kBoom);
  const auto at = [](double boom, double arm, double bucket) {
    return machine_12t().drive_from_joints({boom, arm, bucket, 0.0}).blind;
  };
  assert_spot(at(-0.85, -1.2, -0.7), BlindKind::kStrokeEnd, kBoom);
  assert_true(at(-0.85, -1.2, -0.7).stroke_m < 0.0);
  assert_spot(at(1.30, -1.2, -0.7), BlindKind::kStrokeEnd, kBoom);
  assert_true(at(1.30, -1.2, -0.7).stroke_m > 0.950);
  assert_spot(at(-1.4, -1.2, -0.7), BlindKind::kDeadCentre, kBoom);
  assert_spot(at(0.3, -0.4, -0.7), BlindKind::kStrokeEnd, kArm);
  assert_spot(at(0.3, -1.2, 0.7), BlindKind::kStrokeEnd, kBucket);
  assert_spot(at(0.3, -1.2, 1.0), BlindKind::kLinkageOpen, kBucket);
  assert_spot(machine_12t().joints_from_drive({0.5, 1.2, 0.4, 0.0}).blind, BlindKind::kStrokeEnd,
              kArm);
}

/// A machine whose strokes reach farther than any: what is left are the levers.
TEST(a_vanished_lever_names_its_joint) {
  ExcavatorGeometry geometry = machine_12t().geometry();
  // So that the arm's cylinder lets it stretch out.
  geometry.cylinder[kArm].eye_m = {-0.5, 0.4};
  for (CylinderGeometry& cylinder : geometry.cylinder) {
    cylinder.stroke_m = 10.0;
    cylinder.closed_length_m = 0.0;
  }
  const SwingKinematics long_strokes(geometry);
  const auto moved_at = [&](double boom, double arm, double bucket) {
    const TeethPose teeth = long_strokes.teeth_from_joints({boom, arm, bucket, 0.2});
    return long_strokes.motion_from_teeth(teeth, {{0.1, 0.2, 0.3}, 0.1}, {}, 0.0).blind;
  };
  assert_spot(moved_at(0.3, -1.2, -0.7), BlindKind::kNone, kBoom);
  assert_spot(moved_at(0.3, -1e-5, -0.7), BlindKind::kSingular, kArm);
  // A, B and C in one line: 44.714 deg below, 28.208 deg above.
  assert_spot(moved_at(-(44.714 + 28.208) * kDegree + 1e-4, -0.3, -0.3), BlindKind::kSingular,
              kBoom);
}

/// A curve through space, its derivatives by hand, the drives' by differences.
struct Curve {
  TeethPose at(double s) const {
    return {{4.0 + 1.5 * s - 0.4 * s * s, 2.0 - 1.1 * s + 0.9 * s * s, 0.3 - 0.8 * s + 0.5 * s * s},
            1.9 - 0.5 * s + 0.3 * s * s};
  }
  TeethPose rate(double s) const {
    return {{1.5 - 0.8 * s, -1.1 + 1.8 * s, -0.8 + 1.0 * s}, -0.5 + 0.6 * s};
  }
  TeethPose curvature() const { return {{-0.8, 1.8, 1.0}, 0.6}; }
};

TEST(derivatives_of_the_drives) {
  constexpr double kStep = 1e-4;
  const Curve curve;
  const auto motion = [&](double s) {
    return machine_12t().motion_from_teeth(curve.at(s), curve.rate(s), curve.curvature(), 0.0);
  };
  for (double s = 0.0; s <= 1.0; s += 0.05) {
    const DriveMotion here = motion(s);
    assert_int_equal(here.blind.kind, BlindKind::kNone);
    const DriveVector rate = (motion(s + kStep).value - motion(s - kStep).value) / (2.0 * kStep);
    const DriveVector bend = (motion(s + kStep).rate - motion(s - kStep).rate) / (2.0 * kStep);
    assert_true((here.rate - rate).cwiseAbs().maxCoeff() < 1e-6);
    assert_true((here.curvature - bend).cwiseAbs().maxCoeff() < 1e-6);
    const DriveVector direct = machine_12t().drive_from_teeth(curve.at(s)).value;
    assert_true((here.value - direct).cwiseAbs().maxCoeff() < 1e-12);
  }
}

/// The swing's value follows the path across the back of the machine.
TEST(swing_goes_on_behind_the_machine) {
  const TeethPose behind{{-5.0, -0.1, 0.0}, 2.0};
  const auto swing_near = [&](double near_rad) {
    return machine_12t().motion_from_teeth(behind, {}, {}, near_rad).value[kSwing];
  };
  assert_near(swing_near(3.1), kPi + std::atan(0.1 / 5.0), 1e-12);
  assert_near(swing_near(-3.1), -kPi + std::atan(0.1 / 5.0), 1e-12);
}
