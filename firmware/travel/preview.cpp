#include "firmware/travel/preview.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/implement_flow.hpp"

namespace graben {
namespace {

constexpr int kEdgeSteps = 4;
/// How much faster than from rest to rest the body swings from stand to stand.
constexpr double kSwing = 1.4;
/// Flow over less than this per metre is none.
constexpr double kNoFlow_m3pm = 1e-7;
/// No machine of this kind is faster.
constexpr double kAnySpeed_mps = 10.0;
/// Stations passed that still count: the body comes to rest behind where its springs at rest would
/// have it, most of all when it tips over a ledge.
constexpr int kBehind = 2;
/// Stations before the first and after the last one that the central difference needs.
constexpr int kMargin = 2;
constexpr int kBefore = kBehind + kMargin;

BodyPose pose_of(double x_m, const Stand& stand) {
  return {{x_m, 0.0, stand.height_m}, rotation_from_pitch(stand.pitch_rad)};
}

}  // namespace

Preview::Preview(const DozerProfile& profile, const BladeKinematics& blade)
    : profile_(profile),
      blade_(blade),
      count_(std::clamp(static_cast<int>(profile.travel.preview_m / kStep_m), 1,
                        kMostStations - kBefore - kMargin)) {}

int Preview::station_of(double x_m) {
  const double x = std::isfinite(x_m) ? std::clamp(x_m, -kFurthest_m, kFurthest_m) : 0.0;
  return static_cast<int>(std::floor(x / kStep_m));
}

const Preview::Station& Preview::station(int index) const {
  return station_[static_cast<unsigned>(index % kMostStations + kMostStations) % kMostStations];
}

Preview::Station& Preview::station(int index) {
  return station_[static_cast<unsigned>(index % kMostStations + kMostStations) % kMostStations];
}

double Preview::stroke_on(const GradeProfile& design, double x_m, const Stand& stand) const {
  const BodyPose body = pose_of(x_m, stand);
  double angle_rad = 0.0;
  for (int step = 0; step < kEdgeSteps; ++step) {
    const Eigen::Vector3d edge = edge_in_world_m(blade_, body, angle_rad);
    const GradeSample wanted = design.at(edge.x());
    const Vector6d rate = blade_jacobian(blade_, body, angle_rad);
    const double approach = rate[2] - wanted.slope * rate[0];
    angle_rad += (wanted.height_m - edge.z()) / std::max(approach, 0.1);
    angle_rad = std::clamp(angle_rad, blade_.angle_min_rad(), blade_.angle_max_rad());
  }
  return blade_.stroke_m(angle_rad);
}

void Preview::work_out(const GroundMap& ground, const GradeProfile& design, int index,
                       const Stand& guess) {
  Station& at = station(index);
  const double x_m = index * kStep_m;
  at.stand = stand_at(profile_.body, ground, design, x_m, at.known ? at.stand : guess);
  at.stroke_m = stroke_on(design, x_m, at.stand);
  at.by_design_m = stroke_on(design, x_m + kStep_m, at.stand) - at.stroke_m;
  at.known = true;
}

void Preview::look(const GroundMap& ground, const GradeProfile& design, double x_m,
                   const Stand& measured) {
  const int here = station_of(x_m) - kBefore;
  const int total = kBefore + count_ + kMargin;
  if (!started_ || std::abs(here - first_) >= total) {
    station_ = {};
    first_ = here;
    next_ = here;
    started_ = true;
  }
  for (int left = kMostStations; first_ < here && left > 0; --left) {
    station(first_ + total) = {};
    ++first_;
  }
  for (int left = kMostStations; first_ > here && left > 0; --left) {
    --first_;
    station(first_) = {};
  }
  int budget = kStationsPerCycle;
  for (int index = first_; index < first_ + total && budget > 0; ++index) {
    if (!station(index).known) {
      const bool follows = index > first_ && station(index - 1).known;
      work_out(ground, design, index, follows ? station(index - 1).stand : measured);
      --budget;
    }
  }
  for (; budget > 0; --budget) {
    next_ = next_ < first_ || next_ + 1 >= first_ + total ? first_ : next_ + 1;
    // From its neighbour, not from itself: on a ledge it must not stay where it once stood.
    station(next_).known = station(next_).known && next_ == first_;
    work_out(ground, design, next_, next_ > first_ ? station(next_ - 1).stand : measured);
  }
}

double Preview::speed_between(int index, double flow_m3ps) const {
  const Station& before = station(index - 1);
  const Station& after = station(index + 1);
  if (!before.known || !station(index).known || !after.known) {
    return profile_.travel.speed_min_mps;
  }
  const double at_rest = (after.stroke_m - before.stroke_m) / (2.0 * kStep_m);
  const double by_design = station(index).by_design_m / kStep_m;
  const double swinging = by_design + kSwing * (at_rest - by_design);
  const double flow_m3pm =
      std::max(inflow_m3ps(profile_.blade, at_rest), inflow_m3ps(profile_.blade, swinging));
  return flow_m3pm > kNoFlow_m3pm ? std::min(flow_m3ps / flow_m3pm, kAnySpeed_mps) : kAnySpeed_mps;
}

AheadLimit Preview::limit(double x_m, double speed_mps, double flow_m3ps, double lead_s) const {
  if (!std::isfinite(x_m) || !std::isfinite(speed_mps)) {
    return {profile_.travel.speed_min_mps, profile_.travel.speed_min_mps};
  }
  const auto limit_at = [&](int index) {
    return std::max(speed_between(index, flow_m3ps), profile_.travel.speed_min_mps);
  };
  // Between two stations the limit goes over from one to the other: what is passed must not let go
  // at once.
  const int last = first_ + kMargin;
  const double share = std::clamp(x_m / kStep_m - kBehind - last, 0.0, 1.0);
  const double left_mps = limit_at(last) + share * (limit_at(last + 1) - limit_at(last));
  AheadLimit ahead{kAnySpeed_mps, left_mps};
  double square = left_mps * left_mps;
  const double braked_from_m = x_m + std::max(0.0, speed_mps) * lead_s;
  for (int index = last + 1; index < last + kBehind + count_; ++index) {
    const double limit_mps = limit_at(index);
    const double way_m = std::max(0.0, index * kStep_m - braked_from_m);
    square = std::min(square,
                      limit_mps * limit_mps + 2.0 * profile_.travel.deceleration_max_mps2 * way_m);
    if (index * kStep_m - x_m <= kHold_m) {
      ahead.lowest_mps = std::min(ahead.lowest_mps, limit_mps);
    }
  }
  ahead.speed_mps = std::sqrt(square);
  return ahead;
}

}  // namespace graben
