// SPDX-License-Identifier: Apache-2.0
/// Wait for the oil. [s; chosen: 0.3 to 0.8 tried]
constexpr double kTwice_s = 0.4;
