// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/hidden_dozer.hpp"

#include <algorithm>

#include "app/plant/random.hpp"

namespace graben::machines {
namespace {

/// What is drawn, each with places of its own in the stream, beyond those of the excavators.
/// Numbers are never changed, only added.
enum class DozerFigure : std::uint32_t {
  kEdge = 101,
  kSoftness,
  kExponent,
  kDeadTime,
  kDeadTimeApart,
  kLag,
  kSpoolShare,
  kValveFlow,
  kPumpFlow,
  kOil,
  kFriction,
  kMass,
  kLeak,
  kTrackFlow,
  kTrackApart,
  kServoLag,
  kServoDeadTime,
  kRolling,
  kGauge,
};

class DozerDraw {
 public:
  explicit DozerDraw(std::uint64_t seed) : seed_(seed) {}

  /// `place`: which drive, side or track of those that have the figure.
  [[nodiscard]] double within(DozerFigure figure, std::size_t place, double least,
                              double most) const {
    return least + random(figure, place).uniform() * (most - least);
  }
  [[nodiscard]] double symmetric(DozerFigure figure, std::size_t place, double most) const {
    return random(figure, place).symmetric(most);
  }
  [[nodiscard]] double factor(DozerFigure figure, std::size_t place, double share) const {
    return 1.0 + symmetric(figure, place, share);
  }

 private:
  [[nodiscard]] plant::Random random(DozerFigure figure, std::size_t place) const {
    constexpr std::uint32_t kPlaces = 64;
    return {seed_, plant::Draw::kHidden,
            kPlaces * static_cast<std::uint32_t>(figure) + static_cast<std::uint32_t>(place)};
  }

  std::uint64_t seed_;
};

plant::SpoolSide drawn_side(const DozerDraw& draw, std::size_t place,
                            const HiddenDozerRanges& ranges) {
  plant::SpoolSide side;
  side.deadband_ratio = draw.within(DozerFigure::kEdge, place, ranges.edge_least, ranges.edge_most);
  side.softness_ratio =
      draw.within(DozerFigure::kSoftness, place, ranges.softness_least, ranges.softness_most);
  side.opening_exponent =
      draw.within(DozerFigure::kExponent, place, ranges.exponent_least, ranges.exponent_most);
  return side;
}

plant::BladeValve drawn_valve(const plant::DozerPlantProfile& plant, const DozerDraw& draw,
                              std::size_t drive, const HiddenDozerRanges& ranges) {
  plant::BladeValve valve = plant.valve(drive);
  valve.spool.extend = drawn_side(draw, 2 * drive, ranges);
  valve.spool.retract = drawn_side(draw, 2 * drive + 1, ranges);
  const double dead_s = draw.within(DozerFigure::kDeadTime, drive, 0.0, ranges.dead_time_most_s);
  const double apart_s =
      draw.symmetric(DozerFigure::kDeadTimeApart, drive, ranges.dead_time_apart_s);
  valve.dead_time = {std::clamp(dead_s + apart_s, 0.0, ranges.dead_time_most_s),
                     std::clamp(dead_s - apart_s, 0.0, ranges.dead_time_most_s)};
  const double lag_s = draw.within(DozerFigure::kLag, drive, ranges.lag_least_s, ranges.lag_most_s);
  const double spool_s = lag_s * draw.within(DozerFigure::kSpoolShare, drive, 0.25, 0.75);
  valve.spool.damping = 1.0;
  valve.spool.time_constant_s = 0.5 * spool_s;
  valve.pilot_lag_s = lag_s - spool_s;
  valve.flow_factor = draw.factor(DozerFigure::kValveFlow, drive, ranges.valve_flow);
  return valve;
}

void draw_tracks(const DozerDraw& draw, const HiddenDozerRanges& ranges,
                 plant::DozerPlantProfile& plant) {
  const double both = draw.factor(DozerFigure::kTrackFlow, 0, ranges.track_flow);
  for (std::size_t track = 0; track < kTrackCount; ++track) {
    plant.track_flow_factor[track] =
        both * draw.factor(DozerFigure::kTrackApart, track, ranges.track_apart);
  }
  plant.pump_response_s *= draw.factor(DozerFigure::kServoLag, 0, ranges.servo_lag);
  plant.motor_response_s *= draw.factor(DozerFigure::kServoLag, 1, ranges.servo_lag);
  plant.displacement_dead_time_s =
      draw.within(DozerFigure::kServoDeadTime, 0, 0.0, ranges.servo_dead_time_most_s);
  plant.ground.rolling_resistance *= draw.factor(DozerFigure::kRolling, 0, ranges.rolling);
  plant.machine.body.half_gauge_m *= draw.factor(DozerFigure::kGauge, 0, ranges.gauge);
}

}  // namespace

SimulatedDozer hidden_dozer(const SimulatedDozer& nominal, std::uint64_t seed) {
  const HiddenDozerRanges ranges;
  const DozerDraw draw(seed);
  SimulatedDozer machine = nominal;
  plant::DozerPlantProfile& plant = machine.plant;
  for (std::size_t drive = 0; drive < plant.own_valve.size(); ++drive) {
    plant.own_valve[drive] = drawn_valve(nominal.plant, draw, drive, ranges);
  }
  plant.machine.implement.displacement_m3prev *=
      draw.factor(DozerFigure::kPumpFlow, 0, ranges.pump_flow);
  plant.bulk_modulus_pa =
      draw.within(DozerFigure::kOil, 0, ranges.bulk_modulus_least_pa, ranges.bulk_modulus_most_pa);
  plant.coulomb_n *= draw.factor(DozerFigure::kFriction, 0, ranges.friction);
  plant.viscous_nspm *= draw.factor(DozerFigure::kFriction, 1, ranges.friction);
  plant.tilt.coulomb_n *= draw.factor(DozerFigure::kFriction, 2, ranges.friction);
  plant.tilt.viscous_nspm *= draw.factor(DozerFigure::kFriction, 3, ranges.friction);
  const double mass = draw.factor(DozerFigure::kMass, 0, ranges.mass);
  plant.machine.body.mass_kg *= mass;
  plant.blade_mass_kg *= mass;
  plant.pitch_inertia_kgm2 *= mass;
  plant.tilt.roll_inertia_kgm2 *= mass;
  plant.piston_leak_m3pspa *=
      draw.within(DozerFigure::kLeak, 0, ranges.piston_leak_least, ranges.piston_leak_most);
  draw_tracks(draw, ranges, plant);
  plant.sensor_errors = true;
  plant.seed = seed;
  return machine;
}

}  // namespace graben::machines
