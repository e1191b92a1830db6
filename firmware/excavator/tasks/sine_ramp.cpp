#include "firmware/excavator/tasks/sine_ramp.hpp"

#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Square of the shortest time that a way takes: half of it faster, half slower.
double shortest_square_s2(double way_m, double acceleration_mps2) {
  return 2.0 * kPi * way_m / acceleration_mps2;
}

SineRamp short_trip(double way_m, double acceleration_mps2) {
  const double duration_s = std::sqrt(shortest_square_s2(way_m, acceleration_mps2));
  return {duration_s, 0.5 * duration_s};
}

/// First line of (7), by the time since the start.
Progress rising(const SineRamp& ramp, double time_s) {
  const double w = kPi / ramp.ramp_s;
  const double half_rate = 0.5 * ramp.peak_rate_ps();
  return {half_rate * (time_s - std::sin(w * time_s) / w), half_rate * (1.0 - std::cos(w * time_s)),
          half_rate * w * std::sin(w * time_s)};
}

}  // namespace

double SineRamp::peak_rate_change_ps2() const { return 0.5 * kPi * peak_rate_ps() / ramp_s; }

Progress SineRamp::at(double time_s) const {
  const double left_s = duration_s - time_s;
  // Written so that NaN and a ramp without duration stay at the start.
  if (!(time_s > 0.0 && ramp_s > 0.0)) {
    return {};
  }
  if (left_s <= 0.0) {
    return {1.0, 0.0, 0.0};
  }
  if (time_s < ramp_s) {
    return rising(*this, time_s);
  }
  if (left_s < ramp_s) {
    // The third line of (7) is the first, run backwards from the end.
    const Progress mirror = rising(*this, left_s);
    return {1.0 - mirror.share, mirror.rate_ps, -mirror.rate_change_ps2};
  }
  return {peak_rate_ps() * (time_s - 0.5 * ramp_s), peak_rate_ps(), 0.0};
}

SineRamp ramp_for_duration(double way_m, double duration_s, double acceleration_mps2) {
  const double shortest_s2 = shortest_square_s2(way_m, acceleration_mps2);
  const double spare_s2 = duration_s * duration_s - shortest_s2;
  if (spare_s2 <= 0.0) {
    return short_trip(way_m, acceleration_mps2);
  }
  // The smaller root of way = 2 a / pi * t_1 (T - t_1), without the difference of near equals.
  return {duration_s, 0.5 * shortest_s2 / (duration_s + std::sqrt(spare_s2))};
}

SineRamp ramp_for_speed(double way_m, double speed_mps, double acceleration_mps2) {
  const double ramp_s = 0.5 * kPi * speed_mps / acceleration_mps2;
  if (speed_mps * ramp_s >= way_m) {
    return short_trip(way_m, acceleration_mps2);
  }
  return {way_m / speed_mps + ramp_s, ramp_s};
}

}  // namespace graben
