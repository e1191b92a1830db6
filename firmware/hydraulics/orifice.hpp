#pragma once
/// Orifices in series, as flow coefficients c of Q = c sqrt(P) in m^3/(s sqrt(Pa)).

namespace graben {

/// Part of 1/c^2 of a chain (after (21)): resistances add up.
[[nodiscard]] constexpr double orifice_resistance(double coefficient) {
  return 1.0 / (coefficient * coefficient);
}

}  // namespace graben
