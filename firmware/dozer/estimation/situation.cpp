// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/estimation/situation.hpp"

#include <cmath>

#include "firmware/dozer/travel/course.hpp"
#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// On a track that curves: edge and design as they lie there, `lead_s` on.
void place_on_curve(const DozerModel& machine, const DozerValid& valid, const GradeProfile& design,
                    double lead_s, BladeSituation& at) {
  const double x_m = at.body.position_m.x();
  const double reach_m = edge_in_world_m(machine.blade, at.body, at.angle_rad).x() - x_m;
  const Course course =
      course_after(design, valid.course, valid.position_m, valid.velocity_mps, lead_s);
  const EdgeCourse edge = edge_course(design, x_m, course, reach_m);
  // What follows is of the edge: its station is what counts.
  at.body.position_m.x() += edge.ahead_m - reach_m;
  at.aside_m = design.cross_at(x_m + edge.ahead_m).slope * edge.offset_m;
  at.askew_rad = edge.heading_rad;
  at.askew_rate_radps =
      course.yaw_rate_radps - design.curvature_at(x_m + edge.ahead_m) * valid.velocity_mps;
}

}  // namespace

Driving driving_of(const DozerModel& machine, const DozerValid& valid,
                   const DozerEstimates& estimates) {
  const Stand stand{valid.height_m - raised_m(valid, estimates, valid.position_m), valid.pitch_rad};
  return {motion_of(machine.profile.body, stand, valid.climb_mps, valid.pitch_rate_radps),
          valid.position_m, valid.velocity_mps};
}

Driving driven(const DozerModel& machine, const DozerValid& valid, const DozerEstimates& estimates,
               const DozerLastCycle& last, double lead_s) {
  return drive_on(machine.profile.body, estimates.ground, estimates.design,
                  driving_of(machine, valid, estimates), {last.commands.speed_mps, kTravelLead_s},
                  lead_s, estimates.foretelling.bias);
}

BladeSituation situation_of(const DozerModel& machine, const DozerValid& valid,
                            const DozerEstimates& estimates, const Driving& driven, double lead_s,
                            double stroke_m) {
  const DozerBody& body = machine.profile.body;
  const Stand stand = stand_of(body, driven.motion);
  BladeSituation at;
  at.body.position_m = {driven.x_m, 0.0, stand.height_m + raised_m(valid, estimates, driven.x_m)};
  at.body.rotation = rotation_from_pitch(stand.pitch_rad);
  at.pitch_rad = stand.pitch_rad;
  // Pitch is positive nose up, which is a turn about -y.
  at.body_velocity << driven.speed_mps, 0.0, origin_climb_mps(body, driven.motion), 0.0,
      -driven.motion.pitch_rate_radps, 0.0;
  at.angle_rad = machine.blade.angle_rad(stroke_m);
  if (machine.profile.tilt.present) {
    const BodyRoll rolled =
        roll_after(body, estimates.design, {valid.roll_rad, valid.roll_rate_radps},
                   valid.position_m, driven.x_m, driven.speed_mps, lead_s);
    at.body.rotation = rotation_from_pitch_and_roll(stand.pitch_rad, rolled.roll_rad);
    at.roll_rate_radps = rolled.rate_radps;
    at.body_velocity.tail<3>() +=
        rolled.rate_radps *
        Eigen::Vector3d(std::cos(stand.pitch_rad), 0.0, std::sin(stand.pitch_rad));
  }
  if (estimates.design.curves()) {
    place_on_curve(machine, valid, estimates.design, lead_s, at);
  }
  return at;
}

TiltSituation tilt_at(const DozerModel& machine, const BladeSituation& at, double stroke_m) {
  TiltSituation tilt;
  tilt.body_rotation = at.body.rotation;
  tilt.roll_rate_radps = at.roll_rate_radps;
  tilt.blade_angle_rad = at.angle_rad;
  tilt.tilt_rad = machine.tilt.angle_rad(stroke_m);
  tilt.edge_x_m = edge_in_world_m(machine.blade, at.body, at.angle_rad).x();
  tilt.speed_mps = at.body_velocity[0];
  tilt.askew_rad = at.askew_rad;
  tilt.askew_rate_radps = at.askew_rate_radps;
  return tilt;
}

}  // namespace graben
