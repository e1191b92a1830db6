// SPDX-License-Identifier: Apache-2.0
#include "app/runs/grade_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/runs/dozer_rig.hpp"
#include "app/runs/plant_faults.hpp"

namespace graben::runs {
namespace {

constexpr double kLongerThanWanted = 10.0;
constexpr double kStart_s = 20.0;

class GradeRun {
 public:
  GradeRun(const machines::SimulatedDozer& machine, const GradeOptions& options)
      : machine_(machine),
        options_(options),
        rig_(machine, options.speed_override_ratio),
        truth_(machine.profile),
        start_m_(edge_x_m()),
        faults_(dozer_plant_faults(), options.faults) {}

  GradeResult run(const Progress& show) {
    const LoggedRun figures = run_logged(
        rig_, options_.log_file,
        [this](TimeUs now_us) {
          faults_.apply(now_us, rig_.plant.faults(), rig_.plant_port);
          return ended(now_us);
        },
        [&](TimeUs now_us, double cycle_us) {
          look(now_us, cycle_us);
          show((edge_x_m() - start_m_) / way_m(), fmt::format("at {:.1f} m", edge_x_m()));
        });
    result_.wall_s = figures.wall_s;
    result_.faults_left = faults_.left();
    result_.rejected_frames = figures.rejected_frames;
    keep_terrain();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double edge_x_m() const { return rig_.plant.plant().cutting_edge_m().x(); }
  [[nodiscard]] double way_m() const { return machine_.experiment.length_m - start_m_; }

  bool ended(TimeUs now_us) {
    const DozerStatus& status = rig_.ecu->outputs().status;
    if (status.mode == EcuMode::kFault) {
      result_.end = GradeEnd::kFault;
      result_.fault = status.fault;
      return true;
    }
    if (status.graded || (edge_x_m() >= machine_.experiment.length_m && !status.ground_left)) {
      result_.end = GradeEnd::kDone;
      return true;
    }
    result_.end = GradeEnd::kNotFinished;
    const double speed_mps =
        speed_ratio(machine_.profile.safety.unknown, Task::kGrade, options_.speed_override_ratio) *
        machine_.profile.travel.speed_desired_mps;
    return seconds(now_us) >
           options_.most_s.value_or(status.pass *
                                    (kStart_s + kLongerThanWanted * way_m() / speed_mps));
  }

  void look(TimeUs now_us, double cycle_us) {
    GradeSample sample;
    sample.time_s = seconds(now_us);
    sample.cycle_us = cycle_us;
    read_truth(sample);
    read_measured(sample);
    read_controller(sample);
    result_.samples.push_back(sample);
  }

  void read_truth(GradeSample& sample) const {
    const plant::DozerPlant& plant = rig_.plant.plant();
    sample.body = true_pose(plant);
    sample.off_track_m = plant.plan() ? plant.edge_point_m(0.0).y() : 0.0;
    sample.edge_m = plant.cutting_edge_m();
    const DozerStatus& status = rig_.ecu->outputs().status;
    sample.pass = status.pass;
    sample.over_grade = status.cutting && sample.edge_m.x() >= 0.0 &&
                        sample.edge_m.x() <= machine_.experiment.length_m;
    sample.design_m = truth_.design_m(sample.edge_m.x());
    const BladeAngles blade{plant.blade().angle_rad(),
                            plant.tilt() ? plant.tilt()->angle_rad() : 0.0};
    sample.tilt_rad = blade.tilt_rad;
    sample.error_true_m = plant.tilt() ? worst_end_m(plant) : truth_.error_m(sample.edge_m);
    sample.speed_true_mps = plant.velocity_mps();
    const BodyRates rates = {plant.velocity_mps(), plant.climb_mps(), plant.pitch_rate_radps(),
                             plant.roll_rate_radps()};
    sample.flow_required_m3ps =
        truth_.inflow_m3ps(truth_.required_blade_mps(
            sample.body, rates, truth_.blade_angle_rad(plant.blade_stroke_m()))) +
        truth_.tilt_inflow_m3ps(truth_.required_tilt_mps(sample.body, rates, blade));
    sample.flow_available_m3ps = available_flow_m3ps(machine_.plant.machine, plant.engine_radps());
    sample.blade_true_mps = plant.blade_velocity_mps();
    sample.spool_real = plant.spool_travel_ratio();
    sample.track_mps = plant.track_speeds_mps();
    sample.pump_real = plant.pump_ratios();
    sample.motor_real = plant.motor_ratios();
  }

  /// By the plant's own geometry.
  [[nodiscard]] double worst_end_m(const plant::DozerPlant& plant) const {
    const double half_m = machine_.profile.tilt.half_width_m();
    const double left_m = truth_.point_error_m(plant.edge_point_m(half_m));
    const double right_m = truth_.point_error_m(plant.edge_point_m(-half_m));
    return std::abs(left_m) > std::abs(right_m) ? left_m : right_m;
  }

  void read_measured(GradeSample& sample) const {
    const DozerInputs& inputs = rig_.ecu->inputs();
    const BodyInputs& body = inputs.body;
    const auto known = [](const Signal<double>& signal) {
      return signal.validity == Validity::kValid;
    };
    if (known(body.velocity_mps)) {
      sample.speed_measured_mps = body.velocity_mps.value;
    }
    if (known(body.position_m) && known(body.height_m) && known(body.pitch_rad) &&
        known(inputs.blade_stroke_m)) {
      const BodyPose pose = {body.position_m.value,
                             body.height_m.value,
                             body.pitch_rad.value,
                             known(body.roll_rad) ? body.roll_rad.value : 0.0,
                             known(body.offset_m) ? body.offset_m.value : 0.0,
                             known(body.heading_rad) ? body.heading_rad.value : 0.0};
      sample.error_measured_m =
          truth_.worst_error_m(pose, {truth_.blade_angle_rad(inputs.blade_stroke_m.value),
                                      truth_.tilt_angle_rad(inputs.tilt_stroke_m.value)});
    }
  }

  void read_controller(GradeSample& sample) const {
    const DozerOutputs& outputs = rig_.ecu->outputs();
    const DozerStatus& status = outputs.status;
    sample.speed_wanted_mps = status.wanted_speed_mps;
    sample.speed_limit_mps = status.speed_limit_mps;
    sample.lambda = status.lambda;
    sample.limit = status.limit;
    sample.flow_reported_m3ps = status.required_flow_m3ps;
    sample.flow_limit_reported_m3ps = status.available_flow_m3ps;
    sample.blade_wanted_mps = status.wanted_blade_mps;
    sample.spool_command = outputs.blade_duty_ratio;
    sample.pump_command = outputs.pump_ratio;
    sample.motor_command = outputs.motor_ratio;
  }

  /// From behind the start to before the last edge.
  void keep_terrain() {
    constexpr double kMargin_m = 3.0;
    constexpr double kStep_m = 0.05;
    const plant::Terrain& terrain = rig_.plant.plant().terrain();
    const double from_m = machine_.plant.start_position_m - kMargin_m;
    const auto steps =
        static_cast<int>((machine_.experiment.length_m + kMargin_m - from_m) / kStep_m);
    for (int i = 0; i <= steps; ++i) {
      const double x_m = from_m + i * kStep_m;
      result_.terrain_m.emplace_back(x_m, terrain.height_m(x_m));
      keep_ends(x_m);
    }
  }

  void keep_ends(double x_m) {
    const std::optional<plant::CrossGround>& beside = rig_.plant.plant().cross_ground();
    if (beside) {
      for (const auto end : {plant::CrossGround::kLeftEnd, plant::CrossGround::kRightEnd}) {
        result_.ends_m.emplace_back(x_m, beside->across_m[end], beside->line[end].height_m(x_m));
      }
    }
  }

  const machines::SimulatedDozer& machine_;
  GradeOptions options_;
  GradeRig rig_;
  GradeTruth truth_;
  double start_m_;
  PlantFaultSchedule<plant::DozerFaults> faults_;
  GradeResult result_;
};

}  // namespace

GradeResult run_grade(const machines::SimulatedDozer& machine, const GradeOptions& options,
                      const Progress& progress) {
  return GradeRun(machine, options).run(progress);
}

}  // namespace graben::runs
