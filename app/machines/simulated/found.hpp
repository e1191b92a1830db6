// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An excavator as it is found, not as it was designed: what a simulation draws of it, and what its
/// user says of it.

#include <optional>

#include "app/machines/simulated/simulated_sections.hpp"
#include "app/plant/excavator_plant_profile.hpp"

namespace graben::machines {

/// Where what is found may lie; each spool (each side of it), axis and pump by itself.
struct FoundRanges {
  double deadband_ratio = 0.0;    ///< Each way, of the travel.
  double opening_exponent = 0.0;  ///< Each way.
  Interval bulk_modulus_pa;
  Interval spool_time_constant_s;
  double friction = 0.0;     ///< Each way, as a share: Coulomb and viscous, the platform's too.
  double link_mass = 0.0;    ///< Each way, as a share; the inertia with it.
  double pump_flow = 0.0;    ///< Each way, as a share.
  double engine_sag = 0.0;   ///< From 0 on.
  double dead_time_s = 0.0;  ///< From 0 on, beside what the controller is told.
};

/// A figure as its user says it: one value, or from where to where it is drawn.
struct Told {
  double least = 0.0;
  double most = 0.0;

  Told() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): most are one value.
  Told(double value) : least(value), most(value) {}
  Told(double from, double to) : least(from), most(to) {}

  [[nodiscard]] bool is_range() const { return least < most; }
};

inline bool operator==(const Told& told, const Told& other) {
  return told.least == other.least && told.most == other.most;
}

/// What a machine is told to be, of all its spools, axes, pumps alike, or of each by itself within
/// a range.
struct Found {
  std::optional<Told> bulk_modulus_gpa;  ///< As its user says it: the same figure again in a text.
  std::optional<Told> opening_exponent;
  std::optional<Told> deadband_ratio;
  std::optional<Told> spool_time_constant_s;
  std::optional<Told> friction_factor;  ///< On the nominal figures, like the next ones.
  std::optional<Told> mass_factor;
  std::optional<Told> pump_flow_factor;
  std::optional<Told> engine_sag_ratio;
  std::optional<Told> dead_time_s;  ///< Beside what the controller is told.
  /// Of a spool on its way to neutral, where that is another; unless told as on the way out.
  std::optional<Told> closing_time_constant_s;
  // What wears: on what there is, of all pistons, valve sides, sensors alike.
  std::optional<Told> piston_leak_factor;
  std::optional<Told> dead_band_more_ratio;  ///< Of the travel.
  std::optional<Told> stroke_zero_more_m;    ///< Shown too much.
  std::optional<Told> stroke_age_s;          ///< A stroke shows what was so long ago.
  std::optional<Told> bypass_leak_factor;    ///< What a closed bypass still lets through.
  /// Soft ground: so far the machine rocks under the bucket's full force.
  std::optional<Told> rocking_deg;
};

/// Draws what is found from the plant's seed if it `is_drawn`; what is told goes before that, and
/// changes nothing else that is drawn.
void make_as_found(plant::ExcavatorPlantProfile& plant, const FoundRanges& ranges, bool is_drawn,
                   const Found& told);

}  // namespace graben::machines
