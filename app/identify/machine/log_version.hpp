// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Logs of earlier versions of the DBC. A kind's own version is read, and those from its oldest on:
/// before `five_bits` EcuStatus had four bits for Mode and four for LimitKind; every other frame is
/// the same. Later versions only have messages more: 12 second sensors', of a dozer 9 none, 10
/// those of its commissioning; or more in what was left free: 13, a dozer's 11, what of a site is
/// touched. A log of each is kept in tests/old_logs; the page's rule is in its
/// model/dbc.ts.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/identify/machine/candump_reader.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::identify {

/// Of a kind.
struct DbcVersions {
  std::uint32_t own;
  std::uint32_t oldest;     ///< That is read.
  std::uint32_t five_bits;  ///< The first whose LimitKind has them.
};
inline constexpr DbcVersions kExcavatorVersions{dbc::excavator::kDbcVersion, 10, 11};
inline constexpr DbcVersions kDozerVersions{dbc::dozer::kDbcVersion, 7, 8};

[[nodiscard]] constexpr bool is_read(std::uint32_t version, const DbcVersions& of) {
  return version >= of.oldest && version <= of.own;
}
/// "this tool reads versions 10 to 13"
[[nodiscard]] std::string read_versions(const DbcVersions& of);

/// As read_candump(), each frame as this version has it. The version is what the controller says
/// (EcuIdentity, once a second); where it does not within two seconds, the log is taken for one of
/// this version. Throws std::runtime_error with the versions where it says one that is not read,
/// or one with another EcuStatus too late.
LogRead read_versioned(const std::filesystem::path& file,
                       const std::function<void(const LoggedFrame&)>& take);

}  // namespace graben::identify
