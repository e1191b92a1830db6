#include "app/plant/faulty_sensors.hpp"

namespace graben::plant {

FaultySensors::FaultySensors(const ExcavatorPlantProfile& profile)
    : sensors_(profile.sensors,
               profile.sensor_errors ? std::optional(profile.seed) : std::nullopt) {}

dbc::Physical FaultySensors::stroke(std::size_t axis, double true_stroke_m,
                                    const StrokeFault& fault) {
  return stroke_[axis].show(sensors_.stroke_m(axis, true_stroke_m), ReadingFault(fault));
}

dbc::Physical FaultySensors::swing(double true_swing_rad, const AngleFault& fault) {
  return swing_.show(sensors_.swing_rad(true_swing_rad), ReadingFault(fault));
}

dbc::Physical FaultySensors::pressure(double reading_pa, const PressureFault& fault,
                                      double& shown_pa) {
  if (!fault.stuck) {
    shown_pa = reading_pa;
  }
  return {fault.rail_pa ? *fault.rail_pa : shown_pa, dbc::RawState::kValid};
}

dbc::Physical FaultySensors::cap_pressure(std::size_t drive, double true_pressure_pa,
                                          const PressureFault& fault) {
  return pressure(sensors_.cap_pressure_pa(drive, true_pressure_pa), fault, cap_pa_[drive]);
}

dbc::Physical FaultySensors::rod_pressure(std::size_t drive, double true_pressure_pa,
                                          const PressureFault& fault) {
  return pressure(sensors_.rod_pressure_pa(drive, true_pressure_pa), fault, rod_pa_[drive]);
}

}  // namespace graben::plant
