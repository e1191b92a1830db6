// SPDX-License-Identifier: Apache-2.0
/// Pressures where a transducer would be, of the plant in excavator_plant.cpp.

#include <algorithm>

#include "app/plant/excavator_plant.hpp"

namespace graben::plant {

double ExcavatorPlant::valve_pressure_pa(std::size_t drive, const WaveVolume& chamber,
                                         double hose_m3ps, double cushion_pas2pm6) const {
  const double drop = section_[drive].hose_drop_pa(hose_m3ps, cushion_pas2pm6);
  return std::max(profile_.boiling_pa, chamber.pressure_pa() + drop);
}

ExcavatorPlant::AxisArray ExcavatorPlant::cap_pressures_pa() const {
  AxisArray pressure{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    pressure[i] = valve_pressure_pa(i, cylinder_[i].cap(), flows_[i].cap_hose_m3ps,
                                    cylinder_[i].cap_cushion_pas2pm6());
  }
  return pressure;
}

ExcavatorPlant::AxisArray ExcavatorPlant::rod_pressures_pa() const {
  AxisArray pressure{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    pressure[i] = valve_pressure_pa(i, cylinder_[i].rod(), flows_[i].rod_hose_m3ps,
                                    cylinder_[i].rod_cushion_pas2pm6());
  }
  return pressure;
}

/// By shuttle valves from the open sections: before the hose on the fed side, tank's without one.
double ExcavatorPlant::felt_load_pa(std::size_t pump) const {
  if (!pump_[pump].regulator().senses_load()) {
    return 0.0;
  }
  const AxisArray cap = cap_pressures_pa();
  const AxisArray rod = rod_pressures_pa();
  const std::array<double, 2> swing = swing_pressures_pa();
  double most = 0.0;
  for (std::size_t i = 0; i < section_.size(); ++i) {
    if (pump_of_[i] == pump && section_[i].is_open()) {
      const bool extends = section_[i].spool().travel_ratio() > 0.0;
      const double cap_pa = i == kSwing ? swing[0] : cap[i];
      const double rod_pa = i == kSwing ? swing[1] : rod[i];
      most = std::max(most, extends ? cap_pa : rod_pa);
    }
  }
  return most;
}

}  // namespace graben::plant
