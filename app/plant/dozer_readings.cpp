#include "app/plant/dozer_node.hpp"

namespace graben::plant {

DozerReadings::DozerReadings(const DozerPlantProfile& profile)
    : sensors_(profile.sensors,
               profile.sensor_errors ? std::optional(profile.seed) : std::nullopt) {}

dbc::dozer::BladeStroke DozerReadings::stroke(const DozerPlant& plant, const DozerFaults& faults) {
  return {stroke_.show(sensors_.stroke_m(plant.blade_stroke_m()), ReadingFault(faults.stroke))};
}

dbc::dozer::BodyPosition DozerReadings::position(const DozerPlant& plant,
                                                 const PoseFaults& faults) {
  return {position_.show(sensors_.position_m(plant.position_m()), faults.position),
          height_.show(sensors_.height_m(plant.height_m()), faults.height)};
}

dbc::dozer::BodyPitch DozerReadings::pitch(const DozerPlant& plant, const PoseFaults& faults) {
  return {pitch_.show(sensors_.pitch_rad(plant.pitch_rad()), faults.pitch),
          pitch_rate_.show(sensors_.pitch_rate_radps(plant.pitch_rate_radps()), faults.pitch_rate)};
}

dbc::dozer::BodyVelocity DozerReadings::velocity(const DozerPlant& plant,
                                                 const PoseFaults& faults) {
  return {velocity_.show(sensors_.velocity_mps(plant.velocity_mps()), faults.velocity),
          climb_.show(sensors_.climb_mps(plant.climb_mps()), faults.climb)};
}

dbc::dozer::TrackSpeed DozerReadings::tracks(const DozerPlant& plant, const DozerFaults& faults) {
  const auto shown = [&](unsigned track) {
    return track_[track].show(sensors_.track_speed_mps(plant.track_speeds_mps()[track]),
                              faults.path[track].speed);
  };
  const dbc::Physical left = shown(kLeft);
  return {left, shown(kRight)};
}

}  // namespace graben::plant
