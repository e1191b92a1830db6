#include "firmware/motion/stroke_end.hpp"

#include <algorithm>

namespace graben {

VelocityCap stroke_end_cap(const ExcavatorProfile& profile, const Eigen::Vector3d& strokes_m,
                           const Eigen::Vector3d& velocity_mps) {
  VelocityCap cap;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto i = static_cast<unsigned>(axis);
    const double velocity = velocity_mps[axis];
    const double left_m =
        velocity > 0.0 ? profile.geometry.cylinder[i].stroke_m - strokes_m[axis] : strokes_m[axis];
    const double allowed_mps = profile.control.stroke_end_gain_ps * std::max(0.0, left_m);
    const double speed_mps = velocity > 0.0 ? velocity : -velocity;
    if (speed_mps * cap.factor > allowed_mps) {
      cap.factor = allowed_mps / speed_mps;
      cap.limit = {LimitKind::kStrokeEnd, static_cast<std::uint8_t>(axis)};
    }
  }
  return cap;
}

}  // namespace graben
