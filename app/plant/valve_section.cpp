// SPDX-License-Identifier: Apache-2.0
#include "app/plant/valve_section.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

constexpr int kGalleryIterations = 40;
constexpr double kGalleryToleranceM3ps = 1e-13;

/// d orifice_flow / d(difference of the waves).
double orifice_slope(double k, const WavePort& from, const WavePort& to) {
  const double h = 0.5 * k * (from.impedance_paspm3 + to.impedance_paspm3);
  // 1 Pa: only where nothing but the ideal square root meets a zero difference.
  return 0.5 * k / std::sqrt(std::max(1.0, std::abs(from.wave_pa - to.wave_pa) + h * h));
}

/// An orifice in a row with what 1 / K^2 describes.
double in_series(double k, double inverse_square) {
  return inverse_square > 0.0 ? k / std::sqrt(1.0 + k * k * inverse_square) : k;
}

}  // namespace

ReturnFlow solve_gallery(double k_out, double k_drain, double k_check, const WavePort& chamber,
                         const WavePort& recycle) {
  const double through = orifice_flow(series_coefficient(k_out, k_drain), chamber, kTank);
  const double ratio = through / k_drain;
  const double gallery_with_check_shut = through > 0.0 ? ratio * ratio : -ratio * ratio;
  if (through <= 0.0 || gallery_with_check_shut <= recycle.wave_pa) {
    return {through, 0.0, gallery_with_check_shut};
  }
  // The surplus out - drain - check falls with the gallery's pressure; its zero is bracketed by the
  // pump line's pressure (check just open) and that with the check shut. Newton, or halving where
  // Newton leaves the bracket.
  double low = std::max(0.0, recycle.wave_pa);
  double high = gallery_with_check_shut;
  WavePort gallery{0.5 * (low + high), 0.0};
  ReturnFlow flow;
  for (int i = 0; i < kGalleryIterations; ++i) {
    flow = {orifice_flow(k_out, chamber, gallery), orifice_flow(k_check, gallery, recycle),
            gallery.wave_pa};
    const double surplus =
        flow.out_m3ps - flow.regenerated_m3ps - orifice_flow(k_drain, gallery, kTank);
    if (std::abs(surplus) < kGalleryToleranceM3ps) {
      break;
    }
    (surplus > 0.0 ? low : high) = gallery.wave_pa;
    const double slope = orifice_slope(k_out, chamber, gallery) +
                         orifice_slope(k_check, gallery, recycle) +
                         orifice_slope(k_drain, gallery, kTank);
    const double newton = gallery.wave_pa + surplus / slope;
    gallery.wave_pa = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return flow;
}

ValveSection::ValveSection(const SectionData& data) : spool_(data.spool), protection_(data.ports) {
  const SpoolProfile& spool = data.edges;
  const auto coefficient = [&data](double area_m2) {
    return orifice_coefficient(area_m2, data.metering.discharge, data.metering.density_kgpm3);
  };
  regeneration_ = spool.regeneration;
  k_extend_in_ = coefficient(spool.extend_in_m2);
  k_extend_out_ = coefficient(spool.extend_out_m2);
  k_retract_in_ = coefficient(spool.retract_in_m2);
  k_retract_out_ = coefficient(spool.retract_out_m2);
  k_drain_ = spool.c_drain;
  k_check_ = spool.c_check;
  k_bypass_open_ = spool.bypass_open;
  k_bypass_closed_ = spool.bypass_closed;
  hose_linear_ = data.hose_linear_paspm3;
  hose_quadratic_ = data.hose_quadratic_pas2pm6;
  compensator_ = data.compensator_pa;
  load_check_ = data.load_check;
  update_openings();
}

bool ValveSection::step(double step_s) {
  const bool moved = spool_.step(step_s);
  if (moved) {
    update_openings();
  }
  return moved;
}

void ValveSection::update_openings() {
  const bool extends = spool_.travel_ratio() > 0.0;
  const double ratio = spool_.area_ratio();
  const double edge = ratio * (extends ? k_extend_in_ : k_retract_in_);
  most_in_ = edge * std::sqrt(compensator_);
  k_in_ = in_series(edge, hose_quadratic_);
  k_out_ = in_series(ratio * (extends ? k_extend_out_ : k_retract_out_), hose_quadratic_);
  const double bypass =
      k_bypass_open_ + (k_bypass_closed_ - k_bypass_open_) * spool_.bypass_closed_ratio();
  bypass_inverse_square_ = 1.0 / (bypass * bypass);
}

double ValveSection::hose_drop_pa(double hose_m3ps, double cushion_pas2pm6) const {
  const double quadratic = hose_quadratic_ + (hose_m3ps < 0.0 ? cushion_pas2pm6 : 0.0);
  return (hose_linear_ + quadratic * std::abs(hose_m3ps)) * hose_m3ps;
}

ReturnFlow ValveSection::return_flow(double k_out, bool regenerates, const WavePort& chamber,
                                     const WavePort& recycle) const {
  if (regenerates && k_out > 0.0) {
    return solve_gallery(k_out, k_drain_, k_check_, chamber, recycle);
  }
  return {orifice_flow(k_out, chamber, kTank), 0.0, 0.0};
}

double ValveSection::checked(double supply_m3ps) const {
  if (load_check_ && supply_m3ps < 0.0) {
    return 0.0;
  }
  return compensator_ > 0.0 ? std::min(supply_m3ps, most_in_) : supply_m3ps;
}

SectionFlows ValveSection::solve(const SectionPorts& ports) const {
  const bool extends = spool_.travel_ratio() > 0.0;
  const bool regenerates =
      regeneration_ == (extends ? RegenerationSide::kExtend : RegenerationSide::kRetract);
  const WavePort& fed = extends ? ports.cap : ports.rod;
  const WavePort& drained = extends ? ports.rod : ports.cap;
  const double fed_cushion = extends ? ports.cap_cushion_pas2pm6 : ports.rod_cushion_pas2pm6;
  const double drained_cushion = extends ? ports.rod_cushion_pas2pm6 : ports.cap_cushion_pas2pm6;

  // The last evaluation of each edge is the one that holds, with a relief or make-up open or not.
  double supply = 0.0;
  const double fed_in = protected_flow(fed, protection_, [&](const WavePort& chamber) {
    const bool leaves = chamber.wave_pa > ports.supply.wave_pa;
    return supply = checked(orifice_flow(leaves ? in_series(k_in_, fed_cushion) : k_in_,
                                         ports.supply, behind_hose(chamber)));
  });
  ReturnFlow back;
  const double k_out = in_series(k_out_, drained_cushion);
  const double drained_in = protected_flow(drained, protection_, [&](const WavePort& chamber) {
    back = return_flow(k_out, regenerates, behind_hose(chamber), ports.recycle);
    return -back.out_m3ps;
  });
  SectionFlows flows;
  flows.cap_in_m3ps = extends ? fed_in : drained_in;
  flows.rod_in_m3ps = extends ? drained_in : fed_in;
  flows.cap_hose_m3ps = extends ? supply : -back.out_m3ps;
  flows.rod_hose_m3ps = extends ? -back.out_m3ps : supply;
  flows.supply_out_m3ps = supply;
  flows.recycle_in_m3ps = back.regenerated_m3ps;
  return flows;
}

}  // namespace graben::plant
