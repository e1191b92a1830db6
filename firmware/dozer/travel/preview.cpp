#include "firmware/dozer/travel/preview.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/blade.hpp"

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

/// Nearer than this the next step of Newton's method finds the same.
constexpr double kOnDesign_rad = 1e-4;

}  // namespace

Preview::Preview(const DozerProfile& profile, const BladeKinematics& blade)
    : profile_(profile),
      blade_(blade),
      count_(std::clamp(static_cast<int>(profile.travel.preview_m / kStep_m), 1,
                        kMostStations - kBefore - kMargin)) {}

int Preview::total() const { return kBefore + count_ + kMargin; }

/// theta_1 with the edge on the design.
double Preview::angle_on(const GradeProfile& design, double x_m, const Stand& stand,
                         double guess_rad) const {
  const double c = std::cos(stand.pitch_rad);
  const double s = std::sin(stand.pitch_rad);
  double angle_rad = guess_rad;
  double change_rad = 1.0;
  for (int step = 0; step < kEdgeSteps && std::abs(change_rad) > kOnDesign_rad; ++step) {
    const Eigen::Vector2d edge_m = blade_.edge_m(angle_rad);
    const Eigen::Vector2d rate = blade_.edge_rate_at_mprad(edge_m);
    const GradeSample wanted = design.at(x_m + c * edge_m.x() - s * edge_m.y());
    const double below_m = wanted.height_m - (stand.height_m + s * edge_m.x() + c * edge_m.y());
    const double approach =
        s * rate.x() + c * rate.y() - wanted.slope * (c * rate.x() - s * rate.y());
    const double last_rad = angle_rad;
    angle_rad = std::clamp(angle_rad + below_m / std::max(approach, 0.1), blade_.angle_min_rad(),
                           blade_.angle_max_rad());
    change_rad = angle_rad - last_rad;
  }
  return angle_rad;
}

void Preview::forget(int index) {
  station(index) = {};
  station(index - 1).flow_m3pm = kNotKnown;
  station(index + 1).flow_m3pm = kNotKnown;
  known_before_ = std::min(known_before_, index);
}

/// Makes `first` the first station.
void Preview::follow(int first) {
  if (!started_ || std::abs(first - first_) >= total()) {
    station_ = {};
    first_ = first;
    next_ = first;
    known_before_ = first;
    work_ = {};
    started_ = true;
  }
  for (int left = kMostStations; first_ < first && left > 0; --left) {
    forget(first_ + total());
    ++first_;
  }
  for (int left = kMostStations; first_ > first && left > 0; --left) {
    --first_;
    forget(first_);
  }
  known_before_ = std::max(known_before_, first_);
  work_.begun = work_.begun && work_.index >= first_ && work_.index < first_ + total();
}

/// From its neighbour's stand, not from its own: on a ledge it must not stay where it once stood.
void Preview::begin(const Stand& measured) {
  while (known_before_ < first_ + total() && station(known_before_).known) {
    ++known_before_;
  }
  int index = known_before_;
  if (index == first_ + total()) {
    next_ = next_ < first_ || next_ + 1 >= first_ + total() ? first_ : next_ + 1;
    index = next_;
  }
  work_ = {true, index, 0, measured};
  const Station& from = station(index > first_ ? index - 1 : index);
  if (from.known) {
    work_.stand = from.stand;
  }
}

void Preview::finish(const GradeProfile& design) {
  const int index = work_.index;
  const double x_m = index * kStep_m;
  Station& at = station(index);
  const Station& before = station(index - 1);
  at.stand = work_.stand;
  at.angle_rad =
      angle_on(design, x_m, at.stand, index > first_ && before.known ? before.angle_rad : 0.0);
  at.stroke_m = blade_.stroke_m(at.angle_rad);
  at.by_design_m =
      blade_.stroke_m(angle_on(design, x_m + kStep_m, at.stand, at.angle_rad)) - at.stroke_m;
  at.known = true;
  for (int changed = index - 1; changed <= index + 1; ++changed) {
    station(changed).flow_m3pm = flow_between(changed);
  }
  work_.begun = false;
}

void Preview::look(const GroundMap& ground, const GradeProfile& design, double x_m,
                   const Stand& measured) {
  follow(station_of(x_m) - kBefore);
  int finished = 0;
  for (int left = kStandStepsPerCycle; left > 0 && finished < kStationsPerCycle; --left) {
    if (!work_.begun) {
      begin(measured);
    }
    const StandStep step =
        step_to_rest(profile_.body, ground, design, work_.index * kStep_m, work_.stand);
    work_.stand = step.stand;
    ++work_.steps;
    if (step.at_rest || work_.steps == kMostStandSteps) {
      finish(design);
      ++finished;
    }
  }
}

double Preview::flow_between(int index) const {
  if (index <= first_ || index + 1 >= first_ + total()) {
    return kNotKnown;
  }
  const Station& before = station(index - 1);
  const Station& after = station(index + 1);
  if (!before.known || !station(index).known || !after.known) {
    return kNotKnown;
  }
  const double at_rest = (after.stroke_m - before.stroke_m) / (2.0 * kStep_m);
  const double by_design = station(index).by_design_m / kStep_m;
  const double swinging = by_design + kSwing * (at_rest - by_design);
  return std::max(inflow_m3ps(profile_.blade, at_rest), inflow_m3ps(profile_.blade, swinging));
}

double Preview::limit_of(int index, double flow_m3ps) const {
  const double flow_m3pm = station(index).flow_m3pm;
  const double fed_mps = flow_m3pm > kNoFlow_m3pm ? flow_m3ps / flow_m3pm : kAnySpeed_mps;
  return std::clamp(fed_mps, profile_.travel.speed_min_mps, kAnySpeed_mps);
}

AheadLimit Preview::limit(double x_m, double speed_mps, double flow_m3ps, double lead_s) const {
  if (!std::isfinite(x_m) || !std::isfinite(speed_mps)) {
    return {profile_.travel.speed_min_mps, profile_.travel.speed_min_mps};
  }
  const auto limit_at = [&](int index) { return limit_of(index, flow_m3ps); };
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
