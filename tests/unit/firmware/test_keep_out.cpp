// SPDX-License-Identifier: Apache-2.0
/// Boxes and cylinders against points all over the machine's parts: how far the nearest is.

#include "firmware/excavator/fences/keep_out.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/rounds.hpp"

constexpr int kPlaces = test::rounds(3000, 300);
constexpr double kFar_m = 1e3;
/// Points of a part in each direction.
constexpr int kPoints = 40;
/// What the raster and a cylinder's rim make of it, m.
constexpr double kExact_m = 3e-3;

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t().profile);
  return loaded;
}

/// Outside of the keep-out; inside the nearest way out, negative.
double distance_m(const Fence& fence, const Eigen::Vector3d& at_m) {
  const Eigen::Vector3d off = at_m - fence.centre_m;
  const double along_m = fence.normal.x() * off.x() + fence.normal.y() * off.y();
  const double across_m = fence.normal.x() * off.y() - fence.normal.y() * off.x();
  Eigen::Vector3d beyond(std::abs(along_m) - fence.half_m.x(),
                         std::abs(across_m) - fence.half_m.y(),
                         std::abs(off.z()) - fence.half_m.z());
  if (fence.shape == FenceShape::kCylinder) {
    beyond.x() = beyond.y() = off.head<2>().norm() - fence.half_m.x();
  }
  if (beyond.maxCoeff() <= 0.0) {
    return beyond.maxCoeff();
  }
  if (fence.shape == FenceShape::kCylinder) {
    beyond.y() = 0.0;
  }
  return beyond.cwiseMax(0.0).norm();
}

/// Least of a raster over the part.
double sampled_m(const Fence& fence, const MachineMotion& motion, MachinePart part) {
  const ExcavatorBody& body = machine().profile.geometry.body;
  const auto place = [&motion](MachinePoint point) { return motion.at(point).position_m; };
  double least_m = kFar_m;
  const auto patch = [&](const Eigen::Vector3d& corner_m, const Eigen::Vector3d& one_m,
                         const Eigen::Vector3d& other_m, double radius_m, bool half) {
    for (int i = 0; i <= kPoints; ++i) {
      for (int k = 0; k <= (half ? kPoints - i : kPoints); ++k) {
        const Eigen::Vector3d at_m = corner_m + (i * one_m + k * other_m) / kPoints;
        least_m = std::min(least_m, distance_m(fence, at_m) - radius_m);
      }
    }
  };
  const auto link = [&](MachinePoint from, MachinePoint to, double radius_m) {
    patch(place(from), place(to) - place(from), Eigen::Vector3d::Zero(), radius_m, false);
  };
  const Counterweight& weight = body.counterweight;
  switch (part) {
    case MachinePart::kBucketPart: {
      const Eigen::Vector3d left_m =
          place(MachinePoint::kEdgeLeft) - place(MachinePoint::kEdgeRight);
      const Eigen::Vector3d edge_m = place(MachinePoint::kEdgeRight);
      const Eigen::Vector3d heel_m = place(MachinePoint::kHeelRight);
      const Eigen::Vector3d pin_m = place(MachinePoint::kBucketPin) - 0.5 * left_m;
      for (int i = 0; i <= 10; ++i) {
        patch(edge_m + 0.1 * i * left_m, heel_m - edge_m, pin_m - edge_m, 0.0, true);
      }
      patch(edge_m, heel_m - edge_m, left_m, 0.0, false);
      patch(edge_m, pin_m - edge_m, left_m, 0.0, false);
      patch(heel_m, pin_m - heel_m, left_m, 0.0, false);
      break;
    }
    case MachinePart::kArmPart:
      link(MachinePoint::kArmPin, MachinePoint::kBucketPin, body.arm_radius_m);
      break;
    case MachinePart::kBoomFootPart:
      link(MachinePoint::kBoomFoot, MachinePoint::kBoomBend, body.boom_radius_m);
      break;
    case MachinePart::kBoomEndPart:
      link(MachinePoint::kBoomBend, MachinePoint::kArmPin, body.boom_radius_m);
      break;
    case MachinePart::kTailPart: {
      const Eigen::Vector3d tail_m = place(MachinePoint::kTailLeft);
      patch(tail_m, place(MachinePoint::kTailRight) - tail_m,
            (weight.high_m - weight.low_m) * Eigen::Vector3d::UnitZ(), weight.corner_m, false);
      break;
    }
  }
  return least_m;
}

Fence random_keep_out(plant::Random& random) {
  Fence fence;
  fence.shape = random.uniform() < 0.5 ? FenceShape::kBox : FenceShape::kCylinder;
  const double turn_rad = random.symmetric(3.1);
  fence.normal = {std::cos(turn_rad), std::sin(turn_rad), 0.0};
  fence.centre_m = {random.symmetric(7.0), random.symmetric(7.0), random.symmetric(4.0)};
  fence.half_m = {0.1 + 1.5 * random.uniform(), 0.1 + 1.5 * random.uniform(),
                  0.1 + 1.5 * random.uniform()};
  if (fence.shape == FenceShape::kCylinder) {
    fence.half_m.y() = fence.half_m.x();
  }
  return fence;
}

FenceGap gap(const Fence& fence, const MachineMotion& motion, MachinePart part,
             double far_m = kFar_m) {
  return keep_out_gap(fence, machine().profile.geometry.body, motion, part, far_m);
}

/// Never more than it is, and not much less.
TEST(no_distance_is_told_too_large) {
  double shortest_m = 0.0;
  int near = 0;
  for (std::uint64_t seed = 0; seed < kPlaces; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const MachineMotion motion = machine().points(machine().random_drive(random));
    const Fence fence = random_keep_out(random);
    for (int part = 0; part < kMachinePartCount; ++part) {
      const double told_m = gap(fence, motion, static_cast<MachinePart>(part)).distance_m;
      const double true_m = sampled_m(fence, motion, static_cast<MachinePart>(part));
      assert_true(told_m <= true_m + 1e-9);
      if (true_m > 0.0) {
        assert_true(told_m >= true_m - kExact_m);
        shortest_m = std::max(shortest_m, true_m - told_m);
        near += true_m < 1.5 ? 1 : 0;
      }
    }
  }
  print_message("told at most %.1f mm too short; %d near\n", 1e3 * shortest_m, near);
  assert_true(near > kPlaces / 4);
}

/// Never slower than the distance falls, and mostly as fast: where the plane between both is a face
/// of the bucket it turns with it.
TEST(it_closes_as_fast_as_the_distance_falls) {
  constexpr double kStep_s = 1e-6;
  int compared = 0;
  int alike = 0;
  int faster = 0;
  for (std::uint64_t seed = 0; seed < kPlaces; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector drive = machine().random_drive(random, -0.01);
    DriveVector velocity;
    for (int i = 0; i < kDriveCount; ++i) {
      velocity[i] = random.symmetric(1.0);
    }
    const Fence fence = random_keep_out(random);
    const MachineMotion here = machine_motion(machine().kinematics, drive, velocity);
    const MachineMotion ahead = machine().points(drive + kStep_s * velocity);
    for (int part = 0; part < kMachinePartCount; ++part) {
      const FenceGap now = gap(fence, here, static_cast<MachinePart>(part));
      const FenceGap then = gap(fence, ahead, static_cast<MachinePart>(part));
      const double falls_mps = (now.distance_m - then.distance_m) / kStep_s;
      faster += falls_mps > now.closing_mps + 1e-2 ? 1 : 0;
      ++compared;
      alike += std::abs(falls_mps - now.closing_mps) < 1e-2 ? 1 : 0;
    }
  }
  print_message("%d of %d alike, %d faster\n", alike, compared, faster);
  // Where an edge is nearest is known to some millimetres only.
  assert_true(faster < compared / 200);
  assert_true(alike > compared * 3 / 4);
}

/// By hand: the teeth 0.5 m from a box's face, then over its corner.
TEST(faces_and_corners) {
  const DriveVector drive(0.475, 0.565, 0.4375, 0.0);
  const MachineMotion motion = machine().points(drive);
  double lowest_m = kFar_m;
  for (const MachinePoint point : {MachinePoint::kEdgeLeft, MachinePoint::kHeelLeft}) {
    lowest_m = std::min(lowest_m, motion.at(point).position_m.z());
  }
  Fence box;
  box.shape = FenceShape::kBox;
  box.normal = Eigen::Vector3d::UnitX();
  box.half_m = {20.0, 20.0, 1.0};
  box.centre_m = {0.0, 0.0, lowest_m - 1.5};
  assert_near(gap(box, motion, MachinePart::kBucketPart).distance_m, 0.5, 1e-12);
  // To the left of the bucket by 0.3 and below it by 0.4 m: 0.5 m.
  box.centre_m = {0.0, 0.5 + 0.3 + 20.0, lowest_m - 1.4};
  assert_near(gap(box, motion, MachinePart::kBucketPart).distance_m, 0.5, 1e-3);
  // Far away it may be told nearer, but no nearer than that.
  assert_true(gap(box, motion, MachinePart::kBucketPart, 0.2).distance_m >= 0.2);
}
