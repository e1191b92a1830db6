// SPDX-License-Identifier: Apache-2.0
#include "app/machines/unit_hint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace graben::machines {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// What people write in the place of an SI unit, the likeliest first.
struct OtherUnit {
  const char* si;
  const char* name;
  double per_si;  ///< SI units that one of it is.
};
constexpr OtherUnit kOthers[] = {{"rad/s", "rpm", kPi / 30.0},
                                 {"rad/s", "degrees", kPi / 180.0},
                                 {"rad", "degrees", kPi / 180.0},
                                 {"m", "mm", 1e-3},
                                 {"m2", "mm2", 1e-6},
                                 {"m2", "cm2", 1e-4},
                                 {"m3", "L", 1e-3},
                                 {"m3/s", "L/min", 1.0 / 6e4},
                                 {"m3/rev", "cm3/rev", 1e-6},
                                 {"Pa", "bar", 1e5},
                                 {"Pa", "MPa", 1e6},
                                 {"Pa", "GPa", 1e9},
                                 {"kg", "t", 1e3},
                                 {"kg/m3", "kg/L", 1e3},
                                 {"N", "kN", 1e3},
                                 {"W", "kW", 1e3},
                                 {"s", "ms", 1e-3},
                                 {"m/s", "mm/s", 1e-3},
                                 {"m/s", "km/h", 1.0 / 3.6},
                                 {"", "%", 1e-2}};

}  // namespace

std::string unit_hint(double value, double least, double most, const std::string& unit) {
  std::string text;
  for (const OtherUnit& other : kOthers) {
    const double si = value * other.per_si;
    // Nobody writes a length below that in mm: it is a slip of another kind.
    if (other.si == std::string("m") && std::abs(value) < 100.0) {
      continue;
    }
    // A slope of 0.8 is not one of 0.8 %.
    if (other.name == std::string("%") && std::abs(value) < 2.0) {
      continue;
    }
    // Angles' own rates and accelerations are written in degrees, too.
    const bool is_its = unit == other.si || (std::string(other.si) == "rad" && unit != "rad/s" &&
                                             unit.compare(0, 4, "rad/") == 0);
    if (is_its && si >= least && si <= most && value != 0.0) {
      text += text.empty() ? fmt::format("; in {}? then it is {:.4g} {}", other.name, si, unit)
                           : fmt::format("; or in {}: {:.4g}", other.name, si);
      if (unit == "rad/s") {
        break;  // A speed in rpm is no other's in degrees.
      }
    }
  }
  while (!text.empty() && text.back() == ' ') {
    text.pop_back();
  }
  return text;
}

}  // namespace graben::machines
