// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The soils that a simulated excavator can dig in.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/plant/soil/soil_kind.hpp"

namespace graben::machines {

inline constexpr std::array<std::string_view, 4> kSoilNames = {"sand", "loam", "clay", "stones"};

/// One of kSoilNames; nothing for another name. Beside each stands where its values are from.
[[nodiscard]] std::optional<plant::SoilKind> soil_kind(std::string_view name);

/// The same soil with strength, friction and density each times its own factor.
struct SoilFactors {
  double density = 1.0;
  double cohesion = 1.0;
  double adhesion = 1.0;
  double friction = 1.0;       ///< Of tan(phi).
  double wall_friction = 1.0;  ///< Of tan(delta).
};
[[nodiscard]] plant::SoilKind scaled(const plant::SoilKind& soil, const SoilFactors& factors);

/// The soil of this name; `drawn`, each strength off by up to 40 %, each way, and its density by
/// 15 %. Throws std::runtime_error for a name that is none.
[[nodiscard]] plant::SoilKind ground_of(const std::string& name, bool drawn, std::uint64_t seed);

}  // namespace graben::machines
