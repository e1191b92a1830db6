// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections [implement.answer.DRIVE.SIDE] of a dozer's file, blade and tilt: how each side of a
/// spool answers, where that is known by itself; and what the file says to have been measured.

#include <array>
#include <string>
#include <vector>

#include "app/machines/answer_section.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// Of lift and tilt, in the order of DozerBank.
inline constexpr std::array<const char*, 2> kBladeNames = {"blade", "tilt"};

/// "implement.answer.blade.extend."
[[nodiscard]] std::string blade_answer_key(std::size_t drive, bool extends);

/// Nothing said where the file has no such section.
void read_blade_answers(TomlReader& reader, DozerProfile& profile);

/// What `graben identify` leaves on what was commissioned.
struct DozerDriven {
  std::array<DrivenRanges, 2> blade;  ///< Lift and tilt, shares of the duty.
  DrivenRange tracks;                 ///< Displacements of the pumps, both ways.
};

[[nodiscard]] DozerDriven read_dozer_driven(TomlReader& reader, bool tilts);

/// "tilt, extend", "tracks": what the file does not say to have been measured, in its order.
[[nodiscard]] std::vector<std::string> uncommissioned(const DozerDriven& driven, bool tilts);

/// "not commissioned: tilt, extend; tracks", or what else is to be said of that.
[[nodiscard]] std::string commissioned_text(const DozerDriven& driven, bool tilts);

/// Those of which a task has to be afraid: as uncommissioned(), but none where nothing at all was
/// measured, as of a shipped profile.
[[nodiscard]] std::vector<std::string> unknown_drives(const DozerDriven& driven, bool tilts);

}  // namespace graben::machines
