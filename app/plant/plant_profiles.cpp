// SPDX-License-Identifier: Apache-2.0
// Cylinders and swing motor as the profiles describe them.

#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/excavator_plant_profile.hpp"

namespace graben::plant {

CylinderData ExcavatorPlantProfile::cylinder(int axis) const {
  const auto index = static_cast<std::size_t>(axis);
  const CylinderGeometry& geometry = machine.geometry.cylinder[index];
  CylinderData data;
  data.area = piston_areas(geometry.count, geometry.bore_m, geometry.rod_m);
  data.stroke_m = geometry.stroke_m;
  data.dead_volume_m3 = dead_volume_m3[index];
  data.bulk_modulus_pa = bulk_modulus_pa;
  data.friction = friction[index];
  data.cushion = {cushion_length_m, cushion_end_m, cushion_speed_mps, cushion_pressure_pa};
  data.details = details();
  return data;
}

SwingMotorData ExcavatorPlantProfile::motor() const {
  SwingMotorData data;
  data.displacement_m3prad = machine.swing.displacement_m3prad;
  data.chamber_volume_m3 = swing_motor.dead_volume_m3;
  data.leak_m3pspa = swing_motor.leak_m3pspa;
  data.start_pa = start_back_pressure_pa;
  data.oil = oil();
  return data;
}

SectionData ExcavatorPlantProfile::section(int drive) const {
  const auto index = static_cast<std::size_t>(drive);
  const AreaFactors& factors = area_factors[index];
  SpoolProfile edges = machine.valve.spool[index];
  edges.extend_in_m2 *= factors.extend_in;
  edges.extend_out_m2 *= factors.extend_out;
  edges.retract_in_m2 *= factors.retract_in;
  edges.retract_out_m2 *= factors.retract_out;
  const PumpRegulator& by = machine.pump[static_cast<std::size_t>(edges.pump)].regulator;
  return {edges,
          static_cast<const SpoolMetering&>(machine.valve),
          spool[index],
          port_protection(drive),
          hose_linear_paspm3,
          hose_quadratic_pas2pm6,
          by.compensated ? by.margin_pa : 0.0,
          by.sets_swash()};
}

PumpLineData ExcavatorPlantProfile::pump_line(int pump) const {
  const auto index = static_cast<std::size_t>(pump);
  PumpProfile data = machine.pump[index];
  data.displacement_m3prev *= pump_flow_ratio[index];
  return {data,    oil(), protection(data.relief_pa), line_volume_m3[index], swash_ratio[index],
          step_s()};
}

CylinderData DozerPlantProfile::blade_cylinder(double stroke_m) const {
  const BladeGeometry& blade = machine.blade;
  CylinderData data;
  data.area = piston_areas(blade.cylinder_count, blade.bore_m, blade.rod_m);
  data.stroke_m = stroke_m;
  data.dead_volume_m3 = dead_volume_m3;
  data.bulk_modulus_pa = bulk_modulus_pa;
  data.friction = {coulomb_n, viscous_nspm};
  data.details = details();
  return data;
}

}  // namespace graben::plant
