// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/site_frame.hpp"

#include <cmath>

#include "firmware/excavator/fences/tuning.hpp"

namespace graben {
namespace {

Eigen::Vector3d place_m(const TeethPlace& teeth, const FrameShift& shift) {
  const double angle_rad = teeth.swing_rad - shift.turn_rad;
  return {teeth.out_m * std::cos(angle_rad) + shift.origin_m.x(),
          teeth.out_m * std::sin(angle_rad) + shift.origin_m.y(), teeth.up_m + shift.origin_m.z()};
}

bool agrees(double one_m, double other_m) { return std::abs(one_m - other_m) <= kSiteBound_m; }

MarkTouch take_heading(const SitePoints& points, const TeethPlace& teeth, SiteState& state) {
  FrameShift shift;
  const Eigen::Vector3d here = place_m(teeth, shift) - place_m(state.benchmark, shift);
  const Eigen::Vector3d there = points.second_m - points.benchmark_m;
  if (!agrees(std::hypot(here.x(), here.y()), std::hypot(there.x(), there.y())) ||
      !agrees(here.z(), there.z())) {
    return MarkTouch::kContradict;
  }
  shift.turn_rad = std::atan2(here.y(), here.x()) - std::atan2(there.y(), there.x());
  shift.origin_m = points.benchmark_m - place_m(state.benchmark, shift);
  state.shift = shift;
  state.placed = true;
  state.known = SiteKnown::kKnown;
  return MarkTouch::kTaken;
}

MarkTouch check_surface(const Fence& design, const Eigen::Vector3d& at_m, SiteState& state) {
  double over_m = design.offset_m - design.normal.dot(at_m);
  double height_m = 0.0;
  if (design.is_surface()) {
    if (!design.surface->height_at(at_m.x(), at_m.y(), height_m)) {
      return MarkTouch::kNoPoint;
    }
    over_m = at_m.z() - height_m;
  }
  if (!agrees(over_m, 0.0)) {
    state.known = SiteKnown::kUnknown;
    return MarkTouch::kContradict;
  }
  return MarkTouch::kTaken;
}

}  // namespace

void begin_site(const SitePoints& points, double swing_rad, SiteState& state) {
  if (state.known == SiteKnown::kNone) {
    const bool is_unknown = points.by_touch || state.begins_left;
    state.known = is_unknown ? SiteKnown::kUnknown : SiteKnown::kKnown;
    state.swing_rad = swing_rad;
  }
}

MarkTouch next_site(const SitePoints& points, const FenceSet& fences, TouchKind kind,
                    const TeethPlace& teeth, SiteState& state) {
  if (kind == TouchKind::kMoved) {
    state.known = SiteKnown::kUnknown;
    return MarkTouch::kTaken;
  }
  if (kind == TouchKind::kBenchmark && points.can_touch) {
    state.known = SiteKnown::kBenchmark;
    state.benchmark = teeth;
    return MarkTouch::kTaken;
  }
  if (kind == TouchKind::kHeading && state.known == SiteKnown::kBenchmark) {
    return take_heading(points, teeth, state);
  }
  if (kind == TouchKind::kSurface && state.known == SiteKnown::kKnown && has_design(fences)) {
    return check_surface(fences.fence[static_cast<unsigned>(fences.count - 1)],
                         place_m(teeth, state.shift), state);
  }
  return MarkTouch::kNoPoint;
}

void watch_tracks(double turning_radps, double swing_rad, double period_s, SiteState& state) {
  state.turned_rad += turning_radps * period_s - (swing_rad - state.swing_rad);
  state.turned_rad -= state.turned_rad * period_s / kTracksForget_s;
  state.swing_rad = swing_rad;
  if (!(std::abs(state.turned_rad) <= kTracksTurned_rad)) {
    state.known = SiteKnown::kUnknown;
    state.turned_rad = 0.0;
  }
}

}  // namespace graben
