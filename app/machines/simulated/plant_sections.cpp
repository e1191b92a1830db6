#include <array>
#include <string>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/shared_sections.hpp"

namespace graben::machines {
namespace {

plant::LinkBody read_link(TomlReader& reader, const std::string& axis) {
  plant::LinkBody link;
  link.mass_kg = reader.number(axis + ".mass", {10.0, 1e5, "kg"});
  link.inertia_kgm2 = reader.number(axis + ".inertia", {1.0, 1e6, "kg m2"});
  link.mass_centre_m = reader.point(axis + ".mass_centre", {-10.0, 10.0, "m"});
  return link;
}

void read_swing(TomlReader& reader, plant::ExcavatorPlantProfile& plant) {
  plant.platform.inertia_kgm2 = reader.number("swing.inertia", {100.0, 1e6, "kg m2"});
  plant.platform.coulomb_nm = reader.number("swing.coulomb", {0.0, 1e6, "N m"});
  plant.platform.viscous_nmsprad = reader.number("swing.viscous", {0.0, 1e6, "N m s/rad"});
  plant.swing_motor.dead_volume_m3 = reader.number("swing.dead_volume", {1e-5, 1.0, "m3"});
  plant.swing_motor.leak_m3pspa = reader.number("swing.leak", {0.0, 1e-9, "m3/(s Pa)"});
  plant.swing_motor.port_relief_pa = reader.number("swing.port_relief", {1e6, 1e8, "Pa"});
}

plant::SensorErrors read_sensors(TomlReader& reader, const ExcavatorProfile& nominal) {
  plant::SensorErrors sensors;
  sensors.stroke_resolution_m = reader.number("sensors.stroke_resolution", {0.0, 0.01, "m"});
  sensors.stroke_bias_m = reader.number("sensors.stroke_bias", {0.0, 0.05, "m"});
  if (nominal.has_swing()) {
    sensors.swing_resolution_rad = reader.number("sensors.swing_resolution", {0.0, 0.01, "rad"});
    sensors.swing_bias_rad = reader.number("sensors.swing_bias", {0.0, 0.05, "rad"});
  }
  sensors.pressure_range_pa = nominal.safety.pressure_rail_pa;
  sensors.pressure_bias_ratio = reader.number("sensors.pressure_bias", {0.0, 0.5, ""});
  sensors.pressure_noise_ratio = reader.number("sensors.pressure_noise", {0.0, 0.5, ""});
  return sensors;
}

}  // namespace

plant::ExcavatorPlantProfile read_plant_sections(TomlReader& reader,
                                                 const ExcavatorProfile& nominal) {
  plant::ExcavatorPlantProfile plant;
  plant.machine = nominal;
  const std::vector<double> coulomb =
      reader.numbers("friction.coulomb", {0.0, 1e6, "N"}, kAxisCount);
  const std::vector<double> viscous =
      reader.numbers("friction.viscous", {0.0, 1e7, "N s/m"}, kAxisCount);
  const std::vector<double> dead_volume =
      reader.numbers("valve.dead_volume", {1e-5, 1.0, "m3"}, kAxisCount);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    plant.link[i] = read_link(reader, kAxisNames[i]);
    plant.friction[i] = {coulomb[i], viscous[i]};
    plant.dead_volume_m3[i] = dead_volume[i];
  }
  plant.line_volume_m3.fill(reader.number("valve.line_volume", {1e-5, 1.0, "m3"}));
  read_valve_of_plant(reader, "valve", plant);
  plant.port_relief_pa = reader.number("valve.port_relief", {1e6, 1e8, "Pa"});
  if (nominal.has_swing()) {
    read_swing(reader, plant);
  }
  plant.swash_ratio = nominal.dig_swash_ratio;
  plant.dead_time_s.fill(nominal.control.dead_time_s);
  plant.sensors = read_sensors(reader, nominal);
  return plant;
}

}  // namespace graben::machines
