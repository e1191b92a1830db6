// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/plain_circuit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::test {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15u + 1) {}

  /// [0, 1), from the engine alone: the library's distributions differ from place to place.
  double unit() { return static_cast<double>(engine_() >> 11u) * 0x1p-53; }
  double uniform(double least, double most) { return least + (most - least) * unit(); }
  double spread(double least, double most) { return least * std::pow(most / least, unit()); }
  int whole(int least, int most) {
    return least + static_cast<int>(unit() * static_cast<double>(most - least + 1));
  }
  bool chance(double share) { return unit() < share; }

 private:
  std::mt19937_64 engine_;
};

MonotoneTable random_table(Draw& draw) {
  const int count = draw.whole(2, MonotoneTable::capacity());
  std::array<double, MonotoneTable::capacity()> travel{};
  std::array<double, MonotoneTable::capacity()> coefficient{};
  for (int i = 1; i < count; ++i) {
    const auto k = static_cast<unsigned>(i);
    travel[k] = travel[k - 1] + draw.uniform(0.02, 1.0);
    coefficient[k] = coefficient[k - 1] + draw.uniform(0.02, 1.0);
  }
  const auto last = static_cast<unsigned>(count - 1);
  const double travel_scale = draw.uniform(0.005, 0.02) / travel[last];
  const double coefficient_scale = draw.spread(2e-4, 5e-3) / coefficient[last];
  for (unsigned k = 1; k <= last; ++k) {
    travel[k] *= travel_scale;
    coefficient[k] *= coefficient_scale;
  }
  MonotoneTable table;
  static_cast<void>(table.fill(travel.data(), coefficient.data(), count));
  return table;
}

McvActuator random_actuator(Draw& draw, int pump_count) {
  McvActuator actuator;
  actuator.area_cap_m2 = draw.spread(0.004, 0.03);
  actuator.area_rod_m2 = actuator.area_cap_m2 * draw.uniform(0.3, 1.1);
  actuator.pump = draw.whole(0, pump_count - 1);
  actuator.regeneration = static_cast<RegenerationSide>(draw.whole(-1, 1));
  actuator.c_drain = draw.spread(2e-7, 3e-6);
  actuator.c_check = actuator.c_drain *
                     (draw.chance(0.1) ? 1.0 + draw.spread(1e-12, 1e-3) : draw.spread(1.01, 8.0));
  actuator.bypass_open = draw.spread(2e-6, 8e-6);
  actuator.bypass_closed = draw.spread(5e-8, 2e-6);
  actuator.force_offset_n = draw.chance(0.2) ? 0.0 : draw.spread(50.0, 2e4);
  actuator.c_inflow_check = draw.chance(0.2) ? draw.spread(5e-7, 5e-6) : 0.0;
  actuator.extend = random_table(draw);
  actuator.retract = random_table(draw);
  return actuator;
}

/// A load that pushes oil out faster than the pump refills: what splits the feasible set.
void let_load_run(Draw& draw, unsigned i, RandomCase& result) {
  McvActuator& actuator = result.machine.actuator[i];
  actuator.area_rod_m2 = actuator.area_cap_m2 * draw.uniform(0.35, 0.65);
  actuator.regeneration = RegenerationSide::kRetract;
  actuator.c_drain = actuator.area_cap_m2 * draw.spread(3e-5, 3e-4);
  actuator.c_check = actuator.c_drain * draw.uniform(1.1, 3.0);
  result.input.velocity_mps[i] = -draw.uniform(0.1, 0.9);
  result.input.cap_pressure_pa[i] = draw.uniform(5e6, 2.6e7);
  result.input.rod_pressure_pa[i] = draw.uniform(5e5, 3e6);
}

/// (29), (30) with equality: the pump just feeds its line at full speed, and holds no pressure.
void feed_exactly(RandomCase& result, unsigned pump) {
  double least_m3ps = 0.0;
  for (unsigned i = 0; i < static_cast<unsigned>(result.machine.actuator_count); ++i) {
    const McvActuator& actuator = result.machine.actuator[i];
    const double velocity = result.input.velocity_mps[i];
    if (actuator.pump != static_cast<int>(pump)) {
      continue;
    }
    const bool extends = velocity > 0.0;
    least_m3ps += (extends ? actuator.area_cap_m2 : actuator.area_rod_m2) * std::abs(velocity);
    if (actuator.regeneration ==
        (extends ? RegenerationSide::kExtend : RegenerationSide::kRetract)) {
      least_m3ps -= (extends ? actuator.area_rod_m2 : actuator.area_cap_m2) * std::abs(velocity) *
                    actuator.c_check / (actuator.c_check + actuator.c_drain);
    }
  }
  if (least_m3ps > 0.0) {
    result.input.pump_flow_m3ps[pump] = least_m3ps;
  }
}

/// A swing's motor among the cylinders: equal areas, alike both ways, nothing to regenerate.
void make_motor(McvActuator& actuator) {
  actuator.area_rod_m2 = actuator.area_cap_m2;
  actuator.regeneration = RegenerationSide::kNone;
  actuator.retract = actuator.extend;
}

/// Three cylinders and a swing on one pump, as the 12 t machine has them.
void hang_on_one_pump(RandomCase& result) {
  result.machine.pump_count = 1;
  for (unsigned i = 0; i < static_cast<unsigned>(result.machine.actuator_count); ++i) {
    result.machine.actuator[i].pump = 0;
  }
  make_motor(result.machine.actuator[kSwing]);
}

}  // namespace

RandomCase random_case(std::uint64_t seed) {
  Draw draw(seed);
  RandomCase result;
  McvMachine& machine = result.machine;
  machine.pump_count = draw.whole(1, kMaxPumps);
  machine.actuator_count = draw.whole(1, kMaxActuators);
  for (unsigned j = 0; j < static_cast<unsigned>(machine.pump_count); ++j) {
    McvPump& pump = machine.pump[j];
    pump.leak_linear = draw.chance(0.2) ? 0.0 : draw.spread(1e-13, 3e-11);
    pump.leak_quadratic = draw.chance(0.3) ? 0.0 : draw.spread(1e-21, 1e-17);
    for (int n = draw.whole(0, 3); n > 0; --n) {
      pump.series_resistance += std::pow(draw.spread(1e-6, 6e-6), -2.0);
    }
    pump.has_relief = draw.chance(0.5);
    pump.relief_pa = pump.has_relief ? draw.spread(3e6, 4e7) : 0.0;
    result.input.pump_flow_m3ps[j] = draw.chance(0.04) ? 0.0 : draw.spread(3e-4, 1e-2);
  }
  for (unsigned i = 0; i < static_cast<unsigned>(machine.actuator_count); ++i) {
    machine.actuator[i] = random_actuator(draw, machine.pump_count);
    McvInput& input = result.input;
    const double speed = draw.chance(0.1) ? 0.0 : draw.spread(1e-3, 0.8);
    input.velocity_mps[i] = draw.chance(0.5) ? speed : -speed;
    const double most_pa = draw.spread(2e5, 2e7);
    input.cap_pressure_pa[i] = draw.uniform(0.0, most_pa);
    input.rod_pressure_pa[i] = draw.uniform(0.0, most_pa);
    if (draw.chance(0.3)) {
      let_load_run(draw, i, result);
    }
  }
  if (draw.chance(0.05)) {
    feed_exactly(result, static_cast<unsigned>(draw.whole(0, machine.pump_count - 1)));
  }
  // Last, so that what else a seed draws stays what it was.
  if (machine.actuator_count == kDriveCount && draw.chance(0.5)) {
    hang_on_one_pump(result);
  }
  return result;
}

}  // namespace graben::test
