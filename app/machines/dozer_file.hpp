// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's profile: as excavator_file.hpp for the excavator.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/machines/blade_answers.hpp"
#include "app/machines/profile_file.hpp"
#include "app/machines/provenance.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// A design's heights on the controller's grid, which the profile points to.
struct DesignHeights {
  double from_m = 0.0;
  std::shared_ptr<const std::vector<double>> height_m;   ///< None: the profile has points.
  std::shared_ptr<const std::vector<double>> cross;      ///< None: level across.
  std::shared_ptr<const std::vector<double>> curvature;  ///< None: a straight track.
};

/// A dozer as its controller has to know it. Its profile and copies of it are good as long as this
/// or a copy of this is there.
struct DozerMachine {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< Of the checked values (TomlReader::hash); on the bus as ProfileHash.
  DozerProfile profile;
  DozerDriven driven;                  ///< What was commissioned, as far as said.
  DesignHeights design;                ///< Of a design in a file of its own.
  std::vector<Provenance> provenance;  ///< Where its values are from, as far as said.
};

/// Reads and checks a dozer's profile. Throws ProfileError with every error found.
[[nodiscard]] DozerMachine load_dozer(const std::filesystem::path& file);
[[nodiscard]] DozerMachine load_dozer(const ProfileDocument& document);

}  // namespace graben::machines
