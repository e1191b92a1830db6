#pragma once
/// What the dozer's sensors make of the truth.

#include <cstdint>
#include <optional>

#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/random.hpp"

namespace graben::plant {

/// The stroke comes in steps of its encoder's resolution. With a seed the height also has a
/// constant bias, uniform within the profile's bounds, and each reading of pose, rates and track
/// speeds white noise of the profile's standard deviation; each call is one reading.
class DozerSensorModel {
 public:
  DozerSensorModel(const DozerSensorErrors& errors, std::optional<std::uint64_t> seed);

  [[nodiscard]] double stroke_m(double true_stroke_m) const;
  [[nodiscard]] double position_m(double true_position_m);
  [[nodiscard]] double height_m(double true_height_m);
  [[nodiscard]] double pitch_rad(double true_pitch_rad);
  [[nodiscard]] double velocity_mps(double true_velocity_mps);
  [[nodiscard]] double climb_mps(double true_climb_mps);
  [[nodiscard]] double pitch_rate_radps(double true_pitch_rate_radps);
  [[nodiscard]] double track_speed_mps(double true_track_speed_mps);

 private:
  DozerSensorErrors errors_;
  std::optional<Random> pose_noise_;
  std::optional<Random> track_noise_;
  double height_bias_m_ = 0.0;
};

}  // namespace graben::plant
