// SPDX-License-Identifier: Apache-2.0
// Rows 54 and 60: a dozer's body and tracks whose sensors are frozen, with live counters.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// The issue of a wrong pose: how far the machine may go with it, and for how long.
constexpr double kMostBlind_m = 0.3;
constexpr TimeUs kMostBlind_us = 300 * kMillisecondUs;
/// Pitch frozen with its rate, while all else is right: the climb has to say it.
constexpr double kMostBlindWithItsRate_m = 1.0;
constexpr TimeUs kMostBlindWithItsRate_us = 4 * kSecondUs;

enum Part : unsigned { kPosition, kHeight, kPitch, kVelocity, kClimb, kPitchRate, kParts };

/// What is frozen, by turns: each by itself, those that belong together, the whole pose.
std::vector<Part> frozen_parts(std::uint64_t seed) {
  switch (seed % 10) {
    case 0:
      return {kPosition};
    case 1:
      return {kPitch};
    case 2:
      return {kVelocity};
    case 3:
      return {kPosition, kHeight, kPitch, kVelocity, kClimb, kPitchRate};
    case 4:
      return {kHeight};
    case 5:
      return {kPitch, kPitchRate};
    case 6:
      return {kPosition, kVelocity};
    case 7:
      return {kPosition, kHeight, kVelocity, kClimb};
    case 8:
      return {kClimb};
    default:
      return {kPitchRate};
  }
}

plant::ReadingFault& fault_of(plant::PoseFaults& pose, Part part) {
  const std::array<plant::ReadingFault*, kParts> faults = {
      &pose.position, &pose.height, &pose.pitch, &pose.velocity, &pose.climb, &pose.pitch_rate};
  return *faults[part];
}

std::array<double, kParts> truth(const plant::DozerPlant& plant) {
  return {plant.position_m(),   plant.height_m(),  plant.pitch_rad(),
          plant.velocity_mps(), plant.climb_mps(), plant.pitch_rate_radps()};
}

/// What is frozen is right until the machine has changed by so much: of no harm before, and nobody
/// could tell. Where a quantity is frozen with its rate, only the rest of the pose can contradict.
bool is_wrong(const std::vector<Part>& parts, const std::array<double, kParts>& then,
              const std::array<double, kParts>& now) {
  constexpr std::array<double, kParts> kHarmless = {0.03, 0.03, 0.03, 0.2, 0.15, 0.15};
  constexpr std::array<double, kParts> kWithItsRate = {0.03, 0.1, 0.12, 0.2, 0.6, 0.6};
  const std::array<double, kParts>& least = parts.size() == 2 ? kWithItsRate : kHarmless;
  for (const Part part : parts) {
    if (std::abs(now[part] - then[part]) > least[part]) {
      return true;
    }
  }
  return false;
}

void pose_frozen(Trial<Dozer>& trial) {
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  const std::vector<Part> parts = frozen_parts(trial.seed());
  plant::PoseFaults& pose = rig.plant.faults().pose;
  for (const Part part : parts) {
    fault_of(pose, part).stuck = true;
  }
  const std::array<double, kParts> then = truth(rig.plant.plant());
  rig.run_until(15 * kSecondUs, [&] {
    return !in_motion(rig.mode()) || is_wrong(parts, then, truth(rig.plant.plant()));
  });
  const bool with_its_rate = parts.size() == 2 && parts.front() == kPitch;
  const TimeUs most_us = with_its_rate ? kMostBlindWithItsRate_us : kMostBlind_us;
  const double from_m = rig.plant.plant().position_m();
  Stop stop{rig.at_us(), {Fault::kPoseDisagrees}, most_us};
  stop.cure = [&pose] { pose = {}; };
  rig.run_until(most_us, [&rig] { return !in_motion(rig.mode()); });
  const double blind_m = rig.plant.plant().position_m() - from_m;
  trial.outcome.harm = blind_m;
  trial.outcome.harm_unit = "m";
  trial.check(blind_m <= (with_its_rate ? kMostBlindWithItsRate_m : kMostBlind_m),
              fmt::format("{:.2f} m driven blind", blind_m));
  trial.expect_stop(stop);
}

/// A track's sensor reads 0, any constant, or a share of what it is.
void track_sensor_wrong(Trial<Dozer>& trial) {
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  const unsigned track = trial.any_of(kTrackCount);
  plant::ReadingFault& speed = rig.plant.faults().path[track].speed;
  const double true_mps = rig.plant.plant().track_speeds_mps()[track];
  switch (trial.seed() % 4) {
    case 0:
    case 1:
      speed.reads = 0.0;
      break;
    case 2:
      speed.reads = true_mps + 0.5 + trial.random.uniform();
      break;
    default:
      speed.reads = 0.6 * true_mps * trial.random.uniform();
      break;
  }
  const double gauge_m = 2.0 * rig.machine.profile.body.half_gauge_m;
  // The two tracks' difference over the gauge is the body's turn.
  double turned_rad = 0.0;
  double at_once_rad = 0.0;  ///< Before the fault is told.
  const TimeUs told_us = rig.now_us + 300 * kMillisecondUs;
  rig.before_all = [&rig, &turned_rad, &at_once_rad, gauge_m, told_us] {
    const plant::DozerPlant& plant = rig.plant.plant();
    turned_rad +=
        0.01 / gauge_m * (plant.track_speeds_mps()[kRight] - plant.track_speeds_mps()[kLeft]);
    at_once_rad = rig.now_us <= told_us ? std::abs(turned_rad) : at_once_rad;
  };
  Slowing slowing{rig.at_us(), Fault::kTrackSpeedDisagrees, 300 * kMillisecondUs, 2 * kSecondUs};
  slowing.cure = [&speed] { speed = {}; };
  trial.expect_slower(slowing);
  constexpr double kMostTurn_rad = 3.0 / 57.3;
  trial.outcome.harm = 57.3 * std::abs(turned_rad);
  trial.outcome.harm_unit = "deg";
  trial.check(std::abs(turned_rad) <= kMostTurn_rad,
              fmt::format("turned by {:.2f} degrees", 57.3 * turned_rad));
  constexpr double kMostAtOnce_rad = 0.5 / 57.3;
  trial.check(at_once_rad <= kMostAtOnce_rad,
              fmt::format("turned by {:.2f} degrees before it was told", 57.3 * at_once_rad));
}

}  // namespace

Rows<Dozer> pose_rows() {
  return {{54, "pose frozen: a part, some, all of it", "N L", pose_frozen},
          {60, "a track's sensor reads 0 or a constant", "D", track_sensor_wrong}};
}

}  // namespace graben::faults
