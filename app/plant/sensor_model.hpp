#pragma once
/// What the machine's sensors make of the truth.

#include "app/plant/plant_profile.hpp"

namespace graben::plant {

/// Exact sensors: of `errors` only the encoder's resolution and the transducer's range act here;
/// bias and noise are not simulated. The CAN codec quantises and saturates by itself.
struct SensorModel {
  SensorErrors errors;

  /// Encoder reading: the nearest multiple of its resolution.
  [[nodiscard]] double stroke_m(double true_stroke_m) const;
  /// A transducer shows nothing below ambient and nothing above its range.
  [[nodiscard]] double pressure_pa(double true_pressure_pa) const;
};

}  // namespace graben::plant
