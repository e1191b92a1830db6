#include "firmware/drives/pressure_watch.hpp"

#include <cmath>

namespace graben {
namespace {

constexpr double kRail_s = 0.3;
constexpr double kMoved_m = 0.06;
/// Way is counted in steps of more than a stroke sensor's noise.
constexpr double kStep_m = 0.002;
/// A chamber that cavitates stays at one pressure for long.
constexpr double kEmpty_pa = 0.2e6;

using Sensor = PressureWatchState::Sensor;

Sensor seen(const ExcavatorProfile& profile, const Sensor& last, double pressure_pa,
            double stroke_m, double period_s) {
  Sensor sensor = last;
  const double step_m = std::abs(stroke_m - last.stroke_m);
  if (pressure_pa != last.last_pa || pressure_pa <= kEmpty_pa) {
    sensor.last_pa = pressure_pa;
    sensor.stroke_m = stroke_m;
    sensor.way_m = 0.0;
  } else if (step_m > kStep_m) {
    sensor.stroke_m = stroke_m;
    sensor.way_m += step_m;
  }
  sensor.at_rail_s =
      pressure_pa >= profile.safety.pressure_rail_pa ? last.at_rail_s + period_s : 0.0;
  sensor.wrong = sensor.at_rail_s > kRail_s || sensor.way_m > kMoved_m;
  return sensor;
}

}  // namespace

PressureWatchResult watch_pressures(const ExcavatorProfile& profile, const PressureWatchState& last,
                                    const ValidInputs& valid, double period_s) {
  PressureWatchResult result;
  result.state = last;
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    if (!valid.load_known[i]) {
      continue;
    }
    const std::array<double, 2> pressure_pa = {valid.cap_pressure_pa[i], valid.rod_pressure_pa[i]};
    for (unsigned side = 0; side < 2; ++side) {
      Sensor& sensor = result.state.sensor[i][side];
      sensor = seen(profile, sensor, pressure_pa[side], valid.strokes_m[i], period_s);
      result.wrong[i] = result.wrong[i] || sensor.wrong;
    }
  }
  return result;
}

}  // namespace graben
