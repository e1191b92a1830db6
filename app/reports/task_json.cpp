// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/machines/fence_tables.hpp"
#include "app/machines/task_text.hpp"
#include "app/reports/page_setup.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

json vector(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

json pose_json(const TeethPose& teeth) {
  return {{"position_m", vector(teeth.position_m)}, {"attitude_rad", rounded(teeth.attitude_rad)}};
}

json drives_json(const DriveVector& drives) {
  json values = json::array();
  for (const double value : drives) {
    values.push_back(rounded(value));
  }
  return values;
}

/// An end of a step; a program that was planned has no blind spots.
struct End {
  TeethPose teeth;
  DriveVector drives;
};

End end_of(const SwingKinematics& kinematics, const TaskStep& step, double time_s) {
  if (step.straight) {
    const PlanState state = plan_state(kinematics, step.line, time_s);
    return {state.teeth, state.by_share.value};
  }
  const DriveVector drives = drive_state(step.drives, time_s).value;
  return {kinematics.teeth_from_joints(kinematics.joints_from_drive(drives).value), drives};
}

json step_json(const SwingKinematics& kinematics, const TaskStep& step, const StepNote& note) {
  const End from = end_of(kinematics, step, 0.0);
  const End to = end_of(kinematics, step, step.duration_s());
  return {{"kind", machines::step_name(step.kind)},
          {"straight", step.straight},
          {"from", pose_json(from.teeth)},
          {"to", pose_json(to.teeth)},
          {"from_drives", drives_json(from.drives)},
          {"to_drives", drives_json(to.drives)},
          {"duration_s", rounded(step.duration_s())},
          {"raised_from_m", rounded(note.raised_from_m)},
          {"raised_to_m", rounded(note.raised_to_m)}};
}

json fences_json(const FenceSet& fences, bool has_design) {
  json result = json::array();
  for (int i = 0; i < fences.count; ++i) {
    const Fence& fence = fences.fence[static_cast<unsigned>(i)];
    const bool is_design = has_design && i + 1 == fences.count;
    json told = {{"words", is_design ? "design surface" : machines::fence_text(fence)}};
    if (fence.is_plane()) {
      told["normal"] = vector(fence.normal);
      told["offset_m"] = rounded(fence.offset_m);
    } else if (!fence.is_surface()) {
      told["round"] = fence.shape == FenceShape::kCylinder;
      told["centre_m"] = vector(fence.centre_m);
      told["half_m"] = vector(fence.half_m);
      told["turn_rad"] = rounded(std::atan2(fence.normal.y(), fence.normal.x()));
    }
    result.push_back(told);
  }
  return result;
}

/// Between two heights for the page, at most, m: of a design's rounded kinks (kUsualRounding_m) it
/// then draws 3 mm off where 1:2 meets 1:2.
constexpr double kShownStep_m = 0.05;

/// The controller's own heights, in its counts: each is told less the known one before it, the
/// first less 0; null: there is none.
json surface_json(const DesignSurface& surface) {
  const int stride = std::max(1, static_cast<int>(kShownStep_m / surface.step_m + 0.01));
  json heights = json::array();
  int before = 0;
  for (int row = 0; row < surface.rows; row += stride) {
    for (int column = 0; column < surface.columns; column += stride) {
      const int height = surface.height[row * surface.columns + column];
      if (height == DesignSurface::kNone) {
        heights.push_back(nullptr);
      } else {
        heights.push_back(height - before);
        before = height;
      }
    }
  }
  return {{"columns", (surface.columns + stride - 1) / stride},
          {"rows", (surface.rows + stride - 1) / stride},
          {"step_m", rounded(stride * surface.step_m)},
          {"unit_m", DesignSurface::kUnit_m},
          {"base_m", rounded(surface.base_m)},
          {"machine_m", {rounded(surface.machine_m.x()), rounded(surface.machine_m.y())}},
          {"heading_rad", std::atan2(surface.sine, surface.cosine)},
          {"heights", heights}};
}

}  // namespace

json task_json(const machines::TaskFile& task, const ExcavatorProfile& profile) {
  const SwingKinematics kinematics(profile.geometry);
  const TaskProgram& program = task.result.program;
  json result = {
      {"name", task.name}, {"steps", json::array()}, {"design", nullptr}, {"surface", nullptr}};
  for (int i = 0; i < program.step_count; ++i) {
    const auto k = static_cast<unsigned>(i);
    result["steps"].push_back(step_json(kinematics, program.step[k], task.result.note[k]));
  }
  result["fences"] =
      fences_json(program.fences, task.request.has_design || task.surface != nullptr);
  if (task.request.has_design) {
    const DesignPlane& design = task.request.design;
    result["design"] = {{"through_m", vector(design.through_m)}, {"up", vector(design.up)}};
  }
  if (task.surface != nullptr) {
    result["surface"] = surface_json(task.surface->surface);
  }
  return result;
}

}  // namespace graben::reports
