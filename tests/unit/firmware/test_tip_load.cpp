// SPDX-License-Identifier: Apache-2.0
// Tip force and payload by pressures: a machine on paper, whose forces come from its potential
// energy.

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/load_world.hpp"

using test::LoadWorld;

constexpr TipPose kHigh = {7.0, 0.7, 1.9};
constexpr TipPose kOut = {7.8, -0.6, 2.1};
constexpr TipPose kLow = {5.2, -0.9, 0.4};
constexpr TipPose kLifted = {5.6, 2.0, 0.3};

/// There and back, the opening down: both signs of friction are seen.
void wave_empty(LoadWorld& world) {
  for (int n = 0; n < 3; ++n) {
    world.move(StepKind::kReturnToDig, kHigh, kOut, 6.0);
    world.move(StepKind::kReturnToDig, kOut, kHigh, 6.0);
  }
  world.stand(StepKind::kReturnToDig, kHigh, 0.5);
}

void lift(LoadWorld& world, double load_kg) {
  world.load_kg = load_kg;
  world.move(StepKind::kLift, kLow, kLifted, 8.0);
}

TEST(force_at_rest) {
  for (const Eigen::Vector2d& force_n :
       {Eigen::Vector2d(30e3, 0.0), Eigen::Vector2d(0.0, 20e3), Eigen::Vector2d(25e3, -15e3)}) {
    LoadWorld world;
    wave_empty(world);
    world.teeth_n = force_n;
    // At a dig's begin the bucket is empty.
    const Eigen::Vector3d strokes_m = world.strokes_at(kLow);
    repeat(100, [&] { world.cycle(StepKind::kDig, 0.0, strokes_m, Eigen::Vector3d::Zero()); });
    const TipLoad& told = world.told();
    assert_true(told.known);
    assert_false(told.payload_known);
    assert_true((told.force_n - force_n).norm() < 0.03 * force_n.norm());
    assert_true(told.force_sd_n > 200.0 && told.force_sd_n < 2e3 + 0.3 * force_n.norm());
  }
}

TEST(a_late_cycle_is_as_long_as_it_is, LoadWorld late) {
  late.stand(StepKind::kDig, kLow, 0.5);
  late.teeth_n = {20e3, 0.0};
  LoadWorld in_time = late;
  const Eigen::Vector3d strokes_m = late.strokes_at(kLow);
  late.elapsed_s = 0.05;
  late.cycle(StepKind::kDig, 0.0, strokes_m, Eigen::Vector3d::Zero());
  repeat(5, [&] { in_time.cycle(StepKind::kDig, 0.0, strokes_m, Eigen::Vector3d::Zero()); });
  const Eigen::Vector3d& seen_n = in_time.observer.filter.force_n.value;
  assert_true(seen_n.norm() > 5e3);
  assert_true((late.observer.filter.force_n.value - seen_n).norm() < 1e-6);
}

// What is off is learnt in the air; the load is then known through it all.
TEST(payload_with_all_that_is_off, LoadWorld world) {
  world.offset_n = {15e3, -6e3, 4e3};
  world.coulomb_n = {5e3, 2.5e3, 3e3};
  world.mass_factor = {1.1, 0.92, 1.08};
  wave_empty(world);
  assert_true(world.told().payload_known);
  assert_near(world.told().payload_kg, 0.0, 10.0);
  for (const double load_kg : {1200.0, 300.0}) {
    lift(world, load_kg);
    const TipLoad& told = world.told();
    assert_true(told.payload_known);
    assert_true(told.payload_sd_kg > 2.0 && told.payload_sd_kg < 60.0);
    assert_true(std::abs(told.payload_kg - load_kg) < 2.0 * told.payload_sd_kg);
    assert_near(told.payload_kg, load_kg, 35.0);
    world.load_kg = 0.0;
    wave_empty(world);
  }
}

// Without a move in the air the deviation says how little is known, and holds.
TEST(nothing_learnt_yet, LoadWorld world) {
  world.offset_n = {9e3, -4e3, 3e3};
  lift(world, 1000.0);
  const TipLoad& told = world.told();
  assert_true(told.payload_known);
  assert_true(told.payload_sd_kg > 100.0);
  assert_true(std::abs(told.payload_kg - 1000.0) < 3.0 * told.payload_sd_kg);
}

TEST(friction_is_learnt, LoadWorld world) {
  world.coulomb_n = {7e3, 1e3, 2e3};
  world.viscous_nspm = {35e3, 20e3, 15e3};
  wave_empty(world);
  const LoadTerms& terms = world.observer.terms;
  for (const int axis : {kBoom, kArm}) {
    const int term = kCoulombTerm + axis;
    const double off_n = terms.value[static_cast<unsigned>(term)] - world.coulomb_n[axis];
    assert_true(std::abs(off_n) < 1500.0);
    assert_true(std::abs(off_n) < 2.0 * std::sqrt(terms.variance(term)));
  }
  assert_near(terms.value[kOffsetTerm + kBoom], 0.0, 2.5e3);
}

void same_terms(const LoadTerms& a, const LoadTerms& b) {
  for (unsigned i = 0; i < kLoadTerm; ++i) {
    assert_true(a.value[i] == b.value[i]);
    assert_true(a.variance(static_cast<int>(i)) == b.variance(static_cast<int>(i)));
  }
}

// In the ground, standing on it, by hand, held by something: no offset is learnt.
TEST(held_is_not_learnt) {
  constexpr TipPose kOnGround = {6.5, -1.74, 2.0};
  for (const StepKind kind : {StepKind::kApproach, StepKind::kReturnToDig, StepKind::kDig,
                              StepKind::kNone, StepKind::kDone}) {
    LoadWorld world;
    wave_empty(world);
    const LoadTerms before = world.observer.terms;
    world.teeth_n = {4e3, 12e3};
    world.stand(kind, kOnGround, 4.0);
    same_terms(before, world.observer.terms);
  }
  // Drawn over the ground before anything is learnt, when any force could be an offset.
  LoadWorld fresh;
  fresh.teeth_n = {-3e3, 6e3};
  fresh.move(StepKind::kApproach, {7.0, -1.6, 1.9}, {7.8, -1.6, 2.1}, 6.0);
  same_terms(terms_unseen(LoadWorld::machine()), fresh.observer.terms);
  LoadWorld world;
  wave_empty(world);
  world.teeth_n = {15e3, 40e3};  // far beyond what may be off
  // What was seen before is still learnt.
  world.stand(StepKind::kReturnToDig, kHigh, 0.2);
  const LoadTerms before = world.observer.terms;
  world.move(StepKind::kReturnToDig, kHigh, kOut, 6.0);
  same_terms(before, world.observer.terms);
  world.teeth_n.setZero();
  world.active = false;
  world.move(StepKind::kReturnToDig, kOut, kHigh, 6.0);
  same_terms(before, world.observer.terms);
}

// It goes back through what it has poured.
TEST(its_own_heap_is_not_learnt, LoadWorld world) {
  wave_empty(world);
  lift(world, 1200.0);
  world.load_kg = 0.0;
  world.stand(StepKind::kDump, kHigh, 2.0);
  world.stand(StepKind::kReturnToDig, kHigh, 2.0);
  const LoadTerms before = world.observer.terms;
  constexpr double kWithin_m = -1.2;  // over the boom foot: 0.55 m over the ground
  world.teeth_n = {-3e3, 8e3};
  world.move(StepKind::kReturnToDig, {7.0, kWithin_m, 1.9}, {7.6, kWithin_m, 2.0}, 4.0);
  same_terms(before, world.observer.terms);
  world.teeth_n.setZero();
  world.move(StepKind::kReturnToDig, {7.6, kWithin_m + 0.4, 2.0}, {7.0, kWithin_m + 0.4, 1.9}, 4.0);
  assert_true(world.observer.terms.variance(kOffsetTerm) < before.variance(kOffsetTerm));
}

// A heap has sides: beside them the empty bucket is free, and a bucket that was emptied stays so.
TEST(beside_its_heap_is_learnt, LoadWorld world) {
  wave_empty(world);
  lift(world, 1500.0);
  world.load_kg = 0.0;
  world.move(StepKind::kDump, kLifted, {8.4, -0.2, 1.95}, 4.0);
  world.stand(StepKind::kDump, {8.4, -0.2, 1.95}, 2.0);
  assert_true(world.observer.phase.heap_m > 0.8);
  const double before_n2 = world.observer.terms.variance(kOffsetTerm);
  constexpr TipPose kBeside = {6.3, -0.91, 1.4};  // lower than the heap's top, off its foot
  world.move(StepKind::kReturnToDig, kBeside, {6.2, -0.92, 1.3}, 3.0);
  assert_int_equal(world.observer.phase.phase, LoadPhase::kEmpty);
  assert_true(world.observer.terms.variance(kOffsetTerm) < before_n2);
}

// An arm that moves weighs as well as a boom, and what a jerk has taught is forgotten.
TEST(weighed_without_the_boom, LoadWorld world) {
  wave_empty(world);
  world.load_kg = 1100.0;
  const Eigen::Vector3d from_m = world.strokes_at({5.2, -0.2, 0.4});
  const Eigen::Vector3d speed_mps(0.0, -0.12, 0.06);
  for (int n = 0; n < 240; ++n) {
    world.cycle(StepKind::kSwing, n / 240.0, from_m + 0.01 * n * speed_mps, speed_mps);
  }
  assert_true(world.told().payload_known);
  assert_true(std::abs(world.told().payload_kg - 1100.0) < 3.0 * world.told().payload_sd_kg);
}

// A bucket that opens has begun to lose what was weighed.
TEST(sliding_soil_is_not_weighed, LoadWorld world) {
  wave_empty(world);
  lift(world, 1000.0);
  const double weighed_kg = world.told().payload_kg;
  world.load_kg = 850.0;
  world.move(StepKind::kDump, kLifted, {5.6, 2.0, 0.75}, 2.0);
  assert_true(world.told().payload_known);
  assert_near(world.told().payload_kg, weighed_kg, 10.0);
}

TEST(not_known, LoadWorld world) {
  wave_empty(world);
  assert_true(world.told().known);
  const LoadTerms before = world.observer.terms;
  LoadSeen seen;
  const auto next = [&] {
    next_load(LoadWorld::machine(), seen, StepKind::kReturnToDig, 0.5, kHigh, 0.01, true,
              world.observer);
    assert_false(world.told().known);
  };
  next();
  seen.known = true;
  seen.force_n[kArm] = std::numeric_limits<double>::quiet_NaN();
  repeat(30, next);
  same_terms(before, world.observer.terms);
  world.move(StepKind::kReturnToDig, kOut, kHigh, 6.0);
  assert_true(world.told().known);
  assert_true(world.told().force_n.norm() < 1500.0);
}

/// What a cycle without a pressure leaves: nothing of the teeth, all that was learnt.
void miss_one(StepKind kind, const TipPose& pose, LoadWorld& world) {
  world.blind = true;
  world.stand(kind, pose, 0.01);
  assert_false(world.told().known);
  world.blind = false;
}

// One missing pressure, and what was weighed is in the bucket still, with what it has carried away.
TEST(a_missing_pressure_forgets_no_payload, LoadWorld world) {
  wave_empty(world);
  lift(world, 1000.0);
  const TipLoad before = world.told();
  assert_true(before.payload_known);
  miss_one(StepKind::kSwing, kLifted, world);
  for (int n = 0; n < 2; ++n) {
    assert_true(world.told().payload_known);
    assert_near(world.told().payload_kg, before.payload_kg, 5.0);
    world.stand(StepKind::kSwing, kLifted, 0.5);
  }
  world.blind = true;
  world.stand(StepKind::kSwing, kLifted, 0.9 * kPayloadUnseen_s);
  assert_true(world.told().payload_known);
  world.stand(StepKind::kSwing, kLifted, 0.2 * kPayloadUnseen_s);
  assert_false(world.told().payload_known);
  world.blind = false;
  world.stand(StepKind::kSwing, kLifted, 0.1);
  assert_near(world.told().payload_kg, before.payload_kg, 5.0);
}

// ... and the heap lies where it was: going back through it is not taken for an offset.
TEST(a_missing_pressure_forgets_no_heap, LoadWorld world) {
  wave_empty(world);
  lift(world, 1200.0);
  world.load_kg = 0.0;
  // The pressure is away where it pours: the pose says that it does.
  world.blind = true;
  world.stand(StepKind::kDump, kHigh, 2.0);
  world.blind = false;
  world.stand(StepKind::kReturnToDig, kHigh, 2.0);
  const double heap_m = world.observer.phase.heap_m;
  assert_true(heap_m > 0.5);
  miss_one(StepKind::kReturnToDig, kHigh, world);
  assert_near(world.observer.phase.heap_m, heap_m, 0.0);
  assert_true(world.observer.last_fill_kg > 1000.0 && world.observer.poured_kg > 1000.0);
  const LoadTerms before = world.observer.terms;
  constexpr double kWithin_m = -1.2;
  world.teeth_n = {-3e3, 8e3};
  world.move(StepKind::kReturnToDig, {7.0, kWithin_m, 1.9}, {7.6, kWithin_m, 2.0}, 4.0);
  same_terms(before, world.observer.terms);
}

// Half a block of before and half of after is none: a pressure that is away again and again teaches
// nothing wrong.
TEST(a_pressure_that_comes_and_goes_teaches_nothing, LoadWorld world) {
  wave_empty(world);
  const LoadTerms before = world.observer.terms;
  world.offset_n = {30e3, 30e3, 30e3};
  for (int n = 0; n < 40; ++n) {
    miss_one(StepKind::kReturnToDig, kHigh, world);
    world.stand(StepKind::kReturnToDig, kHigh, 0.01 * (kLoadBlock - 1));
  }
  same_terms(before, world.observer.terms);
}

// In motion the cylinders' power is what kinetic and potential energy gain.
TEST(power) {
  const ExcavatorProfile& machine = LoadWorld::machine();
  const Eigen::Vector3d at(0.7, -1.2, -0.9);
  const Eigen::Vector3d rates(0.4, -0.6, 0.9);
  const Eigen::Vector3d turns(0.8, 1.1, -1.5);
  const auto places = [&](double time_s) {
    return link_places(machine.oil, machine.geometry,
                       at + time_s * rates + 0.5 * time_s * time_s * turns);
  };
  const auto kinetic_j = [&](double time_s) {
    constexpr double kStep_s = 1e-5;
    const LinkPlaces before = places(time_s - kStep_s);
    const LinkPlaces after = places(time_s + kStep_s);
    double sum_j = 0.0;
    double rate_radps = 0.0;
    for (unsigned i = 0; i < 3; ++i) {
      rate_radps += rates[i] + time_s * turns[i];
      const Eigen::Vector2d speed = (after.centre_m[i] - before.centre_m[i]) / (2 * kStep_s);
      sum_j += 0.5 * machine.oil.link[i].mass_kg * speed.squaredNorm() +
               0.5 * machine.oil.link[i].inertia_kgm2 * rate_radps * rate_radps;
    }
    return sum_j;
  };
  constexpr double kStep_s = 1e-3;
  const double gained_w = (kinetic_j(kStep_s) - kinetic_j(-kStep_s)) / (2 * kStep_s);
  const LinkMoments moving = moving_moments(machine.oil, places(0.0), rates, turns, 0.0, 0.0);
  const Eigen::Vector3d moment_nm = moving.of_link.rowwise().sum();
  assert_near(moment_nm.dot(rates), gained_w, 1e-3 * std::abs(gained_w));
}

// A platform that turns throws what is out outwards: less boom is needed, as if it were lighter.
TEST(swing) {
  const ExcavatorProfile& machine = LoadWorld::machine();
  const LinkPlaces at = link_places(machine.oil, machine.geometry, {0.7, -1.2, -0.9});
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const LinkMoments turning = moving_moments(machine.oil, at, none, none, 0.8, 0.5);
  for (unsigned i = 0; i < 3; ++i) {
    const Eigen::Vector2d arm_m = at.centre_m[i] - at.pin_m[0];
    const double outwards_n = machine.oil.link[i].mass_kg * 0.64 * (0.5 + at.centre_m[i].x());
    assert_near(turning.of_link(0, i), arm_m.y() * outwards_n, 1e-9);
  }
}
