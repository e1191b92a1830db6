// SPDX-License-Identifier: Apache-2.0
constexpr double kSilent_s = 0.5;
/// Speed of it. [m/s2; chosen: not tried]
constexpr double kWrongUnit_mps = 0.5;
/// Speed of it. [m/s; chosen: not tried]
constexpr double kHomeless_mps = 0.5;
/// Wait for it. [s; guessed: by nobody]
constexpr double kGuessed_s = 0.5;
/// Steps of the loop. [-; size: of this loop]
constexpr int kSteps = 4;
