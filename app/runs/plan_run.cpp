// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plan_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/task_text.hpp"
#include "app/runs/figures.hpp"
#include "firmware/excavator/fences/machine_points.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

using machines::kDriveNames;

constexpr double kLpm = 6e4;

/// Of all that a sample tells but its time and way, from the drives' motion.
void tell_drives(const ExcavatorProfile& profile, const DriveState& drives, PlanSample& sample) {
  for (unsigned i = 0; i < kDriveCount; ++i) {
    sample.displacement[i] = drives.value[i];
    sample.velocity[i] = drives.velocity[i];
    sample.acceleration[i] = drives.acceleration[i];
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    const double area_m2 =
        sample.velocity[i] > 0.0 ? cylinder.cap_area_m2() : cylinder.rod_area_m2();
    sample.flow_m3ps[static_cast<unsigned>(profile.valve.spool[i].pump)] +=
        area_m2 * std::abs(sample.velocity[i]);
  }
}

void tell_teeth(const TeethPose& teeth, PlanSample& sample) {
  sample.attitude_rad = teeth.attitude_rad;
  for (unsigned i = 0; i < 3; ++i) {
    sample.teeth_m[i] = teeth.position_m[i];
  }
}

/// mm of a stroke, degrees of the swing; no negative zero.
double shown(unsigned drive, double value) {
  return value * (drive == kSwing ? kDegreesPerRad : 1e3) + 0.0;
}
const char* unit(unsigned drive) { return drive == kSwing ? "deg" : "mm"; }

PlanSample sample_at(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     const LinePlan& plan, double time_s) {
  const PlanState state = plan_state(kinematics, plan, time_s);
  PlanSample sample;
  sample.time_s = time_s;
  sample.way_m = state.progress.share * plan.line.change.position_m.norm();
  sample.speed_mps = state.teeth_velocity_mps.norm();
  tell_teeth(state.teeth, sample);
  tell_drives(profile, {state.progress, state.by_share.value, state.velocity, state.acceleration},
              sample);
  return sample;
}

/// Of a move of the drives; its way is the next one's to tell.
PlanSample sample_at(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     const DrivePlan& plan, double time_s) {
  const DriveState state = drive_state(plan, time_s);
  PlanSample sample;
  sample.time_s = time_s;
  tell_teeth(kinematics.teeth_from_joints(kinematics.joints_from_drive(state.value).value), sample);
  const MachineMotion motion = machine_motion(kinematics, state.value, state.velocity);
  sample.speed_mps = motion.point[static_cast<unsigned>(MachinePoint::kTeeth)].velocity_mps.norm();
  tell_drives(profile, state, sample);
  return sample;
}

/// Times of samples: from 0 to the plan's end, which is the last one whatever the step.
std::vector<double> times_s(double duration_s, double step_s) {
  // A step that ends within rounding of the plan's end is its end.
  const auto whole = static_cast<long>(std::ceil(duration_s / step_s - 1e-9));
  std::vector<double> times;
  for (long i = 0; i <= whole; ++i) {
    times.push_back(i < whole ? static_cast<double>(i) * step_s : duration_s);
  }
  return times;
}

std::string drive_lines(const PlanResult& result, const std::vector<PlanSample>& samples) {
  std::string lines = fmt::format("{:<10}{:>10}{:>10}{:>14}{:>10}{:>14}{:>10}\n", "drive", "from",
                                  "to", "peak speed", "of limit", "acceleration", "of limit");
  for (unsigned i = 0; i < kDriveCount; ++i) {
    lines +=
        fmt::format("{:<10}{:>10.1f}{:>10.1f}{:>14.1f}{:>8.1f} %{:>14.1f}{:>8.1f} %  {}\n",
                    kDriveNames[i], shown(i, samples.front().displacement[i]),
                    shown(i, samples.back().displacement[i]), shown(i, result.peaks.speed[i]),
                    100.0 * result.peaks.speed_ratio[i], shown(i, result.peaks.acceleration[i]),
                    100.0 * result.peaks.acceleration_ratio[i], unit(i));
  }
  return lines;
}

}  // namespace

std::vector<PlanSample> sample_plan(const ExcavatorProfile& profile,
                                    const SwingKinematics& kinematics, const LinePlan& plan,
                                    double step_s) {
  std::vector<PlanSample> samples;
  for (const double time_s : times_s(plan.ramp.duration_s, step_s)) {
    samples.push_back(sample_at(profile, kinematics, plan, time_s));
  }
  return samples;
}

std::vector<PlanSample> sample_task(const ExcavatorProfile& profile,
                                    const SwingKinematics& kinematics, const TaskProgram& program,
                                    double step_s) {
  std::vector<PlanSample> samples;
  double began_s = 0.0;
  double way_m = 0.0;
  for (int i = 0; i < program.step_count; ++i) {
    const TaskStep& step = program.step[static_cast<unsigned>(i)];
    for (const double time_s : times_s(step.duration_s(), step_s)) {
      PlanSample sample = step.straight ? sample_at(profile, kinematics, step.line, time_s)
                                        : sample_at(profile, kinematics, step.drives, time_s);
      if (!samples.empty()) {
        way_m += (Eigen::Vector3d(sample.teeth_m.data()) -
                  Eigen::Vector3d(samples.back().teeth_m.data()))
                     .norm();
      }
      sample.time_s += began_s;
      sample.way_m = way_m;
      samples.push_back(sample);
    }
    began_s += step.duration_s();
  }
  return samples;
}

std::array<double, kPumpCount> greatest_flow_m3ps(const std::vector<PlanSample>& samples) {
  std::array<double, kPumpCount> greatest{};
  for (const PlanSample& sample : samples) {
    for (unsigned j = 0; j < kPumpCount; ++j) {
      greatest[j] = std::max(greatest[j], sample.flow_m3ps[j]);
    }
  }
  return greatest;
}

double full_flow_m3ps(const PumpProfile& pump) {
  return pump.displacement_m3prev / kTwoPi * pump.rated_speed_radps;
}

std::string plan_table(const std::vector<PlanSample>& samples) {
  std::string table = fmt::format("{:>8}{:>10}", "time", "teeth");
  for (const char* name : kDriveNames) {
    table += fmt::format("{:>11}{:>9}{:>9}", name, "speed", "accel.");
  }
  table += fmt::format("\n{:>8}{:>10}", "s", "mm");
  for (unsigned i = 0; i < kDriveCount; ++i) {
    table += fmt::format("{:>11}{:>9}{:>9}", unit(i), fmt::format("{}/s", unit(i)),
                         fmt::format("{}/s2", unit(i)));
  }
  for (const PlanSample& sample : samples) {
    table += fmt::format("\n{:>8.2f}{:>10.1f}", sample.time_s, 1e3 * sample.way_m);
    for (unsigned i = 0; i < kDriveCount; ++i) {
      table += fmt::format("{:>11.2f}{:>9.2f}{:>9.2f}", shown(i, sample.displacement[i]),
                           shown(i, sample.velocity[i]), shown(i, sample.acceleration[i]));
    }
  }
  return table + "\n";
}

std::string plan_csv(const std::vector<PlanSample>& samples) {
  std::string csv = "time_s,way_m,speed_mps,x_m,y_m,z_m,attitude_rad";
  for (unsigned i = 0; i < kDriveCount; ++i) {
    const char* of = i == kSwing ? "rad" : "m";
    csv += fmt::format(",{0}_{1},{0}_{1}ps,{0}_{1}ps2", kDriveNames[i], of);
  }
  for (unsigned j = 0; j < kPumpCount; ++j) {
    csv += fmt::format(",pump{}_m3ps", j + 1);
  }
  for (const PlanSample& sample : samples) {
    std::vector<double> cells = {sample.time_s, sample.way_m, sample.speed_mps};
    cells.insert(cells.end(), sample.teeth_m.begin(), sample.teeth_m.end());
    cells.push_back(sample.attitude_rad);
    for (unsigned i = 0; i < kDriveCount; ++i) {
      cells.insert(cells.end(),
                   {sample.displacement[i], sample.velocity[i], sample.acceleration[i]});
    }
    cells.insert(cells.end(), sample.flow_m3ps.begin(), sample.flow_m3ps.end());
    std::transform(cells.begin(), cells.end(), cells.begin(),
                   [](double cell) { return plain_number(cell); });
    csv += fmt::format("\n{}", fmt::join(cells, ","));
  }
  return csv + "\n";
}

std::string plan_summary(const ExcavatorProfile& profile, const LineRequest& request,
                         const PlanResult& result, const std::vector<PlanSample>& samples) {
  const LinePlan& plan = result.plan;
  const SineRamp& ramp = plan.ramp;
  const std::string asked = request.duration_s > 0.0
                                ? fmt::format("asked for: {:.2f} s", request.duration_s)
                                : fmt::format("asked for: {:.3f} m/s at most", request.speed_mps);
  const double from_deg = kDegreesPerRad * plan.line.from.attitude_rad;
  std::string text = fmt::format(
      "line          {:>9.3f} m, attitude from {:.1f} to {:.1f} deg\n"
      "duration      {:>9.2f} s, {:.2f} s of it speeding up and as much slowing down; {}\n"
      "speed         {:>9.3f} m/s along the way at most, {:.3f} m/s2\n"
      "slowed by          {}{}\n{}",
      plan.line.change.position_m.norm(), from_deg,
      from_deg + kDegreesPerRad * plan.line.change.attitude_rad, ramp.duration_s, ramp.ramp_s,
      asked, plan.way_m * ramp.peak_rate_ps(), plan.way_m * ramp.peak_rate_change_ps2(),
      machines::plan_limit_words(result),
      result.slowed_ratio > 1.0 ? fmt::format(", to {:.3f} times the time", result.slowed_ratio)
                                : "",
      drive_lines(result, samples));
  const auto flow = greatest_flow_m3ps(samples);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    text += fmt::format("pump {}        {:>9.1f} of {:.1f} L/min at most, cylinders alone\n", j + 1,
                        kLpm * flow[j], kLpm * full_flow_m3ps(profile.pump[j]));
  }
  return text;
}

std::string task_summary(const machines::TaskFile& task) {
  const TaskProgram& program = task.result.program;
  std::string text = "step        way              planned s  slowed by\n";
  double whole_s = 0.0;
  for (int i = 0; i < program.step_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    const TaskStep& step = program.step[k];
    const StepNote& note = task.result.note[k];
    PlanResult slowed;
    slowed.slowed_by = note.slowed_by;
    slowed.drive = note.drive;
    const std::string way =
        step.straight ? fmt::format("line {:.3f} m", step.line.line.change.position_m.norm())
                      : "drives";
    text += fmt::format("{:<12}{:<17}{:>9.2f}  {}{}\n", machines::step_name(step.kind), way,
                        step.duration_s(), machines::plan_limit_words(slowed),
                        note.slowed_ratio > 1.0
                            ? fmt::format(", to {:.3f} times the time", note.slowed_ratio)
                            : "");
    if (step.until.kind != UntilKind::kEnd) {
      text += fmt::format("{:12}at most: until {}\n", "", machines::until_name(step.until.kind));
    }
    whole_s += step.duration_s();
  }
  text += fmt::format("{:<12}{:<17}{:>9.2f}\n", "all", "", whole_s);
  if (const RoundsPlan& rounds = program.rounds; rounds.is_bounded()) {
    const Eigen::Vector3d& by_m = rounds.offset_m;
    text += fmt::format("{} rounds, each digs {:.3f}, {:.3f}, {:.3f} m farther\n", rounds.count,
                        by_m.x(), by_m.y(), by_m.z());
  }
  return text + machines::raised_text(task.request, task.result);
}

}  // namespace graben::runs
