// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Calm and energy of the excavator's runs: counted and shown in the same way in each of them.

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "app/plant/energy_account.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "app/runs/calm.hpp"
#include "app/runs/figures.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::runs {

/// Since the run began.
struct PumpEnergy {
  double in_j = 0.0;       ///< What the pumps put in.
  double spilled_j = 0.0;  ///< Lost over bypass and reliefs.
};
[[nodiscard]] inline PumpEnergy pump_energy(const plant::EnergyAccount& account) {
  return {account.pump_j, account.spilled_j()};
}

/// Of the real spools.
using RealSpoolEdges = std::array<SpoolEdges, kDriveCount>;
[[nodiscard]] RealSpoolEdges spool_edges(const plant::ExcavatorPlantProfile& plant);

/// Of the time that a run judges.
struct ExcavatorCalm {
  double lambda_variation_ps = 0.0;
  /// Of the real spools; drives that the run does not have stay 0.
  std::array<double, kDriveCount> spool_travel_ps{};
  std::array<double, kDriveCount> spool_reversals_ps{};
  // What is sent to them, which wears their pilot valves.
  std::array<double, kDriveCount> duty_travel_ps{};
  std::array<double, kDriveCount> duty_sign_changes_ps{};
  double jerk_rms_mps3 = 0.0;  ///< Of the point that works, see Jerk.
  PumpEnergy energy;
  double swash_mean = 0.0;  ///< Of the pumps that the machine has, of full swash.

  /// Lost over bypass and reliefs, of what the pumps put in. Reliefs at the cylinders' ports take
  /// what a load gives back too.
  [[nodiscard]] double spilled_share() const {
    return energy.in_j > 0.0 ? energy.spilled_j / energy.in_j : kAbsent;
  }
  /// Of one loop, round, ...; kAbsent where none of it was done.
  [[nodiscard]] double energy_per_j(double done) const {
    return done > 0.0 ? energy.in_j / done : kAbsent;
  }
};

/// Counts samples that have lambda, spool_real, spool_command, swash_real and energy.
class ExcavatorCalmCount {
 public:
  explicit ExcavatorCalmCount(const RealSpoolEdges& edges)
      : spool_(edges.begin(), edges.end()), duty_(edges.size(), SpoolCalm(SpoolEdges{})) {}

  /// `works_at_m` is where the point that works is.
  template <class Sample>
  void add(const Sample& sample, const Eigen::Vector3d& works_at_m) {
    lambda_.add(sample.lambda);
    for (std::size_t i = 0; i < sample.spool_real.size(); ++i) {
      spool_[i].add(sample.spool_real[i]);
      duty_[i].add(sample.spool_command[i]);
    }
    jerk_.add(works_at_m);
    if (last_) {
      energy_.in_j += sample.energy.in_j - last_->in_j;
      energy_.spilled_j += sample.energy.spilled_j - last_->spilled_j;
    }
    last_ = sample.energy;
    swash_sum_ += sample.swash_real;
    ++count_;
  }
  void pause();
  /// Pauses.
  [[nodiscard]] ExcavatorCalm figures();

 private:
  Variation lambda_;
  std::vector<SpoolCalm> spool_;
  std::vector<SpoolCalm> duty_;
  Jerk jerk_;
  std::optional<PumpEnergy> last_;
  PumpEnergy energy_;
  double swash_sum_ = 0.0;
  long count_ = 0;
};

/// The table with figures of the summary's member `calm`: lambda, the spools of the linkage.
template <class Summary>
[[nodiscard]] FigureTable<Summary> with_calm(FigureTable<Summary> table) {
  using S = Summary;
  return joined<S>(std::move(table),
                   {
                       {kLambdaVariation, [](const S& s) { return s.calm.lambda_variation_ps; }},
                       {{"spool_travel_ps.boom", "boom's spool, full travels a second", kPerSecond,
                         "spool_travel_boom_ps"},
                        [](const S& s) { return s.calm.spool_travel_ps[kBoom]; }},
                       {{"spool_travel_ps.arm", "arm's spool, full travels a second", kPerSecond,
                         "spool_travel_arm_ps"},
                        [](const S& s) { return s.calm.spool_travel_ps[kArm]; }},
                       {{"spool_travel_ps.bucket", "bucket's spool, full travels a second",
                         kPerSecond, "spool_travel_bucket_ps"},
                        [](const S& s) { return s.calm.spool_travel_ps[kBucket]; }},
                       {{"spool_reversals_ps.boom", "boom's spool, changes of side a second",
                         kPerSecond, "spool_reversals_boom_ps"},
                        [](const S& s) { return s.calm.spool_reversals_ps[kBoom]; }},
                       {{"spool_reversals_ps.arm", "arm's spool, changes of side a second",
                         kPerSecond, "spool_reversals_arm_ps"},
                        [](const S& s) { return s.calm.spool_reversals_ps[kArm]; }},
                       {{"spool_reversals_ps.bucket", "bucket's spool, changes of side a second",
                         kPerSecond, "spool_reversals_bucket_ps"},
                        [](const S& s) { return s.calm.spool_reversals_ps[kBucket]; }},
                   });
}

/// The same, with its energy, its pumps, and what is sent to the spools of boom and arm.
template <class Summary>
[[nodiscard]] FigureTable<Summary> with_energy(FigureTable<Summary> table) {
  using S = Summary;
  return joined<S>(std::move(table),
                   {
                       {{"energy_j", "energy that the pumps put in", kKilowattHours, "energy_j"},
                        [](const S& s) { return s.calm.energy.in_j; }},
                       {{"energy_bypass_relief_share", "of it lost over bypass and reliefs",
                         kPercent, "energy_bypass_relief"},
                        [](const S& s) { return s.calm.spilled_share(); }},
                       {{"swash_mean", "swash of the pumps, mean", kRatio, "swash_mean"},
                        [](const S& s) { return s.calm.swash_mean; }},
                       {{"duty_travel_ps.boom", "boom's duty, full travels a second", kPerSecond,
                         "duty_travel_boom_ps"},
                        [](const S& s) { return s.calm.duty_travel_ps[kBoom]; }},
                       {{"duty_travel_ps.arm", "arm's duty, full travels a second", kPerSecond,
                         "duty_travel_arm_ps"},
                        [](const S& s) { return s.calm.duty_travel_ps[kArm]; }},
                       {{"duty_sign_changes_ps.boom", "boom's duty, changes of sign a second",
                         kPerSecond, "duty_sign_changes_boom_ps"},
                        [](const S& s) { return s.calm.duty_sign_changes_ps[kBoom]; }},
                       {{"duty_sign_changes_ps.arm", "arm's duty, changes of sign a second",
                         kPerSecond, "duty_sign_changes_arm_ps"},
                        [](const S& s) { return s.calm.duty_sign_changes_ps[kArm]; }},
                   });
}

}  // namespace graben::runs
