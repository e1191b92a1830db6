// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ground as built, as one HTML page that opens without a network: figures and a map in colours.

#include <optional>
#include <string>

#include "app/built/built_files.hpp"

namespace graben::reports {

/// Colours are heights over the design, of one without a design heights. `notes` are sentences.
[[nodiscard]] std::string built_page(const built::BuiltGround& ground, const built::BuiltHead& head,
                                     const std::optional<built::DesignFigures>& design,
                                     const std::vector<std::string>& notes);

}  // namespace graben::reports
