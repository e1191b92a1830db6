#include "app/plant/excavator_plant.hpp"

#include <cmath>

namespace graben::plant {
namespace {

std::size_t sections_on(const PlantProfile& profile, int pump) {
  std::size_t count = 0;
  for (const SpoolProfile& spool : profile.machine.valve.spool) {
    count += spool.pump == pump ? 1U : 0U;
  }
  return count;
}

}  // namespace

ExcavatorPlant::ExcavatorPlant(const PlantProfile& profile, const AxisArray& start_strokes_m)
    : profile_(profile),
      step_s_(profile.step_s()),
      pump_{PumpLine(profile, 0, sections_on(profile, 0)),
            PumpLine(profile, 1, sections_on(profile, 1))},
      section_{ValveSection(profile, kBoom), ValveSection(profile, kArm),
               ValveSection(profile, kBucket)},
      cylinder_{Cylinder(profile, kBoom), Cylinder(profile, kArm), Cylinder(profile, kBucket)},
      links_(profile) {
  std::array<std::size_t, kPumpCount> next_place{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    pump_of_[i] = static_cast<std::size_t>(profile.machine.valve.spool[i].pump);
    place_of_[i] = next_place[pump_of_[i]]++;
  }
  set_bypasses();
  for (PumpLine& pump : pump_) {
    pump.start();
  }
  links_.start(LinkageGeometry(profile.machine.geometry).angles_at(start_strokes_m), {});
  const JointArray holding = links_.holding_forces();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    cylinder_[i].start(links_.levers()[i].stroke_m, holding[i]);
  }
}

void ExcavatorPlant::set_duty(const AxisArray& duty_ratio, bool enable) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    section_[i].set_command(enable && std::isfinite(duty_ratio[i]) ? duty_ratio[i] : 0.0);
  }
}

void ExcavatorPlant::advance(TimeUs duration_us) {
  pending_us_ += duration_us;
  while (pending_us_ >= profile_.step_us) {
    pending_us_ -= profile_.step_us;
    step();
  }
}

void ExcavatorPlant::set_bypasses() {
  std::array<double, kPumpCount> inverse_square{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const double k = section_[i].bypass_coefficient();
    inverse_square[pump_of_[i]] += 1.0 / (k * k);
  }
  for (std::size_t p = 0; p < kPumpCount; ++p) {
    pump_[p].set_bypass(inverse_square[p]);
  }
}

void ExcavatorPlant::step() {
  std::array<PistonLoad, kAxisCount> load;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    PumpLine& pump = pump_[pump_of_[i]];
    flows_[i] =
        section_[i].solve({cylinder_[i].cap_port(), cylinder_[i].rod_port(),
                           pump.supply_port(place_of_[i]), pump.recycle_port(place_of_[i])});
    pump.set_section_flows(place_of_[i], flows_[i].supply_out_m3ps, flows_[i].recycle_in_m3ps);
    load[i] = cylinder_[i].load();
  }
  set_bypasses();
  for (PumpLine& pump : pump_) {
    pump.step();
  }
  const JointArray velocity = links_.accelerate(load, step_s_);
  links_.move(step_s_);
  const JointArray rate = links_.rates();
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    cylinder_[i].step(flows_[i].cap_in_m3ps, flows_[i].rod_in_m3ps, velocity[i]);
    const Lever& lever = links_.levers()[i];
    cylinder_[i].set_motion(lever.stroke_m, lever.stroke_per_angle_m * rate[i]);
    section_[i].step(step_s_);
  }
}

ExcavatorPlant::AxisArray ExcavatorPlant::strokes_m() const {
  const auto& levers = links_.levers();
  return {levers[0].stroke_m, levers[1].stroke_m, levers[2].stroke_m};
}

ExcavatorPlant::AxisArray ExcavatorPlant::stroke_velocities_mps() const {
  const auto& levers = links_.levers();
  const JointArray rate = links_.rates();
  return {levers[0].stroke_per_angle_m * rate[0], levers[1].stroke_per_angle_m * rate[1],
          levers[2].stroke_per_angle_m * rate[2]};
}

ExcavatorPlant::AxisArray ExcavatorPlant::cap_pressures_pa() const {
  return {cylinder_[0].cap().pressure_pa(), cylinder_[1].cap().pressure_pa(),
          cylinder_[2].cap().pressure_pa()};
}

ExcavatorPlant::AxisArray ExcavatorPlant::rod_pressures_pa() const {
  return {cylinder_[0].rod().pressure_pa(), cylinder_[1].rod().pressure_pa(),
          cylinder_[2].rod().pressure_pa()};
}

ExcavatorPlant::AxisArray ExcavatorPlant::spool_travels_ratio() const {
  return {section_[0].spool().travel_ratio(), section_[1].spool().travel_ratio(),
          section_[2].spool().travel_ratio()};
}

ExcavatorPlant::PumpArray ExcavatorPlant::pump_pressures_pa() const {
  return {pump_[0].pressure_pa(), pump_[1].pressure_pa()};
}

ExcavatorPlant::PumpArray ExcavatorPlant::pump_flows_m3ps() const {
  return {pump_[0].flows().delivered_m3ps, pump_[1].flows().delivered_m3ps};
}

}  // namespace graben::plant
