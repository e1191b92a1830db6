// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <random>

#include "firmware/dozer/mobile_jacobian.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kStep_s = 1e-6;

struct Draw {
  BodyPose body;
  Vector6d velocity;
  double angle_rad = 0.0;
  double rate_radps = 0.0;
};

/// Any attitude in space, not only that of straight driving.
Draw draw(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Draw drawn;
  drawn.body.position_m = {unit(random) * 50.0, unit(random) * 50.0, unit(random) * 5.0};
  drawn.body.rotation = (Eigen::AngleAxisd(unit(random) * 3.0, Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(unit(random) * 0.5, Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(unit(random) * 0.5, Eigen::Vector3d::UnitX()))
                            .toRotationMatrix();
  for (int i = 0; i < 6; ++i) {
    drawn.velocity[i] = unit(random);
  }
  drawn.angle_rad = 0.15 + 0.3 * unit(random);
  drawn.rate_radps = 0.3 * unit(random);
  return drawn;
}

BodyPose moved(const BodyPose& body, const Vector6d& velocity, double step_s) {
  BodyPose then = body;
  then.position_m += step_s * velocity.head<3>();
  const Eigen::Vector3d turn = step_s * velocity.tail<3>();
  then.rotation =
      Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * body.rotation;
  return then;
}

/// (1), (4): J_V x_V-dot + J_m q_m-dot is how the edge really moves and turns.
TEST(it_is_the_edges_velocity) {
  const BladeKinematics blade(test::dozer().profile.blade);
  std::mt19937 random(1);
  for (int n = 0; n < 200; ++n) {
    const Draw drawn = draw(random);
    const Vector6d velocity = body_jacobian(blade, drawn.body, drawn.angle_rad) * drawn.velocity +
                              blade_jacobian(blade, drawn.body, drawn.angle_rad) * drawn.rate_radps;
    const auto edge_at = [&](double time_s) {
      return edge_in_world_m(blade, moved(drawn.body, drawn.velocity, time_s),
                             drawn.angle_rad + time_s * drawn.rate_radps);
    };
    const Eigen::Vector3d moved_mps = (edge_at(kStep_s) - edge_at(-kStep_s)) / (2.0 * kStep_s);
    assert_near((velocity.head<3>() - moved_mps).norm(), 0.0, 1e-7);
    const Eigen::Vector3d turned_radps =
        drawn.velocity.tail<3>() + drawn.body.rotation * Eigen::Vector3d(0, -drawn.rate_radps, 0);
    assert_near((velocity.tail<3>() - turned_radps).norm(), 0.0, 1e-12);
  }
}

/// (5): whatever the body does, the edge gets the velocity along the normal.
TEST(the_joint_gives_what_is_wanted) {
  const BladeKinematics blade(test::dozer().profile.blade);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const Draw drawn = draw(random);
    const Eigen::Vector3d normal =
        Eigen::Vector3d(0.3 * unit(random), 0.3 * unit(random), 1.0).normalized();
    const double wanted_mps = unit(random);
    const double rate_radps =
        joint_rate_radps(blade, drawn.body, drawn.angle_rad, drawn.velocity, normal, wanted_mps);
    const Vector6d velocity = body_jacobian(blade, drawn.body, drawn.angle_rad) * drawn.velocity +
                              blade_jacobian(blade, drawn.body, drawn.angle_rad) * rate_radps;
    assert_near(normal.dot(velocity.head<3>()), wanted_mps, 1e-12);
  }
}

TEST(without_a_lever_it_asks_for_nothing) {
  const BladeKinematics blade(test::dozer().profile.blade);
  const Vector6d still = Vector6d::Zero();
  assert_near(joint_rate_radps(blade, {}, 0.0, still, Eigen::Vector3d::UnitY(), 1.0), 0.0, 0.0);
}

/// Nose up is positive: a point ahead of the body rises.
TEST(pitch_is_nose_up) {
  assert_true((rotation_from_pitch(0.1) * Eigen::Vector3d::UnitX()).z() > 0.0);
  assert_near(rotation_from_pitch(0.7).determinant(), 1.0, 1e-12);
}
