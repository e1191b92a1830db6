// SPDX-License-Identifier: Apache-2.0
// The simulated dozer on a track that curves: its place beside the track, and how it turns.

#include "app/plant/dozer_plant.hpp"

#include <vector>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kRadius_m = 20.0;

/// Straight to x = 5 m, then a curve to the left.
struct Curved {
  Curved() {
    constexpr int kCount = 1001;
    for (int i = 0; i < kCount; ++i) {
      height.push_back(0.0);
      cross.push_back(0.0);
      curvature.push_back(i * GradeHeights::kStep_m < 5.0 - 1e-9 ? 0.0 : 1.0 / kRadius_m);
    }
    profile = machines::load_simulated_dozer(machines::find_profile("dozer_9t_tilt")).plant;
    profile.machine.grade.count = 0;
    profile.machine.grade.heights = {height.data(), cross.data(), kCount, 0.0, curvature.data()};
  }
  std::vector<double> height;
  std::vector<double> cross;
  std::vector<double> curvature;
  DozerPlantProfile profile;
};

const Curved& curved() {
  static const Curved all;
  return all;
}

/// The centre of the circle is kRadius_m to the left of x = 5 m, but for half a step of the grid.
TEST(places_are_beside_the_track) {
  const PlanTrack track(curved().profile.machine.grade.heights);
  const Eigen::Vector2d centre_m(4.975, kRadius_m);
  for (const double station_m : {8.0, 20.0, 45.0}) {
    for (const double offset_m : {-1.5, 0.0, 1.5}) {
      const Eigen::Vector2d at_m = track.at_m({station_m, offset_m});
      assert_near((at_m - centre_m).norm(), kRadius_m - offset_m, 1e-3);
      const PlanPlace again = track.place_of(at_m, station_m - 2.0);
      assert_near(again.station_m, station_m, 1e-6);
      assert_near(again.offset_m, offset_m, 1e-6);
    }
  }
  assert_near(track.direction_rad(25.0), (25.0 - 4.975) / kRadius_m, 1e-6);
  // Straight before it and behind it.
  assert_near(track.at_m({-3.0, 0.5}).y(), 0.5, 1e-12);
  assert_near(track.direction_rad(60.0), track.direction_rad(50.0), 1e-12);
}

/// Driven straight on it leaves the track; with the outer track faster it turns, less than it would
/// if nothing slipped.
TEST(it_turns_as_its_tracks_push) {
  DozerPlant plant(curved().profile);
  plant.set_brake(false);
  plant.set_displacements({0.5, 0.5}, {1.0, 1.0});
  plant.advance(4 * kSecondUs);
  assert_near(plant.plan()->yaw_rate_radps(), 0.0, 1e-9);
  plant.set_displacements({0.45, 0.55}, {1.0, 1.0});
  plant.advance(3 * kSecondUs);
  const auto tracks_mps = plant.track_speeds_mps();
  const double free_radps = (tracks_mps[kRight] - tracks_mps[kLeft]) / 1.8;
  assert_true(plant.plan()->yaw_rate_radps() < 0.95 * free_radps);
  assert_true(plant.plan()->yaw_rate_radps() > 0.5 * free_radps);
  assert_true(plant.slips()[kRight] > plant.slips()[kLeft]);
}

/// Turned a little and led to no side, the station goes on by the cosine, the offset by the sine.
TEST(a_way_is_along_and_across) {
  PlanMotion motion(curved().profile);
  // Half a second at rest with a push turns it.
  repeat(1000, [&] { motion.step(60e3, 0.0, 87e3, 0.0, -5.0, 0.0005); });
  const double heading_rad = motion.heading_rad();
  assert_true(heading_rad > 0.01);
  assert_near(motion.offset_m(), 0.0, 0.0);
  PlanMotion still(curved().profile);
  repeat(1000, [&] { still.step(0.0, 0.0, 87e3, 1.0, 10.0, 0.0005); });
  // It goes straight on, so that the track turns away from it.
  assert_near(still.heading_rad(), -0.5 / kRadius_m, 1e-3);
  assert_near(still.offset_m(), -0.5 * 0.5 * 0.5 / kRadius_m, 1e-3);
  assert_near(still.station_share(10.0),
              std::cos(still.heading_rad()) / (1.0 - still.offset_m() / kRadius_m), 1e-9);
}

/// What it cuts lies where the edge's points are against the track.
TEST(its_edge_cuts_lines_beside_the_track) {
  DozerPlant plant(curved().profile);
  const Eigen::Vector3d left_m = plant.edge_point_m(1.0);
  assert_near(left_m.y(), 1.0, 1e-6);
  plant.set_blade_duty(0.5, true);
  plant.advance(300 * kMillisecondUs);
  plant.set_blade_duty(0.0, false);
  plant.set_brake(false);
  plant.set_displacements({0.5, 0.5}, {1.0, 1.0});
  plant.advance(25 * kSecondUs);
  const Eigen::Vector3d middle_m = plant.edge_point_m(0.0);
  // Straight on, to the right of a track that turns left.
  assert_true(middle_m.x() > 5.5);
  assert_near(
      middle_m.y(),
      kRadius_m - std::hypot(kRadius_m, kRadius_m * std::tan((middle_m.x() - 4.975) / kRadius_m)),
      0.01);
  const CrossGround& ground = *plant.cross_ground();
  assert_true(ground.line[CrossGround::kLeftTrack].height_m(middle_m.x() - 0.3) < -0.005);
}
