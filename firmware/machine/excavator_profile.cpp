#include "firmware/machine/excavator_profile.hpp"

namespace graben {
namespace {
constexpr double kQuarterPi = 0.78539816339744830962;
}

double CylinderGeometry::cap_area_m2() const { return count * kQuarterPi * bore_m * bore_m; }

double CylinderGeometry::rod_area_m2() const {
  return count * kQuarterPi * (bore_m * bore_m - rod_m * rod_m);
}

}  // namespace graben
