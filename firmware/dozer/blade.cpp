// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/tilt.hpp"
#include "firmware/dozer/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

double direction_rad(const Eigen::Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

/// What makes one of the implement's drives.
struct ImplementDrive {
  double stroke_max_m = 0.0;
  double cap_area_m2 = 0.0;
  double rod_area_m2 = 0.0;
  double valve_flow_max_m3ps = 0.0;
  const DutyTable& spool_to_duty;
  const SaidAnswers& answer;
};

double said_or(double said_s, double other_s) { return said_s == kUnsaid_s ? other_s : said_s; }

SpoolAnswer answer_of(const ImplementDrive& drive, const DozerControl& control, bool extends) {
  const SaidAnswer& said = drive.answer.side(extends);
  return {said.spool_to_duty.size() == 0 ? drive.spool_to_duty : said.spool_to_duty,
          said_or(said.dead_time_s, control.dead_time_s), said_or(said.lag_s, control.response_s),
          0.0};
}

void fill_row(const DozerProfile& profile, const ImplementDrive& drive, DriveRow& row) {
  const DozerControl& control = profile.control;
  set_cylinder_range(drive.stroke_max_m, row);
  row.extend_area_m2 = drive.cap_area_m2;
  row.retract_area_m2 = drive.rod_area_m2;
  row.metering.spool_travel_m = 1.0;
  row.supply = {drive.valve_flow_max_m3ps,
                profile.implement.displacement_m3prev * profile.implement.efficiency / kTwoPi};
  row.answer = {answer_of(drive, control, true), answer_of(drive, control, false)};
  row.control.spool_rate_ps = control.spool_rate_ps;
  row.control.duty_rate_ps = control.duty_rate_ps;
  row.control.spool_threshold = control.spool_threshold;
  row.control.stroke_end_gain_ps = kBladeEndGain_ps;
  row.watch.fastest_mps = kFasterThanPumps * drive.valve_flow_max_m3ps / drive.rod_area_m2;
  row.watch.senses_load = false;
  row.watch.settle_s = profile.safety.settle_s;
  row.watch.spool_tolerance = profile.safety.spool_tolerance;
  row.watch.senses_spool = profile.bus.spool_feedback;
  row.watch.rest_s = rest_s(row);
  row.watch.uncommanded_m = profile.safety.uncommanded_m;
  row.watch.sink_mps = profile.safety.sink_mps;
  row.watch.stuck_m = profile.safety.stuck_m;
  row.watch.unseen_m = kBladeUnseen_m;
  row.watch.off_m = kBladeOff_m;
}

}  // namespace

BladeKinematics::BladeKinematics(const BladeGeometry& geometry)
    : pivot_m_(geometry.pivot_m),
      edge_radius_m_(geometry.cutting_edge_m),
      edge_home_rad_(std::asin(-geometry.pivot_m.y() / geometry.cutting_edge_m)),
      l11_m_((geometry.base_m - geometry.pivot_m).norm()),
      enclosed_home_rad_(direction_rad(geometry.base_m - geometry.pivot_m) -
                         direction_rad(geometry.arm_m)) {
  // Law of cosines for L12: the side that makes the cylinder as long at home as it is.
  const double along = l11_m_ * std::cos(enclosed_home_rad_);
  const double across = l11_m_ * std::sin(enclosed_home_rad_);
  l12_m_ = along + std::sqrt(geometry.length_home_m * geometry.length_home_m - across * across);
  const auto angle_at = [&](double height_m) {
    return std::asin((height_m - pivot_m_.y()) / edge_radius_m_) - edge_home_rad_;
  };
  angle_min_rad_ = angle_at(geometry.edge_min_m);
  angle_max_rad_ = angle_at(geometry.edge_max_m);
  shortest_m_ = length_m(angle_max_rad_);
  stroke_max_m_ = length_m(angle_min_rad_) - shortest_m_;
}

double BladeKinematics::length_m(double angle_rad) const {
  const double enclosed_rad = enclosed_home_rad_ - angle_rad;
  return std::sqrt(l11_m_ * l11_m_ + l12_m_ * l12_m_ -
                   2.0 * l11_m_ * l12_m_ * std::cos(enclosed_rad));
}

double BladeKinematics::angle_rad(double stroke_m) const {
  const double length = shortest_m_ + std::clamp(stroke_m, 0.0, stroke_max_m_);
  const double cosine =
      (l11_m_ * l11_m_ + l12_m_ * l12_m_ - length * length) / (2.0 * l11_m_ * l12_m_);
  return enclosed_home_rad_ - std::acos(std::clamp(cosine, -1.0, 1.0));
}

double BladeKinematics::stroke_m(double angle_rad) const {
  return length_m(std::clamp(angle_rad, angle_min_rad_, angle_max_rad_)) - shortest_m_;
}

double BladeKinematics::stroke_rate_mprad(double angle_rad) const {
  const double angle = std::clamp(angle_rad, angle_min_rad_, angle_max_rad_);
  return -l11_m_ * l12_m_ * std::sin(enclosed_home_rad_ - angle) / length_m(angle);
}

Eigen::Vector2d BladeKinematics::edge_m(double angle_rad) const {
  const double direction = edge_home_rad_ + angle_rad;
  return pivot_m_ + edge_radius_m_ * Eigen::Vector2d(std::cos(direction), std::sin(direction));
}

DozerBank dozer_bank(const DozerProfile& profile) {
  const BladeGeometry& blade = profile.blade;
  const TiltProfile& tilt = profile.tilt;
  DozerBank bank;
  fill_row(profile,
           {BladeKinematics(blade).stroke_max_m(), blade.cap_area_m2(), blade.rod_area_m2(),
            profile.implement.valve_flow_max_m3ps, profile.implement.spool_to_duty,
            profile.answer[kBladeLift]},
           bank.row[kBladeLift]);
  bank.count = tilt.present ? kBladeCount : 1;
  if (tilt.present) {
    DriveRow& row = bank.row[kBladeTilt];
    fill_row(profile,
             {TiltKinematics(tilt).stroke_max_m(), tilt.cap_area_m2(), tilt.rod_area_m2(),
              tilt.valve_flow_max_m3ps, tilt.spool_to_duty, profile.answer[kBladeTilt]},
             row);
    row.control.at_end.index = static_cast<std::uint8_t>(kBladeTilt);
  }
  return bank;
}

}  // namespace graben
