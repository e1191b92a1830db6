// SPDX-License-Identifier: Apache-2.0
/// Wait for it. [s; chosen: as long as usual]
constexpr double kUntried_s = 0.5;
/// Wait for it. [s; measured: it was long]
constexpr double kByNobody_s = 0.5;
constexpr double kNameless_s = 0.5;  ///< [s; chosen: not tried]
/// Wait for the oil. [s; chosen: 0.3 to 0.8 tried]
constexpr double kTwice_s = 0.5;
