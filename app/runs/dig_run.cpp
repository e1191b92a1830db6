// SPDX-License-Identifier: Apache-2.0
#include "app/runs/dig_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/runs/excavator_rig.hpp"
#include "app/runs/path_progress.hpp"
#include "app/runs/plant_faults.hpp"

namespace graben::runs {
namespace {

/// Slower than this a direction says nothing.
constexpr double kMoving_mps = 0.02;

class DigRun {
 public:
  DigRun(const machines::SimulatedExcavator& machine, const DigOptions& options)
      : machine_(machine),
        options_(options),
        rig_(machine, options.start_strokes_m, options.speed_override_ratio),
        kinematics_(machine.profile.geometry),
        field_(machine.profile, kinematics_),
        path_(machine.profile.dig_path),
        progress_(path_, options.loops),
        faults_(excavator_plant_faults(), options.faults) {
    rig_.plant.plant().keep_account(&account_);
    result_.spool_edges = spool_edges(machine.plant);
  }

  DigResult run(const Progress& show) {
    const LoggedRun figures = run_logged(
        rig_, options_.log_file,
        [this](TimeUs now_us) {
          faults_.apply(now_us, rig_.plant.faults(), rig_.plant_port);
          return ended(now_us);
        },
        [&](TimeUs now_us, double cycle_us) {
          look(now_us, cycle_us);
          show(progress_.share(), progress_.on_path() ? "on the path" : "approaching the path");
        });
    result_.wall_s = figures.wall_s;
    result_.faults_left = faults_.left();
    result_.rejected_frames = figures.rejected_frames;
    result_.loops = progress_.share() * options_.loops;
    result_.peak_chamber_pressure_pa = rig_.plant.plant().peak_chamber_pressure_pa();
    if (const plant::BucketSoil* soil = rig_.plant.plant().digging(); soil != nullptr) {
      result_.cut_m3 = soil->cut_m3();
    }
    return std::move(result_);
  }

 private:
  bool ended(TimeUs now_us) {
    const ExcavatorStatus& status = rig_.ecu->outputs().status;
    if (status.mode == EcuMode::kFault) {
      result_.end = DigEnd::kFault;
      result_.fault = status.fault;
      result_.emergency = rig_.ecu->emergency();
      return true;
    }
    if (!progress_.on_path()) {
      result_.end = DigEnd::kPathNotReached;
      return seconds(now_us) > options_.approach_max_s;
    }
    if (reached_us_ == 0) {
      reached_us_ = now_us;
    }
    if (progress_.share() >= 1.0) {
      result_.end = DigEnd::kDone;
      return true;
    }
    result_.end = DigEnd::kLoopNotClosed;
    return seconds(now_us - reached_us_) > options_.loops * options_.loop_max_s /
                                               speed_ratio(machine_.profile.safety.unknown,
                                                           Task::kDig,
                                                           options_.speed_override_ratio);
  }

  void look(TimeUs now_us, double cycle_us) {
    DigSample sample;
    sample.cycle_us = cycle_us;
    sample.time_s = seconds(now_us);
    read_truth(sample);
    read_controller(sample);
    const bool moving = rig_.ecu->outputs().status.mode == EcuMode::kActive;
    progress_.update(
        sample.tip_true_m,
        moving && near_path(path_, sample.tip_measured_m, sample.attitude_measured_rad), now_us);
    sample.on_path = progress_.on_path();
    result_.samples.push_back(sample);
  }

  [[nodiscard]] double error_m(const Eigen::Vector2d& tip_m) const {
    return (path_.closest(tip_m).position_m - tip_m).norm();
  }

  void read_truth(DigSample& sample) const {
    const plant::ExcavatorPlant& plant = rig_.plant.plant();
    const plant::TipPose tip = plant.tip();
    sample.tip_true_m = tip.position_m;
    if (!result_.samples.empty()) {
      sample.velocity_true_mps =
          (tip.position_m - result_.samples.back().tip_true_m) / seconds(DigRig::kPeriod_us);
    }
    sample.attitude_true_rad = tip.attitude_rad;
    sample.off_field_rad =
        off_field_rad(sample.velocity_true_mps, sample.tip_true_m, sample.attitude_true_rad);
    sample.mean_off_field_rad = mean_off_field_rad(sample);
    sample.tip_force_n = plant.tip_force_n();
    if (const plant::BucketSoil* soil = plant.digging(); soil != nullptr) {
      sample.fill_m3 = soil->fill_m3();
    }
    for (const plant::SectionFlows& flows : plant.section_flows()) {
      sample.regenerating = sample.regenerating || flows.recycle_in_m3ps > 0.0;
    }
    if (const plant::Obstacle* obstacle = plant.obstacle(); obstacle && obstacle->touched()) {
      sample.obstruction = obstacle->gone() ? Obstruction::kReleased : Obstruction::kHolding;
    }
    const PathPoint closest = path_.closest(sample.tip_true_m);
    const Eigen::Vector2d off_m = sample.tip_true_m - closest.position_m;
    sample.error_true_m = off_m.norm();
    sample.cross_track_true_m = plant::cross(closest.tangent, off_m);
    sample.spool_real = plant.spool_travels_ratio();
    sample.velocity_real_mps = plant.stroke_velocities_mps();
    sample.pump_real_pa = plant.pump_pressures_pa();
    sample.swash_real = mean_swash(plant);
    sample.energy = pump_energy(account_);
  }

  [[nodiscard]] double off_field_rad(const Eigen::Vector2d& velocity_mps,
                                     const Eigen::Vector2d& tip_m, double attitude_rad) const {
    if (velocity_mps.norm() < kMoving_mps) {
      return 0.0;
    }
    const Eigen::Vector2d wanted = field_.contour({tip_m.x(), tip_m.y(), attitude_rad}).linear_mps;
    return std::abs(std::atan2(plant::cross(wanted, velocity_mps), wanted.dot(velocity_mps)));
  }

  [[nodiscard]] double mean_off_field_rad(const DigSample& sample) const {
    constexpr auto kCycles =
        static_cast<std::size_t>(kOilPeriod_s * 1e6 / static_cast<double>(DigRig::kPeriod_us));
    const std::size_t count = result_.samples.size();
    if (count < kCycles) {
      return 0.0;
    }
    Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
    for (std::size_t n = count - kCycles; n < count; ++n) {
      sum_m += result_.samples[n].tip_true_m;
    }
    const Eigen::Vector2d way_m = sample.tip_true_m - result_.samples[count - kCycles].tip_true_m;
    return off_field_rad(way_m / kOilPeriod_s, sum_m / static_cast<double>(kCycles),
                         sample.attitude_true_rad);
  }

  void read_controller(DigSample& sample) const {
    const ExcavatorOutputs& outputs = rig_.ecu->outputs();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      sample.velocity_wanted_mps[i] = outputs.status.lambda * outputs.status.wanted_velocity_mps[i];
      sample.spool_command[i] = outputs.duty_ratio[i];
    }
    if (const auto strokes_m = measured_strokes_m(machine_.profile, *rig_.ecu)) {
      const TipPose tip = kinematics_.state(*strokes_m).tip;
      sample.tip_measured_m = Eigen::Vector2d(tip.x_m, tip.y_m);
      sample.attitude_measured_rad = tip.attitude_rad;
      sample.error_measured_m = error_m(sample.tip_measured_m);
    }
    sample.lambda = outputs.status.lambda;
    sample.limit = outputs.status.limit;
    sample.pump_expected_pa = outputs.status.pump_pressure_pa;
  }

  const machines::SimulatedExcavator& machine_;
  DigOptions options_;
  plant::EnergyAccount account_;
  DigRig rig_;
  ExcavatorKinematics kinematics_;
  DigField field_;
  RoundedRectangle path_;
  PathProgress progress_;
  PlantFaultSchedule<plant::ExcavatorFaults> faults_;
  TimeUs reached_us_ = 0;
  DigResult result_;
};

}  // namespace

DigResult run_dig(const machines::SimulatedExcavator& machine, const DigOptions& options,
                  const Progress& progress) {
  return DigRun(machine, options).run(progress);
}

}  // namespace graben::runs
