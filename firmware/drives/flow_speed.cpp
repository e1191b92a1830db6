// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/flow_speed.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/spool_opening.hpp"
#include "firmware/drives/tuning.hpp"
#include "firmware/numeric/power.hpp"

namespace graben {
namespace {

/// Shares of the travel outside the dead band.
struct Opening {
  double least = 0.0;
  double most = 0.0;
};

Opening opening_of(const DriveRow& drive, const LearntValve* learnt, double spool_ratio) {
  const SpoolAnswer& answer = drive.answer.towards(spool_ratio);
  const double travel_ratio = std::abs(spool_ratio);
  double opening = opening_at(answer, travel_ratio);
  double band = kFlowTravelBand / least_travel_per_opening(answer, travel_ratio - kFlowTravelBand,
                                                           travel_ratio + kFlowTravelBand);
  if (has_edges(drive) && learnt != nullptr) {
    const LearntSide& side = learnt->side(spool_ratio > 0.0);
    opening = opening_by_profile(side, opening);
    // At its edge a valve's exponent says nothing, a little further it does.
    const double there =
        std::clamp(opening, 0.0, 1.0) + kFlowSpreads * opening_spread(side, opening);
    band = std::max(band, kFlowSpreads * opening_spread(side, std::min(there, 1.0)));
  }
  return {std::max(0.0, opening - band), std::max(0.0, opening + band)};
}

double in_series(double first, double second) {
  return first * second / std::sqrt(first * first + second * second);
}

double sqrt_pa(double pressure_pa) { return std::sqrt(std::max(0.0, pressure_pa)); }

/// One way through the valve, seen along it.
struct Way {
  bool extends = false;
  double in_m2 = 0.0;
  double out_m2 = 0.0;
  double fed_area_m2 = 0.0;
  double drained_area_m2 = 0.0;
  double fed_pa = 0.0;
  double drained_pa = 0.0;
  bool regenerates = false;
};

Way way_of(const DriveRow& drive, const ValidDrive& seen) {
  const SpoolProfile& spool = drive.spool;
  if (seen.spool_ratio > 0.0) {
    return {true,
            spool.extend_in_m2,
            spool.extend_out_m2,
            drive.extend_area_m2,
            drive.retract_area_m2,
            seen.cap_pressure_pa,
            seen.rod_pressure_pa,
            spool.regeneration == RegenerationSide::kExtend};
  }
  return {false,
          spool.retract_in_m2,
          spool.retract_out_m2,
          drive.retract_area_m2,
          drive.extend_area_m2,
          seen.rod_pressure_pa,
          seen.cap_pressure_pa,
          spool.regeneration == RegenerationSide::kRetract};
}

/// Outflow with the check valve at its widest: it opens only above the pump's line, which has at
/// least the pressure of what it feeds.
double most_regenerating_m3ps(const SpoolProfile& spool, double out, const Way& way) {
  const double drain = (1.0 + kFlowGalleryBand) * spool.c_drain;
  const double open = drain + (1.0 + kFlowGalleryBand) * spool.c_check;
  const double sqrt_drained = sqrt_pa(way.drained_pa + kFlowZero_pa);
  const double fed_pa = std::max(0.0, way.fed_pa - kFlowZero_pa);
  return std::max(in_series(out, drain) * sqrt_drained,
                  std::min(out * sqrt_pa(way.drained_pa + kFlowZero_pa - fed_pa),
                           in_series(out, open) * sqrt_drained));
}

/// (least / most)^exponent times `most_share`, from below: Bernoulli's inequality and the square.
/// One power a drive and cycle instead of two.
double least_share(const Opening& opening, double exponent, double most_share) {
  const double ratio = opening.least / opening.most;
  const double below = exponent < 1.0 ? ratio : 1.0 + exponent * (ratio - 1.0);
  return most_share * std::max(below, exponent <= 2.0 ? ratio * ratio : 0.0);
}

/// Along the way that the spool opens.
SpeedRange metered_out(const DriveRow& drive, const Way& way, const Opening& opening) {
  const SpoolMetering& metering = drive.metering;
  const double per_area = metering.discharge * std::sqrt(2.0 / metering.density_kgpm3);
  const double share = power(opening.most, metering.opening_exponent);
  const double most = (1.0 + kFlowAreaBand) * share;
  const double least =
      (1.0 - kFlowAreaBand) * least_share(opening, metering.opening_exponent, share);
  const double most_out = per_area * way.out_m2 * most;
  double least_out = per_area * way.out_m2 * least;
  double most_m3ps = most_out * sqrt_pa(way.drained_pa + kFlowZero_pa);
  if (way.regenerates) {
    most_m3ps = most_regenerating_m3ps(drive.spool, most_out, way);
    least_out = in_series(least_out, (1.0 - kFlowGalleryBand) * drive.spool.c_drain);
  }
  const double drop_pa = way.drained_pa - kFlowZero_pa - kFlowReturn_pa;
  const double back_m3ps = per_area * way.in_m2 * most * sqrt_pa(way.fed_pa + kFlowZero_pa);
  return {drop_pa > 0.0 ? least_out * sqrt_pa(drop_pa) / way.drained_area_m2
                        : -back_m3ps / way.fed_area_m2,
          most_m3ps / way.drained_area_m2};
}

SpeedRange metered_in(const DriveRow& drive, const Way& way, const Opening& opening,
                      double engine_radps) {
  const DriveSupply& supply = drive.supply;
  const double least_m3ps =
      std::min(opening.least * supply.valve_flow_m3ps, supply.pump_m3prad * engine_radps);
  const double most_m3ps = opening.most * supply.valve_flow_m3ps;
  return {(1.0 - kFlowSupplyBand) * least_m3ps / way.fed_area_m2,
          (1.0 + kFlowSupplyBand) * most_m3ps / way.fed_area_m2};
}

SpeedRange through_valve(const DriveRow& drive, const LearntValve* learnt, const ValidDrive& seen,
                         double engine_radps) {
  const Opening opening = opening_of(drive, learnt, seen.spool_ratio);
  if (opening.most == 0.0) {
    return {};
  }
  const Way way = way_of(drive, seen);
  const SpeedRange along = has_edges(drive) ? metered_out(drive, way, opening)
                                            : metered_in(drive, way, opening, engine_radps);
  if (std::abs(seen.spool_ratio) <= kFlowTravelBand) {
    // As good as closed: where there is hardly a dead band, it may be open to the other side.
    return {-along.most_mps, along.most_mps};
  }
  return way.extends ? along : SpeedRange{-along.most_mps, -along.least_mps};
}

}  // namespace

SpeedRange possible_speed(const DriveRow& drive, const LearntValve* learnt, const ValidDrive& seen,
                          double engine_radps) {
  const double leak_mps = drive.watch.leak_mpspa * (seen.cap_pressure_pa - seen.rod_pressure_pa);
  const SpeedRange open = through_valve(drive, learnt, seen, engine_radps);
  return {open.least_mps - std::max(0.0, leak_mps), open.most_mps - std::min(0.0, leak_mps)};
}

}  // namespace graben
