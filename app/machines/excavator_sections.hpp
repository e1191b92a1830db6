#pragma once
/// The sections of an excavator's TOML file.

#include "app/machines/simulated/experiment.hpp"
#include "app/machines/toml_reader.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// What the controller knows: geometry, pumps, valve, control, path.
[[nodiscard]] ExcavatorProfile read_controller_sections(TomlReader& reader);

/// What only the simulated machine has, beside the nominal data in `nominal`.
[[nodiscard]] plant::ExcavatorPlantProfile read_plant_sections(TomlReader& reader,
                                                               const ExcavatorProfile& nominal);

/// A path at this key.
[[nodiscard]] DigPath read_path(TomlReader& reader, const std::string& at);
/// What can be tried on it; the obstacle stands on `path`.
[[nodiscard]] Experiment read_experiment_sections(TomlReader& reader, const DigPath& path);
/// Checks that need more than one key: both paths and the line lie in the work space, angle ranges
/// fit the stroke ends, orifices and tables fit each other. They are made only where
/// each key by itself is right.
void check_across_keys(TomlReader& reader, const ExcavatorProfile& profile,
                       const Experiment& experiment);

}  // namespace graben::machines
