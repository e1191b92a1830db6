#include "app/plant/sensor_model.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {

double SensorModel::stroke_m(double true_stroke_m) const {
  if (errors.stroke_resolution_m <= 0.0) {
    return true_stroke_m;
  }
  return std::round(true_stroke_m / errors.stroke_resolution_m) * errors.stroke_resolution_m;
}

double SensorModel::pressure_pa(double true_pressure_pa) const {
  const double shown = std::max(0.0, true_pressure_pa);
  return errors.pressure_range_pa > 0.0 ? std::min(shown, errors.pressure_range_pa) : shown;
}

}  // namespace graben::plant
