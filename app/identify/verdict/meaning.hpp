// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a column or a signal is, by its name: the drive, whether it is its command or its motion,
/// and the unit. A guess, which its reader is told.

#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace graben::identify {

/// In the order in which drives are shown.
inline constexpr std::array<const char*, 9> kDriveNames = {
    "boom", "arm", "bucket", "swing", "blade", "tilt", "left track", "right track", "steering"};

/// Where a row or a frame has no value.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

enum class What { kTime, kRun, kCommand, kSpool, kPosition, kVelocity, kPressure, kOther };

/// kUnknown: the name says none.
enum class Unit {
  kUnknown,
  kRad,
  kMrad,
  kDegree,
  kMetre,
  kCentimetre,
  kMillimetre,
  kRatio,
  kPercent,
  kPermille,
  kSecond,
  kMillisecond,
  kMicrosecond,
  kMinute,
  kOther,
};

struct Meaning {
  What what = What::kOther;
  int drive = -1;              ///< Place in kDriveNames; below 0: of none.
  int side = 0;                ///< Of a command: +1 or -1 where it is of one direction alone.
  bool length = false;         ///< Of a position: a stroke, not an angle.
  Unit unit = Unit::kUnknown;  ///< Of a velocity: without the "per second".
  bool second = false;         ///< A second sensor, or another's copy: counts only alone.
};

/// `name` as "arm_angle_deg" or "PilotPressureCmd1.BoomUp", `unit` as the file says it beside that;
/// may be empty.
[[nodiscard]] Meaning meaning_of(std::string_view name, std::string_view unit);

[[nodiscard]] const char* what_text(What what);
[[nodiscard]] const char* unit_text(Unit unit);

}  // namespace graben::identify
