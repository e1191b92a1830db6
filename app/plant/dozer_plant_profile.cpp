#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

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
