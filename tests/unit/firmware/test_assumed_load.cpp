// SPDX-License-Identifier: Apache-2.0
// Loads of a machine whose pressures nobody measures: the links' weight, and the worst.

#include "firmware/excavator/estimation/load/assumed_load.hpp"

#include "app/machines/excavator_file.hpp"
#include "app/machines/profile_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"

const ExcavatorProfile& profile() {
  static const ExcavatorProfile machine =
      machines::load_excavator(machines::find_profile("excavator_22t")).profile;
  return machine;
}

KinematicState half_out() {
  Eigen::Vector3d strokes_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    strokes_m[i] = 0.5 * profile().geometry.cylinder[i].stroke_m;
  }
  return ExcavatorKinematics(profile().geometry).state(strokes_m);
}

TEST(the_boom_holds_all_links_up) {
  const auto load = links_alone(profile(), half_out());
  // Some 4 t at 3 m on two cylinders of 0.4 m lever.
  assert_true(load[kBoom].cap_pa > 3e6);
  assert_true(load[kBoom].cap_pa < 15e6);
  assert_near(load[kBoom].rod_pa, 0.0, 0.0);
  for (const LoadState& each : load) {
    assert_true(each.cap_pa == 0.0 || each.rod_pa == 0.0);
  }
  // By virtual work: what lifts the links by a little is the work of the boom's cylinder.
  ExcavatorProfile lighter = profile();
  for (LinkMass& link : lighter.oil.link) {
    link.mass_kg *= 0.5;
  }
  assert_near(links_alone(lighter, half_out())[kBoom].cap_pa, 0.5 * load[kBoom].cap_pa, 1.0);
}

TEST(without_a_pose_nothing_is_known) {
  KinematicState nowhere = half_out();
  nowhere.status = ReachStatus::kNotFinite;
  assert_near(links_alone(profile(), nowhere)[kBoom].cap_pa, 0.0, 0.0);
}

TEST(the_worst_pushes_against_what_is_wanted) {
  const DriveBank bank = excavator_bank(profile());
  const auto likely = links_alone(profile(), half_out());
  DriveVector wanted_mps = DriveVector::Zero();
  wanted_mps[kArm] = 0.1;
  wanted_mps[kBucket] = -0.1;
  const auto worst = worst_loads(profile(), bank.rows(), likely, wanted_mps);
  const double relief_pa = profile().pump[0].relief_pa;
  assert_near(worst[kArm].cap_pa, profile().bus.worst_load_ratio * relief_pa, 1.0);
  assert_near(worst[kBucket].rod_pa, profile().bus.worst_load_ratio * relief_pa, 1.0);
  assert_near(worst[kArm].rod_pa, 0.0, 0.0);
  // What is to stand keeps its weight.
  assert_near(worst[kBoom].cap_pa, likely[kBoom].cap_pa, 0.0);
}
