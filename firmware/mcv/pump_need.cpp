// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/pump_need.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/mcv/evaluation.hpp"

namespace graben {
namespace {

/// Steps to a line's pressure and its return gallery's, which falls with it. [-; size: from the
/// drain's pressure alone, the most that it can be, each comes nearer from above]
constexpr int kGallerySteps = 6;

/// sqrt of the line's pressure at which the axis has the force that it needs and the reserve, in
/// either direction: a correction may ask for the other one.
double needed_sqrt_pressure(const CircuitAxis& axis, const PumpAim& aim) {
  const double reserve_n = aim.reserve_n + aim.reserve_share * std::abs(axis.load_force_n);
  const double wanted_n = needed_force_n(axis, aim.lambda) + reserve_n;
  const double back_n = reserve_n + axis.force_offset_n - axis.load_force_n;
  double pressure_pa = aim.most_pa;
  for (int step = 0; step < kGallerySteps; ++step) {
    const DriveForce drive = drive_force(axis, aim.lambda, std::sqrt(pressure_pa));
    pressure_pa += (wanted_n - drive.force_n) / axis.inlet_area_m2;
    pressure_pa = std::clamp(pressure_pa, 0.0, aim.most_pa);
  }
  return std::sqrt(std::clamp(back_n / axis.outlet_area_m2, pressure_pa, aim.most_pa));
}

}  // namespace

PerPump<double> needed_flow_m3ps(const McvMachine& machine, const McvInput& input,
                                 const PumpAim& aim) {
  const McvCircuit circuit = make_circuit(machine, input);
  PerPump<double> sqrt_pressure{};
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves) {
      double& most = sqrt_pressure[axis.pump];
      most = std::max(most, needed_sqrt_pressure(axis, aim));
    }
  }
  PerPump<double> flow_m3ps{};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    FlowBalance line = circuit.line[j];
    line.flow_m3ps = 0.0;
    flow_m3ps[j] = std::max(0.0, -flow_left(line, aim.lambda, sqrt_pressure[j]));
  }
  return flow_m3ps;
}

}  // namespace graben
