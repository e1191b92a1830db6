// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/hidden.hpp"

#include <algorithm>

#include "app/plant/random.hpp"

namespace graben::machines {
namespace {

/// What is drawn, each with places of its own in the stream. Numbers are never changed, only added.
enum class Figure : std::uint32_t {
  kEdge = 1,
  kSoftness,
  kExponent,
  kDeadTime,
  kDeadTimeApart,
  kLag,
  kSpoolLagShare,
  kArea,
  kPumpFlow,
  kOil,
  kCoulomb,
  kViscous,
  kMass,
  kStrokeZero,
  kPressureZero,
  kMargin,
  kResponse,
  kFeltPressure,
  kLeastSwash,
  kClosesAt,
};

class Hiding {
 public:
  explicit Hiding(std::uint64_t seed) : seed_(seed) {}

  /// `place`: which drive, side, axis, pump of those that have the figure.
  [[nodiscard]] double within(Figure figure, std::size_t place, const Interval& range) const {
    return range.least + random(figure, place).uniform() * (range.most - range.least);
  }
  [[nodiscard]] double symmetric(Figure figure, std::size_t place, double most) const {
    return random(figure, place).symmetric(most);
  }
  [[nodiscard]] double factor(Figure figure, std::size_t place, double share) const {
    return 1.0 + symmetric(figure, place, share);
  }

 private:
  [[nodiscard]] plant::Random random(Figure figure, std::size_t place) const {
    constexpr std::uint32_t kPlaces = 64;
    return {seed_, plant::Draw::kHidden,
            kPlaces * static_cast<std::uint32_t>(figure) + static_cast<std::uint32_t>(place)};
  }

  std::uint64_t seed_;
};

void hide_side(plant::SpoolSide& side, const Hiding& hiding, std::size_t place,
               const HiddenRanges& ranges) {
  side.deadband_ratio = hiding.within(Figure::kEdge, place, ranges.edge_ratio);
  side.softness_ratio = hiding.within(Figure::kSoftness, place, ranges.softness_ratio);
  side.opening_exponent = hiding.within(Figure::kExponent, place, ranges.opening_exponent);
}

void hide_lags(plant::ExcavatorPlantProfile& plant, const Hiding& hiding, std::size_t drive,
               const HiddenRanges& ranges) {
  const Interval& range = ranges.dead_time_s;
  const double mean_s = hiding.within(Figure::kDeadTime, drive, range);
  const double apart_s = hiding.symmetric(Figure::kDeadTimeApart, drive, ranges.dead_time_apart_s);
  plant.dead_time[drive] = {std::clamp(mean_s + apart_s, range.least, range.most),
                            std::clamp(mean_s - apart_s, range.least, range.most)};
  const double lag_s = hiding.within(Figure::kLag, drive, ranges.lag_s);
  const double spool_s =
      lag_s * hiding.within(Figure::kSpoolLagShare, drive, ranges.spool_lag_share);
  plant.spool[drive].damping = 1.0;
  plant.spool[drive].time_constant_s = 0.5 * spool_s;
  plant.pilot_lag_s[drive] = lag_s - spool_s;
}

void hide_drive(plant::ExcavatorPlantProfile& plant, const Hiding& hiding, std::size_t drive,
                const HiddenRanges& ranges) {
  plant::SpoolDynamics& spool = plant.spool[drive];
  hide_side(spool.extend, hiding, 2 * drive, ranges);
  hide_side(spool.retract, hiding, 2 * drive + 1, ranges);
  plant::fit_bypass(spool);
  hide_lags(plant, hiding, drive, ranges);
  const auto area = [&](std::size_t which) {
    return hiding.factor(Figure::kArea, 4 * drive + which, ranges.area);
  };
  plant.area_factors[drive] = {area(0), area(1), area(2), area(3)};
  plant::SensorErrors& sensors = plant.sensors;
  sensors.cap_zero_pa[drive] =
      hiding.symmetric(Figure::kPressureZero, 2 * drive, ranges.pressure_zero_pa);
  sensors.rod_zero_pa[drive] =
      hiding.symmetric(Figure::kPressureZero, 2 * drive + 1, ranges.pressure_zero_pa);
}

void hide_link(plant::ExcavatorPlantProfile& plant, const Hiding& hiding, std::size_t axis,
               const HiddenRanges& ranges) {
  plant.friction[axis].coulomb_n *= hiding.factor(Figure::kCoulomb, axis, ranges.friction);
  plant.friction[axis].viscous_nspm *= hiding.factor(Figure::kViscous, axis, ranges.friction);
  const double mass = hiding.factor(Figure::kMass, axis, ranges.mass);
  plant.link[axis].mass_kg *= mass;
  plant.link[axis].inertia_kgm2 *= mass;
  plant.sensors.stroke_zero_m[axis] =
      hiding.symmetric(Figure::kStrokeZero, axis, ranges.stroke_zero_m);
}

void hide_regulator(plant::ExcavatorPlantProfile& plant, const Hiding& hiding, std::size_t pump,
                    const HiddenRanges& ranges) {
  PumpRegulator& by = plant.machine.pump[pump].regulator;
  by.margin_pa *= hiding.factor(Figure::kMargin, pump, ranges.margin);
  by.response_s *= hiding.factor(Figure::kResponse, pump, ranges.response);
  by.full_swash_pa *= hiding.factor(Figure::kFeltPressure, 2 * pump, ranges.felt_pressure);
  by.least_swash_pa *= hiding.factor(Figure::kFeltPressure, 2 * pump + 1, ranges.felt_pressure);
  by.least_swash_ratio *= hiding.factor(Figure::kLeastSwash, pump, ranges.least_swash);
}

}  // namespace

SimulatedExcavator hidden_machine(const SimulatedExcavator& nominal, std::uint64_t seed) {
  const HiddenRanges ranges;
  const Hiding hiding(seed);
  SimulatedExcavator machine = nominal;
  plant::ExcavatorPlantProfile& plant = machine.plant;
  machine.has_dead_time = true;
  // Of a swing that is not driven too: nothing looks at it.
  for (std::size_t drive = 0; drive < kDriveCount; ++drive) {
    hide_drive(plant, hiding, drive, ranges);
  }
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    hide_link(plant, hiding, axis, ranges);
  }
  plant.platform.coulomb_nm *= hiding.factor(Figure::kCoulomb, kSwing, ranges.friction);
  plant.platform.viscous_nmsprad *= hiding.factor(Figure::kViscous, kSwing, ranges.friction);
  plant.platform.inertia_kgm2 *= hiding.factor(Figure::kMass, kSwing, ranges.mass);
  for (std::size_t pump = 0; pump < kPumpCount; ++pump) {
    plant.pump_flow_ratio[pump] *= hiding.factor(Figure::kPumpFlow, pump, ranges.pump_flow);
  }
  plant.bulk_modulus_pa = hiding.within(Figure::kOil, 0, ranges.bulk_modulus_pa);
  for (std::size_t pump = 0; pump < kPumpCount; ++pump) {
    hide_regulator(plant, hiding, pump, ranges);
  }
  for (plant::SpoolDynamics& spool : plant.spool) {
    spool.bypass_closes_at *= hiding.factor(Figure::kClosesAt, 0, ranges.closes_at);
  }
  return machine;
}

}  // namespace graben::machines
