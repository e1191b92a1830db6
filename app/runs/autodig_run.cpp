// SPDX-License-Identifier: Apache-2.0
#include "app/runs/autodig_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/machines/task_text.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/fence_truth.hpp"
#include "app/runs/kept_ground.hpp"
#include "app/runs/plant_faults.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/step_round.hpp"
#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben::runs {
namespace {

constexpr double kLongerThanPlanned = 10.0;
/// Most rounds of these are not needed.
constexpr double kLongerInLayers = 1.0;
constexpr double kApproach_s = 60.0;

std::array<double, 3> list_of(const Eigen::Vector3d& at) { return {at.x(), at.y(), at.z()}; }

std::array<double, kDriveCount> list_of(const DriveVector& drives) {
  return {drives[0], drives[1], drives[2], drives[3]};
}

double planned_s(const TaskProgram& program) {
  double sum_s = 0.0;
  for (int i = 0; i < program.step_count; ++i) {
    sum_s += program.step[static_cast<unsigned>(i)].duration_s();
  }
  return sum_s;
}

class AutodigRun {
 public:
  AutodigRun(const machines::SimulatedExcavator& machine, const TaskProgram& program,
             const AutodigOptions& options)
      : machine_(machine),
        program_(program),
        options_(options),
        kinematics_(machine.profile.geometry),
        rig_(machine, book_of(program), options.start, options.speed_override_ratio),
        faults_(excavator_plant_faults(), options.faults) {
    if (!options.store.empty()) {
      ground_ = std::make_unique<KeptGround>(options.store, rig_.setup, machine.hash);
    }
    rig_.plant.plant().keep_account(&account_);
    result_.spool_edges = spool_edges(machine.plant);
    if (const auto& digging = machine.plant.digging; digging) {
      result_.capacity_kg =
          digging->bucket.capacity_m3 * digging->soil.density_kgpm3 / digging->soil.swell;
    }
  }

  AutodigResult run(const Progress& show) {
    const LoggedRun figures = run_logged(
        rig_, options_.log_file,
        [this](TimeUs now_us) {
          faults_.apply(now_us, rig_.plant.faults(), rig_.plant_port);
          return ended(now_us);
        },
        [&](TimeUs now_us, double cycle_us) {
          look(now_us, cycle_us);
          const TaskProgress& at = rig_.ecu->outputs().status.progress;
          show(share_done(at), machines::step_name(at.kind));
        });
    if (ground_ != nullptr) {
      ground_->finish();
    }
    if (const plant::BucketSoil* soil = rig_.plant.plant().digging(); soil != nullptr) {
      result_.built = as_built(program_, soil->ground());
    }
    result_.wall_s = figures.wall_s;
    result_.faults_left = faults_.left();
    result_.rejected_frames = figures.rejected_frames;
    return std::move(result_);
  }

 private:
  static TaskBook book_of(const TaskProgram& program) {
    TaskBook book;
    book.program[0] = program;
    book.count = 1;
    return book;
  }

  [[nodiscard]] double share_done(const TaskProgress& at) const {
    const bool in_step = at.runs && at.kind != StepKind::kApproach;
    const bool bounded = program_.rounds.is_bounded();
    const double step = in_step ? (at.step + at.share) / program_.step_count : 0.0;
    return ((bounded ? at.round : round_) + step) /
           (bounded ? program_.rounds.count : options_.rounds);
  }

  bool ended(TimeUs now_us) {
    const ExcavatorStatus& status = rig_.ecu->outputs().status;
    if (status.mode == EcuMode::kFault) {
      result_.end = AutodigEnd::kFault;
      result_.fault = status.fault;
      return true;
    }
    if (status.progress.kind == StepKind::kDone || round_ >= options_.rounds) {
      result_.end = AutodigEnd::kDone;
      return true;
    }
    result_.end = AutodigEnd::kNotFinished;
    const double longer = in_layers(program_) ? kLongerInLayers : kLongerThanPlanned;
    return seconds(now_us) >
           options_.most_s.value_or(kApproach_s + longer * options_.rounds * planned_s(program_) /
                                                      speed_ratio(machine_.profile.safety.unknown,
                                                                  Task::kProgram,
                                                                  options_.speed_override_ratio));
  }

  /// The operator lets go of the task, and half a second later asks for it anew.
  void give_word(TimeUs now_us) {
    constexpr TimeUs kPause_us = 500 * kMillisecondUs;
    const TaskProgress& at = rig_.ecu->outputs().status.progress;
    const bool stands = at.runs && at.kind == StepKind::kWait && at.share >= 1.0;
    if (!stands) {
      waits_since_us_ = now_us;
    } else if (seconds(now_us - waits_since_us_) >= options_.word_after_s) {
      const OperatorMode automatic = OperatorMode::kAutomatic;
      rig_.driver.set_schedule(
          {{0, {true, automatic, Task::kNone, 0.0}},
           {now_us + kPause_us, {true, automatic, rig_.task, rig_.speed_override_ratio}}});
      waits_since_us_ = now_us;
    }
  }

  void look(TimeUs now_us, double cycle_us) {
    give_word(now_us);
    if (ground_ != nullptr) {
      ground_->look(*rig_.ecu, now_us);
    }
    AutodigSample sample;
    sample.time_s = seconds(now_us);
    sample.cycle_us = cycle_us;
    read_controller(sample);
    read_truth(sample);
    count_rounds(sample.progress);
    result_.missed = std::max<int>(result_.missed, sample.progress.missed);
    if (round_ < options_.rounds) {
      compare(sample);
      result_.samples.push_back(sample);
    }
  }

  void count_rounds(const TaskProgress& at) {
    if (!result_.samples.empty() && at.runs && at.step < result_.samples.back().progress.step) {
      ++round_;
    }
  }

  void read_truth(AutodigSample& sample) const {
    const plant::ExcavatorPlant& plant = rig_.plant.plant();
    const auto strokes = plant.strokes_m();
    const auto velocities = plant.stroke_velocities_mps();
    const auto spools = plant.spool_travels_ratio();
    std::copy(strokes.begin(), strokes.end(), sample.real.begin());
    std::copy(velocities.begin(), velocities.end(), sample.velocity_real.begin());
    std::copy(spools.begin(), spools.end(), sample.spool_real.begin());
    sample.real[kSwing] = plant.swing_rad();
    sample.velocity_real[kSwing] = plant.swing_rate_radps();
    sample.spool_real[kSwing] = plant.swing_spool_ratio();
    const plant::TeethTruth teeth = plant.teeth();
    sample.teeth_m = list_of(teeth.position_m);
    sample.attitude_rad = teeth.attitude_rad;
    sample.pump_real_pa = plant.pump_pressures_pa();
    sample.swash_real = mean_swash(plant);
    sample.energy = pump_energy(account_);
    if (const plant::BucketSoil* soil = plant.digging(); soil != nullptr) {
      sample.fill_m3 = soil->fill_m3();
      sample.cut_m3 = soil->cut_m3();
      sample.fill_kg = soil->fill_kg();
      const Eigen::Vector2d force_n = plant.ground_force_n();
      sample.tip_force_n = {force_n.x(), force_n.y()};
    }
  }

  void read_controller(AutodigSample& sample) const {
    const ExcavatorOutputs& outputs = rig_.ecu->outputs();
    const ExcavatorStatus& status = outputs.status;
    sample.progress = status.progress;
    sample.progress_share = status.progress.share;
    sample.told = status.tip_load;
    sample.lambda = status.lambda;
    sample.limit = status.limit;
    for (unsigned i = 0; i < kDriveCount; ++i) {
      const double lever_m = i == kSwing ? machine_.profile.swing.lever_m : 1.0;
      sample.velocity_wanted[i] = status.lambda * status.wanted_velocity_mps[i] / lever_m;
      sample.spool_command[i] = outputs.duty_ratio[i];
    }
    sample.pump_expected_pa = status.pump_pressure_pa;
  }

  /// Of what the controller was told; not finite until all of it was.
  [[nodiscard]] Eigen::Vector3d measured_teeth_m() const {
    const ExcavatorInputs& inputs = rig_.ecu->inputs();
    const auto strokes_m = measured_strokes_m(machine_.profile, *rig_.ecu);
    const bool known = inputs.swing.angle_rad.validity == Validity::kValid && strokes_m.has_value();
    DriveVector drives;
    drives.head<kAxisCount>() = strokes_m.value_or(Eigen::Vector3d::Zero());
    drives[kSwing] = inputs.swing.angle_rad.value;
    const DriveResult joints = kinematics_.joints_from_drive(drives);
    if (!known || joints.blind.kind != BlindKind::kNone) {
      return Eigen::Vector3d::Constant(AutodigSample::kUnknown);
    }
    return kinematics_.teeth_from_joints(joints.value).position_m;
  }

  /// The real machine beside the plan, at the place that the controller says it is at.
  void compare(AutodigSample& sample) const {
    const Eigen::Vector3d teeth_m(sample.teeth_m[0], sample.teeth_m[1], sample.teeth_m[2]);
    look_at_fences(sample);
    const TaskProgress& at = sample.progress;
    if (!at.runs || at.kind == StepKind::kApproach || at.kind == StepKind::kDone) {
      return;
    }
    if (in_layers(program_)) {
      return;  // Where the steps lead is decided on the way.
    }
    const TaskStep step =
        step_in_round(machine_.profile, kinematics_, program_, at.step, at.round, at.next_round)
            .step;
    const Eigen::Vector3d measured_m = measured_teeth_m();
    const Eigen::Vector3d end_m = teeth_at(step_motion(kinematics_, step, 1.0).value).position_m;
    sample.end_off_true_m = (teeth_m - end_m).norm();
    sample.end_off_measured_m = (measured_m - end_m).norm();
    if (at.off_plan) {
      return;  // Where it began was decided on the way.
    }
    plan_at(step_motion(kinematics_, step, at.share).value, sample);
    if (step.straight) {
      sample.error_true_m = line_distance_m(step.line.line, teeth_m);
      sample.error_measured_m = line_distance_m(step.line.line, measured_m);
    }
  }

  [[nodiscard]] TeethPose teeth_at(const DriveVector& drives) const {
    return kinematics_.teeth_from_joints(kinematics_.joints_from_drive(drives).value);
  }

  void plan_at(const DriveVector& value, AutodigSample& sample) const {
    sample.planned = list_of(value);
    const TeethPose teeth = teeth_at(value);
    sample.planned_m = list_of(teeth.position_m);
    sample.planned_attitude_rad = teeth.attitude_rad;
  }

  /// By the machine's true outline; of a design the edge's corners under it too.
  void look_at_fences(AutodigSample& sample) const {
    const FenceTruth truth(rig_.plant.plant());
    for (int i = 0; i < program_.fences.count; ++i) {
      const Fence& fence = program_.fences.fence[static_cast<unsigned>(i)];
      const double left_m = truth.left_m(fence);
      if (fence.guard == FenceGuard::kTeeth) {
        sample.over_cut_m = std::fmax(sample.over_cut_m, std::max(0.0, -left_m));
      }
      sample.fence_left_m = std::fmin(sample.fence_left_m, left_m);
    }
  }

  const machines::SimulatedExcavator& machine_;
  const TaskProgram& program_;
  AutodigOptions options_;
  SwingKinematics kinematics_;
  plant::EnergyAccount account_;
  AutodigRig rig_;
  PlantFaultSchedule<plant::ExcavatorFaults> faults_;
  std::unique_ptr<KeptGround> ground_;
  int round_ = 0;
  TimeUs waits_since_us_ = 0;
  AutodigResult result_;
};

}  // namespace

AutodigResult run_autodig(const machines::SimulatedExcavator& machine, const TaskProgram& program,
                          const AutodigOptions& options, const Progress& progress) {
  return AutodigRun(machine, program, options).run(progress);
}

}  // namespace graben::runs
