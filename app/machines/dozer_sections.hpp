#pragma once
/// The sections of a dozer's TOML file.

#include "app/machines/dozer_file.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {

/// What the controller knows: body, blade, flows, transmission, travel, grade, watches.
[[nodiscard]] DozerProfile read_dozer_controller_sections(TomlReader& reader);

/// What only the simulated machine has, beside the nominal data in `nominal`.
[[nodiscard]] plant::DozerPlantProfile read_dozer_plant_sections(TomlReader& reader,
                                                                 const DozerProfile& nominal);

[[nodiscard]] DozerExperiment read_dozer_experiment_sections(TomlReader& reader);

/// Checks that need more than one key: the blade's linkage closes over its whole reach, the engine
/// is within its range, the grade can be driven and rounded. They are made only where each key by
/// itself is right.
void check_dozer_across_keys(TomlReader& reader, const DozerProfile& profile,
                             const DozerExperiment& experiment);

}  // namespace graben::machines
