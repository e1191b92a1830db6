#pragma once

namespace graben::plant {

/// One turn, rad.
inline constexpr double kTwoPi = 6.28318530717958647693;

}  // namespace graben::plant
