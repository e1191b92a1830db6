// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/found.hpp"

#include "app/plant/random.hpp"

namespace graben::machines {
namespace {

constexpr double kPaPerGpa = 1e9;
constexpr double kRadPerDeg = 0.017453292519943295;

/// Every figure takes its number from the stream, whatever then becomes of it: so none depends on
/// what is told, and none on another.
class Finding {
 public:
  Finding(std::uint64_t seed, bool is_drawn)
      : random_(seed, plant::Draw::kAsFound), is_drawn_(is_drawn) {}

  double around(const std::optional<Told>& told, double nominal, double most) {
    const double share = random_.uniform();
    return chosen(told, share, nominal, nominal + most * (2.0 * share - 1.0));
  }
  double within(const std::optional<Told>& told, double nominal, const Interval& range) {
    const double share = random_.uniform();
    return chosen(told, share, nominal, between(share, range.least, range.most));
  }

 private:
  [[nodiscard]] static double between(double share, double least, double most) {
    return least + share * (most - least);
  }
  [[nodiscard]] double chosen(const std::optional<Told>& told, double share, double nominal,
                              double drawn) const {
    if (told) {
      return between(share, told->least, told->most);
    }
    return is_drawn_ ? drawn : nominal;
  }

  plant::Random random_;
  bool is_drawn_;
};

}  // namespace

void make_as_found(plant::ExcavatorPlantProfile& plant, const FoundRanges& ranges, bool is_drawn,
                   const Found& told) {
  Finding finding(plant.seed, is_drawn);
  // Of a swing that is not driven too: the others' numbers do not depend on it.
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    plant::SpoolDynamics& spool = plant.spool[i];
    for (double* side : {&spool.extend.deadband_ratio, &spool.retract.deadband_ratio}) {
      *side = finding.around(told.deadband_ratio, *side, ranges.deadband_ratio);
    }
    // One draw for both sides: their exponents go up and down together.
    const double exponent_off = finding.around(told.opening_exponent, 0.0, ranges.opening_exponent);
    for (double* side : {&spool.extend.opening_exponent, &spool.retract.opening_exponent}) {
      *side = told.opening_exponent ? exponent_off : *side + exponent_off;
    }
    spool.time_constant_s = finding.within(told.spool_time_constant_s, spool.time_constant_s,
                                           ranges.spool_time_constant_s);
    const double later_s = finding.within(told.dead_time_s, 0.0, {0.0, ranges.dead_time_s});
    plant.dead_time[i].extend_s += later_s;
    plant.dead_time[i].retract_s += later_s;
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    plant.friction[i].coulomb_n *= finding.around(told.friction_factor, 1.0, ranges.friction);
    plant.friction[i].viscous_nspm *= finding.around(told.friction_factor, 1.0, ranges.friction);
    const double mass = finding.around(told.mass_factor, 1.0, ranges.link_mass);
    plant.link[i].mass_kg *= mass;
    plant.link[i].inertia_kgm2 *= mass;
  }
  plant.platform.coulomb_nm *= finding.around(told.friction_factor, 1.0, ranges.friction);
  plant.platform.viscous_nmsprad *= finding.around(told.friction_factor, 1.0, ranges.friction);
  for (double& pump : plant.pump_flow_ratio) {
    pump *= finding.around(told.pump_flow_factor, 1.0, ranges.pump_flow);
  }
  std::optional<Told> told_pa;
  if (told.bulk_modulus_gpa) {
    told_pa =
        Told(kPaPerGpa * told.bulk_modulus_gpa->least, kPaPerGpa * told.bulk_modulus_gpa->most);
  }
  plant.bulk_modulus_pa = finding.within(told_pa, plant.bulk_modulus_pa, ranges.bulk_modulus_pa);
  plant.engine.share =
      finding.within(told.engine_sag_ratio, plant.engine.share, {0.0, ranges.engine_sag});
  // Only where they are told, from numbers behind all others: what was drawn before stays as it is.
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    plant.spool[i].closing_time_constant_s =
        finding.around(told.closing_time_constant_s, plant.spool[i].closing_time_constant_s, 0.0);
    plant.machine.valve.spool[i].bypass_closed *= finding.around(told.bypass_leak_factor, 1.0, 0.0);
  }
  plant.piston_leak_m3pspa *= finding.around(told.piston_leak_factor, 1.0, 0.0);
  for (plant::SpoolDynamics& spool : plant.spool) {
    for (double* side : {&spool.extend.deadband_ratio, &spool.retract.deadband_ratio}) {
      *side += finding.around(told.dead_band_more_ratio, 0.0, 0.0);
    }
  }
  for (double& zero_m : plant.sensors.stroke_zero_m) {
    zero_m += finding.around(told.stroke_zero_more_m, 0.0, 0.0);
  }
  for (double& age_s : plant.sensors.stroke_age_s) {
    age_s = finding.around(told.stroke_age_s, age_s, 0.0);
  }
  plant.rocking_rad = kRadPerDeg * finding.around(told.rocking_deg, 0.0, 0.0);
}

}  // namespace graben::machines
