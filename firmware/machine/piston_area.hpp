#pragma once
/// Areas of parallel cylinders, all of them together.

namespace graben {

/// A_A: cap side, m^2.
constexpr double cap_area_m2(int count, double bore_m) {
  constexpr double kQuarterPi = 0.78539816339744830962;
  return count * kQuarterPi * bore_m * bore_m;
}

/// A_B: rod side, m^2.
constexpr double rod_area_m2(int count, double bore_m, double rod_m) {
  return cap_area_m2(count, bore_m) - cap_area_m2(count, rod_m);
}

}  // namespace graben
