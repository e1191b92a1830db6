// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Designs as other programs and people write them, a row each: read right, or refused.
///
/// All that are read show the same ground, in their own unit of length: the rectangle from 1000,
/// 2000 to 1010, 2006 of the plane z = 50 + 0.02 (x - 1000) + 0.1 (y - 2000).

#include <string>
#include <vector>

namespace graben::test {

struct ForeignFile {
  const char* what = "";
  std::string name;
  std::string text;
  std::string surface = {};
  std::string columns = {};
  std::string units = {};
  double metres = 1.0;  ///< Of its unit.
  double area = 60.0;   ///< Of its ground seen from above, in that unit, squared.
  /// It is refused, with each of these words; none: it is read.
  std::vector<std::string> refused = {};
};

[[nodiscard]] std::vector<ForeignFile> landxml_files();
[[nodiscard]] std::vector<ForeignFile> point_files();
[[nodiscard]] std::vector<ForeignFile> dxf_files();

inline constexpr double kFoot_m = 0.3048;
inline constexpr double kSurveyFoot_m = 1200.0 / 3937.0;

}  // namespace graben::test
