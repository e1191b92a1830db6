// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/ecu/ground/edge_finder.hpp"
#include "firmware/dozer/tilt.hpp"

namespace graben::ground {

std::optional<EdgePlace> DozerFinder::look(const DozerInputs& inputs, TimeUs now_us) {
  if (inputs.body.heading_rad.validity == Validity::kValid) {
    // A track that curves: the bus tells stations along it, and no place in plan.
    return std::nullopt;
  }
  const DriveRows drives = setup_.bank.rows();
  constexpr bool kMoving = false;
  const DozerValid valid = validate(setup_.profile, drives, inputs, kMoving, now_us, state_);
  const bool has_tilt = setup_.profile.tilt.present;
  if (valid.faults.has(Fault::kPoseMissing) || !valid.blade().stroke_known ||
      (has_tilt && !valid.tilt().stroke_known)) {
    return std::nullopt;
  }
  const BodyPose body{{valid.position_m, 0.0, valid.height_m},
                      rotation_from_pitch_and_roll(valid.pitch_rad, valid.roll_rad)};
  const double angle_rad = setup_.blade.angle_rad(valid.blade().stroke_m);
  const double tilt_rad = has_tilt ? setup_.tilt.angle_rad(valid.tilt().stroke_m) : 0.0;
  const Eigen::Vector3d middle_m = edge_in_world_m(setup_.blade, body, angle_rad);
  const double slope = edge_slope(body.rotation, angle_rad, tilt_rad).slope;
  const Eigen::Vector3d half_m = 0.5 * width_m_ * Eigen::Vector3d(0.0, 1.0, slope).normalized();
  EdgePlace place;
  place.left_m = middle_m + half_m;
  place.right_m = middle_m - half_m;
  place.at_work =
      valid.velocity_mps > kAtWork_mps && setup_.blade.edge_m(angle_rad).y() < kAtWorkOverTracks_m;
  return place;
}

}  // namespace graben::ground
