// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A planned line as its user reads it: samples over time, table, figures.

#include <array>
#include <string>
#include <vector>

#include "app/machines/excavator_file.hpp"
#include "app/machines/task_file.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"

namespace graben::runs {

/// A plan at one moment; drives in the order of DriveVector, m and rad.
struct PlanSample {
  double time_s = 0.0;
  double way_m = 0.0;  ///< Of the teeth along the line.
  double speed_mps = 0.0;
  std::array<double, 3> teeth_m{};
  double attitude_rad = 0.0;
  std::array<double, kDriveCount> displacement{};
  std::array<double, kDriveCount> velocity{};
  std::array<double, kDriveCount> acceleration{};
  std::array<double, kPumpCount> flow_m3ps{};  ///< Into the cylinders; the swing's motor apart.
};

/// From 0 to the plan's end, which is the last one whatever the step.
[[nodiscard]] std::vector<PlanSample> sample_plan(const ExcavatorProfile& profile,
                                                  const SwingKinematics& kinematics,
                                                  const LinePlan& plan, double step_s);

/// The same of each step of a planned task, one after the other; `way_m` counts on.
[[nodiscard]] std::vector<PlanSample> sample_task(const ExcavatorProfile& profile,
                                                  const SwingKinematics& kinematics,
                                                  const TaskProgram& program, double step_s);

/// The greatest flow that the samples ask of each pump, m^3/s.
[[nodiscard]] std::array<double, kPumpCount> greatest_flow_m3ps(
    const std::vector<PlanSample>& samples);

/// At full swash and rated speed, m^3/s.
[[nodiscard]] double full_flow_m3ps(const PumpProfile& pump);

/// Displacement, velocity and acceleration of every drive over time: mm and degrees.
[[nodiscard]] std::string plan_table(const std::vector<PlanSample>& samples);

/// The same with all there is, in SI units, a column each with its name and unit.
[[nodiscard]] std::string plan_csv(const std::vector<PlanSample>& samples);

/// Figures of a planned line, a row each.
[[nodiscard]] std::string plan_summary(const ExcavatorProfile& profile, const LineRequest& request,
                                       const PlanResult& result,
                                       const std::vector<PlanSample>& samples);

/// A line for each step of a planned task, and what planning has changed of it.
[[nodiscard]] std::string task_summary(const machines::TaskFile& task);

}  // namespace graben::runs
