// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A profile's file with how its IMUs sit.

#include <string>

#include "app/identify/imus/mounting_fit.hpp"

namespace graben::identify {

/// The text with each `turn` of [imu] as it was found, and with its deviation and `from` (log,
/// hash, date) in [provenance]. Throws std::runtime_error where the text has no [imu] of its own.
[[nodiscard]] std::string mounting_text(const std::string& old_text, const MountingFit& fit,
                                        const std::string& from);

}  // namespace graben::identify
