#pragma once
/// What the machine's sensors make of the truth.

#include "app/plant/plant_profile.hpp"

namespace graben::plant {

/// `exact` leaves only the encoder's steps; the CAN codec then quantises and saturates by itself.
struct SensorModel {
  bool exact = true;  ///< No bias, no noise. The erroneous model is not built yet: keep it true.
  SensorErrors errors;

  /// Encoder reading: the nearest multiple of its resolution.
  [[nodiscard]] double stroke_m(double true_stroke_m) const;
  /// A transducer shows nothing below ambient and nothing above its range.
  [[nodiscard]] double pressure_pa(double true_pressure_pa) const;
};

}  // namespace graben::plant
