// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/soil_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware/dozer/grade_profile.hpp"

namespace graben::machines {

namespace {

/// The simulated ground is level at z = 0, and a blade only cuts.
constexpr double kFill_m = 0.02;
/// So that what is refused shows it in the digits that are printed.
constexpr double kRounding_m = 1e-4;

/// In a soil of which nobody knows how hard it is: what a first pass tries.
constexpr double kFirstPass_m = 0.08;

/// A file has 900 rpm with two decimals of a rad/s.
constexpr double kRounding_radps = 0.01;

void demand_something_to_cut(const SimulatedDozer& machine) {
  constexpr double kStep_m = 0.05;
  const GradeProfile design(machine.profile.grade);
  for (int step = 0; step * kStep_m <= machine.experiment.length_m; ++step) {
    // Of the edge's higher end.
    const double height_m =
        design.at(step * kStep_m).height_m +
        machine.profile.tilt.half_width_m() * std::abs(design.cross_at(step * kStep_m).slope);
    if (height_m > kFill_m + kRounding_m) {
      throw std::runtime_error(fmt::format(
          "the design is {:.4f} m above the simulated ground at x = {:.2f} m; allowed: at "
          "most {} m, as a blade only cuts",
          height_m, step * kStep_m, kFill_m));
    }
  }
}

/// The ground before the design's begin stays: what is deeper there is a wall that the machine
/// stands above, and then drives down.
void demand_a_way_in(const SimulatedDozer& machine) {
  const GradeProfile design(machine.profile.grade);
  const double begin_m = std::max(0.0, machine.profile.grade.begin_m());
  const double depth_m = -design.at(begin_m).height_m;
  const double reach_m = -machine.profile.blade.edge_min_m;
  if (depth_m > reach_m) {
    throw std::runtime_error(fmt::format(
        "the design begins {:.3f} m below the simulated ground at x = {:.2f} m, in no number of "
        "passes to be reached from there; allowed: at most the blade's reach, {} m, or a ramp "
        "that leads down from the ground",
        depth_m, begin_m, reach_m));
  }
}

}  // namespace

SimulatedDozer arranged(SimulatedDozer machine, const DozerScenario& scenario) {
  demand_something_to_cut(machine);
  demand_a_way_in(machine);
  if (scenario.errors) {
    machine.plant = draw_dozer(machine, scenario.seed);
  }
  if (scenario.engine_radps) {
    HstProfile& hst = machine.plant.machine.hst;
    if (*scenario.engine_radps < hst.engine_least_radps - kRounding_radps ||
        *scenario.engine_radps > hst.engine_most_radps + kRounding_radps) {
      throw std::runtime_error(
          fmt::format("an engine speed of {:.2f} rad/s; the profile allows {} .. {} rad/s",
                      *scenario.engine_radps, hst.engine_least_radps, hst.engine_most_radps));
    }
    hst.engine_radps = *scenario.engine_radps;
  }
  if (!scenario.soil.empty()) {
    machine.plant.soil = ground_of(scenario.soil, scenario.errors, scenario.seed);
    GradeDesign& grade = machine.profile.grade;
    grade.pass_depth_m = std::min(grade.pass_depth_m, kFirstPass_m);
  }
  machine.profile.grade.pass_depth_m =
      scenario.pass_depth_m.value_or(machine.profile.grade.pass_depth_m);
  if (scenario.dead_time_s) {
    machine.profile.control.dead_time_s = *scenario.dead_time_s;
    machine.plant.dead_time_s = *scenario.dead_time_s;
  }
  if (scenario.pose_latency_s) {
    machine.profile.control.pose_latency_s = *scenario.pose_latency_s;
    machine.plant.sensors.pose_latency_s = *scenario.pose_latency_s;
  }
  if (scenario.policy == SpeedPolicy::kConstant) {
    machine.profile.grade.passes_most = 1;  // What it leaves is what is compared.
  }
  TravelProfile& travel = machine.profile.travel;
  travel.policy = scenario.policy;
  travel.speed_desired_mps = scenario.speed_mps.value_or(travel.speed_desired_mps);
  // v_min is what a limit may not go below, not what the operator may not.
  travel.speed_min_mps = std::min(travel.speed_min_mps, travel.speed_desired_mps);
  return machine;
}

}  // namespace graben::machines
