// SPDX-License-Identifier: Apache-2.0
#include "app/runs/stopping_run.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <optional>

#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::runs {
namespace {

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr double kPeriod_s = 0.01;
/// As the simulated machine sends ExternalLimit: every fifth cycle, in the fourth.
constexpr TimeUs kSentEvery_us = 50 * kMillisecondUs;
constexpr TimeUs kSentAt_us = 30 * kMillisecondUs;
constexpr double kDeadline_s = 0.25;
/// Of what fills a bucket.
constexpr double kLoose_kgpm3 = 1600.0;
constexpr TimeUs kWatched_us = 4 * kSecondUs;

/// How long a motion is looked at for its fastest moment: all of a swing's way, and once round a
/// digging path at a third of its speed.
constexpr TimeUs kLooked_us = 12 * kSecondUs;

/// Without `decided_us` it works on, and the time is returned at which it is fastest. With it, it
/// works until then, hears a stop, and is watched.
template <class Rig>
TimeUs work(Rig& rig, std::optional<TimeUs> decided_us,
            const std::function<Eigen::Vector3d()>& place, const std::function<void(TimeUs)>& hands,
            Stopping& found) {
  const auto says = [&rig](ExternalLevel level) {
    rig.plant.faults().external = ExternalWord{level, false, 1, 1.0, kDeadline_s};
  };
  says(ExternalLevel::kFree);
  Eigen::Vector3d last_m = place();
  Eigen::Vector3d from_m = last_m;
  TimeUs fastest_us = kSentAt_us;
  double fastest_mps = 0.0;
  const TimeUs end_us = decided_us ? *decided_us + kWatched_us : kLooked_us;
  for (TimeUs now_us = 0; now_us <= end_us; now_us += kPeriod_us) {
    hands(now_us);
    rig.step(now_us);
    const Eigen::Vector3d at_m = place();
    const double speed_mps = (at_m - last_m).norm() / kPeriod_s;
    last_m = at_m;
    if (speed_mps > fastest_mps && now_us % kSentEvery_us == kSentAt_us) {
      fastest_mps = speed_mps;
      fastest_us = now_us;
    }
    if (now_us == decided_us) {
      from_m = at_m;
      found.speed_mps = speed_mps;
      says(ExternalLevel::kStop);
    } else if (decided_us && now_us > *decided_us) {
      found.distance_m = std::max(found.distance_m, (at_m - from_m).norm());
      if (speed_mps > kStands_mps) {
        found.time_s = static_cast<double>(now_us - *decided_us) * 1e-6;
      }
    }
  }
  return fastest_us;
}

/// Twice the same: where it is fastest, and stopped there.
void stop_where_fastest(const std::function<TimeUs(std::optional<TimeUs>)>& run) {
  static_cast<void>(run(run(std::nullopt)));
}

/// Swings to the left from the middle of its range, the lever wholly on.
void stop_swing(const machines::SimulatedExcavator& machine, const Eigen::Vector3d& strokes_m,
                Stopping& found) {
  constexpr TimeUs kLever_us = 1 * kSecondUs;
  stop_where_fastest([&](std::optional<TimeUs> decided_us) {
    ExcavatorRig rig(machine, machine.profile, start_at(strokes_m), Task::kJog, found.speed_ratio);
    plant::OperatorHands hands;
    rig.driver.set_hands(hands);
    const auto move = [&](TimeUs now_us) {
      hands.lever_ratio[kSwing] = now_us >= kLever_us ? 1.0 : 0.0;
      rig.driver.set_hands(hands);
    };
    return work(
        rig, decided_us, [&] { return rig.plant.plant().teeth().position_m; }, move, found);
  });
}

void stop_dig(const machines::SimulatedExcavator& machine, const Eigen::Vector3d& strokes_m,
              Stopping& found) {
  stop_where_fastest([&](std::optional<TimeUs> decided_us) {
    DigRig rig(machine, strokes_m, found.speed_ratio);
    return work(
        rig, decided_us, [&] { return rig.plant.plant().teeth().position_m; }, [](TimeUs) {},
        found);
  });
}

}  // namespace

std::vector<Stopping> stopping(const machines::SimulatedExcavator& machine) {
  const double load_kg = kLoose_kgpm3 * machine.profile.geometry.body.capacity_m3;
  DigScenario scenario;
  std::vector<Stopping> all;
  for (const double load : {0.0, load_kg}) {
    machines::SimulatedExcavator loaded = machine;
    plant::LinkBody& bucket = loaded.plant.link[kBucket];
    bucket = plant::together(bucket, {load, 0.0, bucket.mass_centre_m});
    for (const char* motion : {"swing", "digging path"}) {
      const bool swings = std::string(motion) == "swing";
      if (swings && !machine.profile.has_swing()) {
        continue;
      }
      for (const double speed_ratio : kStopSpeeds) {
        Stopping found{motion, speed_ratio, load};
        const Eigen::Vector3d strokes_m = usual_run(loaded, scenario).start_strokes_m;
        (swings ? stop_swing : stop_dig)(loaded, strokes_m, found);
        all.push_back(found);
      }
    }
    if (load_kg <= 0.0) {
      break;
    }
  }
  return all;
}

std::vector<Stopping> stopping(const machines::SimulatedDozer& machine) {
  std::vector<Stopping> all;
  for (const double speed_ratio : kStopSpeeds) {
    Stopping found{"travel", speed_ratio, 0.0};
    stop_where_fastest([&](std::optional<TimeUs> decided_us) {
      GradeRig rig(machine, speed_ratio);
      const auto place = [&] { return Eigen::Vector3d(rig.plant.plant().position_m(), 0.0, 0.0); };
      return work(
          rig, decided_us, place, [](TimeUs) {}, found);
    });
    all.push_back(found);
  }
  return all;
}

}  // namespace graben::runs
