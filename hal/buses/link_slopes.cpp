// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/link_slopes.hpp"

#include <algorithm>

#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

Signal<double> joint_of(const Signal<double>& outer, const Signal<double>& inner,
                        double middle_rad) {
  Signal<double> joint{0.0, std::min(outer.validity, inner.validity),
                       std::min(outer.stamp_us, inner.stamp_us)};
  if (joint.validity == Validity::kValid) {
    joint.value = wrap_near(outer.value - inner.value, middle_rad);
  }
  return joint;
}

}  // namespace

void LinkSlopes::to_joints(bool has_body, ExcavatorInputs& to) const {
  const Signal<double> level{0.0, Validity::kValid, link[kBoomSlope].stamp_us};
  to.joint_rad[0] = joint_of(link[kBoomSlope], has_body ? link[kBodySlope] : level, kMiddle_rad[0]);
  to.joint_rad[1] = joint_of(link[kArmSlope], link[kBoomSlope], kMiddle_rad[1]);
  to.joint_rad[2] = joint_of(link[kBucketSlope], link[kArmSlope], kMiddle_rad[2]);
}

}  // namespace graben
