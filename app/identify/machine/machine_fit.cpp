// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/machine_fit.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/identify/machine/prediction_score.hpp"
#include "app/identify/machine/spool_answer.hpp"
#include "app/identify/machine/touches.hpp"
#include "app/identify/machine/valve_fit.hpp"
#include "app/machines/axis_names.hpp"

namespace graben::identify {
namespace {

/// A duty below which nearly nothing of the valve's range was tried.
constexpr double kWholeRange = 0.9;

SideEstimate side_of(const DriveModel& model) {
  SideEstimate side;
  side.edge.value = model.answer.edge();
  side.exponent.value = model.metering.opening_exponent;
  side.coefficient_factor.value = 1.0;
  side.out_area_factor.value = 1.0;
  side.dead_time_s.value = model.answer.dead_time_s;
  return side;
}

void tell_side(const std::string& of, const SideEstimate& side, std::vector<std::string>& missing) {
  if (side.driven_most == 0.0) {
    missing.push_back(of + ": was not driven");
    return;
  }
  if (side.driven_most < kWholeRange) {
    missing.push_back(
        fmt::format("{}: nothing beyond {:.0f} % was driven", of, 100.0 * side.driven_most));
  }
  const auto keep = [&](const Estimate& estimate, const char* what) {
    if (!estimate.known) {
      missing.push_back(fmt::format("{}: {} keeps its old value", of, what));
    }
  };
  // What belongs to the curve is written with it.
  const auto doubt = [&](const Estimate& estimate, const char* what) {
    if (!side.edge.known) {
      keep(estimate, what);
    } else if (!estimate.known) {
      missing.push_back(fmt::format("{}: {} is known within {:.0f} % only", of, what,
                                    100.0 * estimate.deviation / estimate.value));
    }
  };
  keep(side.edge, "the edge");
  doubt(side.exponent, "how it opens");
  doubt(side.coefficient_factor, "how fast it is");
  doubt(side.out_area_factor, "the area of its draining side");
  keep(side.dead_time_s, "the dead time");
}

void tell_missing(const DriveModel& model, MachineEstimate& machine) {
  for (std::size_t axis = 0; axis < model.drives(); ++axis) {
    const DriveEstimate& drive = machine.drive[axis];
    tell_side(machines::side_name(static_cast<int>(axis), true), drive.extend, machine.missing);
    tell_side(machines::side_name(static_cast<int>(axis), false), drive.retract, machine.missing);
    if (axis == kSwing) {
      continue;
    }
    const auto keep = [&](const Estimate& estimate, const char* what) {
      if (!estimate.known) {
        machine.missing.push_back(fmt::format("{}: {}", kAxisTexts[axis], what));
      }
    };
    keep(drive.stroke_zero_m, "no end of its stroke was touched: the stroke's zero stays");
    keep(drive.cap_zero_pa, "the zero of its cap pressure stays open");
    keep(drive.rod_zero_pa, "the zero of its rod pressure stays open");
    keep(drive.spool_time_constant_s, "no spool is measured: lags keep their old values");
  }
  for (int j = 0; j < model.valve.pump_count; ++j) {
    if (!machine.pump_flow_factor[static_cast<std::size_t>(j)].known) {
      machine.missing.push_back(fmt::format("pump {}: its flow keeps its old value", j + 1));
    }
  }
}

void tell_falling(MachineEstimate& machine) {
  if (!machine.bypass_closes_at.known) {
    machine.missing.emplace_back(
        "the opening at which the bypass is closed is hardly known better than before");
  }
  if (!machine.regulator[0].full_swash_pa.known) {
    machine.missing.emplace_back(
        "the pumps' two pressures are hardly known better than before: no drive has moved between "
        "them for long enough");
  }
  machine.missing.emplace_back(
      "the pumps' least swash and response, and the bypass' orifices, keep their old values: no "
      "line's pressure is in the logs");
}

/// What of its regulator no log says, as pressures of lines are on no bus.
void tell_regulators(const DriveModel& model, MachineEstimate& machine) {
  if (model.pump_kind() == PumpKind::kPositive) {
    return;
  }
  if (model.pump_kind() == PumpKind::kNegativeFlow) {
    tell_falling(machine);
    return;
  }
  for (int j = 0; j < model.valve.pump_count; ++j) {
    machine.missing.push_back(fmt::format(
        "pump {}: its margin and its response keep their old values: no line's pressure "
        "is in the logs; what the margin is off, the areas have taken up",
        j + 1));
  }
}

bool any_driven(const MachineEstimate& machine) {
  bool any = false;
  for (const DriveEstimate& drive : machine.drive) {
    any = any || drive.extend.driven_most > 0.0 || drive.retract.driven_most > 0.0;
  }
  return any;
}

}  // namespace

MachineEstimate estimate_of(const DriveModel& model) {
  MachineEstimate machine;
  for (DriveEstimate& drive : machine.drive) {
    drive.extend = side_of(model);
    drive.retract = side_of(model);
    drive.spool_time_constant_s.value = model.answer.spool_time_constant_s;
  }
  for (Estimate& factor : machine.pump_flow_factor) {
    factor.value = 1.0;
  }
  return machine;
}

MachineEstimate identify_machine(const DriveModel& model, const std::vector<MachineLog>& logs,
                                 const MachineProgress& progress) {
  MachineEstimate machine = estimate_of(model);
  for (int axis = 0; axis < static_cast<int>(model.drives()); ++axis) {
    progress(0.12 * axis,
             fmt::format("{}: dead time and lags", kAxisTexts[static_cast<unsigned>(axis)]));
    find_spool_answer(logs, axis, machine.drive[static_cast<unsigned>(axis)]);
  }
  progress(0.5, "zeros of sensors");
  const std::vector<SteadyPoint> points = steady_points(logs, model);
  find_zeros(logs, model, points, machine);
  progress(0.55, "curves and pumps");
  fit_valves(model, points, {}, machine);
  if (!any_driven(machine)) {
    throw std::runtime_error("no cylinder moves steadily anywhere in the logs");
  }
  tell_missing(model, machine);
  tell_regulators(model, machine);
  progress(1.0, "done");
  return machine;
}

}  // namespace graben::identify
