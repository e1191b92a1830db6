#include "firmware/drives/stroke_end.hpp"

#include <algorithm>

namespace graben {

VelocityCap stroke_end_cap(const ExcavatorProfile& profile, const DriveVector& strokes_m,
                           const DriveVector& velocity_mps) {
  VelocityCap cap;
  for (int drive = 0; drive < profile.drive_count; ++drive) {
    const double velocity = velocity_mps[drive];
    const double left_m = velocity > 0.0 ? profile.most_travel_m(drive) - strokes_m[drive]
                                         : strokes_m[drive] - profile.least_travel_m(drive);
    const double allowed_mps = profile.control.stroke_end_gain_ps * std::max(0.0, left_m);
    const double speed_mps = velocity > 0.0 ? velocity : -velocity;
    if (speed_mps * cap.factor > allowed_mps) {
      cap.factor = allowed_mps / speed_mps;
      cap.limit = {drive == kSwing ? LimitKind::kSwingEnd : LimitKind::kStrokeEnd,
                   static_cast<std::uint8_t>(drive)};
    }
  }
  return cap;
}

}  // namespace graben
