#include "app/machines/dozer_file.hpp"

#include <algorithm>

#include "app/machines/dozer_sections.hpp"
#include "app/machines/profile_document.hpp"
#include "app/plant/random.hpp"

namespace graben::machines {

DozerMachine load_dozer(const ProfileDocument& document) {
  return load_machine<DozerMachine>(
      document, MachineKind::kDozer, [](TomlReader& reader, DozerMachine& machine) {
        machine.profile = read_dozer_controller_sections(reader);
        machine.plant = read_dozer_plant_sections(reader, machine.profile);
        machine.experiment = read_dozer_experiment_sections(reader);
        check_dozer_across_keys(reader, machine.profile, machine.experiment);
      });
}

DozerMachine load_dozer(const std::filesystem::path& file) {
  return load_dozer(read_document(file));
}

plant::DozerPlantProfile draw_dozer(const DozerMachine& machine, std::uint64_t seed) {
  const DozerUncertainty& uncertainty = machine.experiment.uncertainty;
  plant::DozerPlantProfile plant = machine.plant;
  plant::Random random(seed, plant::Draw::kParameters);
  const double mass = 1.0 + random.symmetric(uncertainty.mass);
  for (double* kg : {&plant.machine.body.mass_kg, &plant.blade_mass_kg}) {
    *kg *= mass;
  }
  plant.pitch_inertia_kgm2 *= mass;
  for (double* share : {&plant.ground.friction, &plant.ground.rolling_resistance}) {
    *share *= 1.0 + random.symmetric(uncertainty.friction);
  }
  for (double* efficiency :
       {&plant.machine.implement.efficiency, &plant.machine.hst.pump_efficiency,
        &plant.machine.hst.motor_efficiency}) {
    *efficiency = std::min(*efficiency * (1.0 + random.symmetric(uncertainty.efficiency)), 1.0);
  }
  plant.sensor_errors = true;
  plant.seed = seed;
  return plant;
}

}  // namespace graben::machines
