#include "firmware/excavator/excavator_profile.hpp"

#include "firmware/machine/piston_area.hpp"

namespace graben {

double CylinderGeometry::cap_area_m2() const { return graben::cap_area_m2(count, bore_m); }

double CylinderGeometry::rod_area_m2() const { return graben::rod_area_m2(count, bore_m, rod_m); }

double ExcavatorProfile::extend_area_m2(int drive) const {
  return drive == kSwing ? swing.area_m2()
                         : geometry.cylinder[static_cast<unsigned>(drive)].cap_area_m2();
}

double ExcavatorProfile::retract_area_m2(int drive) const {
  return drive == kSwing ? swing.area_m2()
                         : geometry.cylinder[static_cast<unsigned>(drive)].rod_area_m2();
}

double ExcavatorProfile::least_travel_m(int drive) const {
  return drive == kSwing ? swing.right_end_rad * swing.lever_m : 0.0;
}

double ExcavatorProfile::most_travel_m(int drive) const {
  return drive == kSwing ? swing.left_end_rad * swing.lever_m
                         : geometry.cylinder[static_cast<unsigned>(drive)].stroke_m;
}

}  // namespace graben
