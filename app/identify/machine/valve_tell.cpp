// SPDX-License-Identifier: Apache-2.0
// What the problem's values and their covariance say of the machine.
#include "app/identify/machine/valve_problem.hpp"

namespace graben::identify {
namespace {

/// A side is driven where a steady point of it was at least so fast.
constexpr double kMoves_mps = 0.01;
constexpr double kTravelOff = 0.002;

/// Of the sides that were driven, at a share of the travel behind their start: each area grows by a
/// power of its own.
double mean_opening(const MachineEstimate& machine, double share, const SpoolMetering& metering) {
  double sum = 0.0;
  int sides = 0;
  for (const DriveEstimate& drive : machine.drive) {
    for (const SideEstimate* side : {&drive.extend, &drive.retract}) {
      if (side->driven_most > 0.0) {
        sum += std::pow(share, side->exponent.value / metering.opening_exponent);
        ++sides;
      }
    }
  }
  return sides > 0 ? sum / sides : share;
}

}  // namespace

void ValveProblem::tell_side(const DriveModel& model, std::size_t side, SideEstimate& to) const {
  const auto& block = blocks_.side[side];
  const std::size_t first = side * kSideSize;
  to.edge = found(block[kEdge], first + kEdge, priors_.edge);
  const double softness = std::exp(block[kLogSoftness]);
  to.softness = found(softness, first + kLogSoftness, priors_.log_softness);
  to.softness.deviation *= softness;
  to.exponent = found(block[kExponent], first + kExponent, priors_.exponent);
  to.coefficient_factor =
      found(std::exp(block[kLogCoefficient]), first + kLogCoefficient, priors_.log_coefficient);
  to.coefficient_factor.deviation *= to.coefficient_factor.value;
  to.out_area_factor =
      found(std::exp(block[kLogOutArea]), first + kLogOutArea, priors_.log_out_area);
  to.out_area_factor.deviation *= to.out_area_factor.value;
  if (model.pump_kind() == PumpKind::kLoadSensing) {
    to.in_area_factor = to.coefficient_factor.value;
    const double whole = coefficient_of(model, static_cast<int>(side) / 2, side % 2 == 0,
                                        to.in_area_factor, to.out_area_factor.value);
    to.coefficient_factor.deviation *= whole / to.in_area_factor;
    to.coefficient_factor.value = whole;
  }
  if (falls_) {
    const double share = std::exp(blocks_.regulator[0]) *
                         closing_share(model, static_cast<int>(side) / 2, side % 2 == 0);
    const double start = to.curve().start();
    to.bypass_closed_at = start + std::min(1.0, share) * (1.0 - start);
  }
  // Of the travel at each opening, by the curve's three values.
  constexpr double kStep = 1e-4;
  const Eigen::Matrix3d covariance =
      covariance_.block<3, 3>(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(first));
  to.duty.clear();
  to.duty_deviation.clear();
  for (const double opening : kTableOpenings) {
    const double area = std::pow(opening, model.metering.opening_exponent);
    to.duty.push_back(to.curve().travel_at(area));
    Eigen::Vector3d slope;
    for (std::size_t at = 0; at <= kExponent; ++at) {
      auto moved = block;
      moved[at] += kStep;
      const auto travel = [area](const auto& of) {
        return OpeningCurve{of[kEdge], std::exp(of[kLogSoftness]), of[kExponent]}.travel_at(area);
      };
      slope[static_cast<Eigen::Index>(at)] = (travel(moved) - travel(block)) / kStep;
    }
    to.duty_deviation.push_back(kModel * std::sqrt(std::max(0.0, slope.dot(covariance * slope))) +
                                kTravelOff);
  }
}

void ValveProblem::tell_regulators(const DriveModel& model, MachineEstimate& machine) const {
  const auto scaled = [](const Estimate& factor, double value) {
    return Estimate{factor.value * value, factor.deviation * factor.value * value, factor.known};
  };
  const Estimate closes =
      found(std::exp(blocks_.regulator[0]), kRegulatorAt, priors_.log_closes_at);
  machine.closes_at_factor = closes.value;
  machine.bypass_closes_at = closes;
  machine.bypass_closes_at.value =
      mean_opening(machine, closes.value * closing_share(model, 0, true), model.metering);
  machine.bypass_closes_at.deviation *= machine.bypass_closes_at.value;
  const Estimate felt = found(std::exp(blocks_.regulator[1]), kRegulatorAt + 1, priors_.log_felt);
  for (std::size_t j = 0; j < static_cast<std::size_t>(model.valve.pump_count); ++j) {
    const PumpRegulator& by = model.pump[j].regulator;
    machine.regulator[j].full_swash_pa = scaled(felt, by.full_swash_pa);
    machine.regulator[j].least_swash_pa = scaled(felt, by.least_swash_pa);
  }
}

void ValveProblem::tell(const DriveModel& model, MachineEstimate& machine) const {
  std::array<double, kSides> least{};
  std::array<double, kSides> most{};
  for (const PreparedPoint& of : points_) {
    const SteadyPoint& point = of.point();
    const double along_mps = of.extends() ? point.speed_mps : -point.speed_mps;
    if (along_mps > kMoves_mps) {
      const std::size_t side = side_of(point.axis, of.extends());
      const double travel = std::abs(point.spool);
      least[side] = least[side] == 0.0 ? travel : std::min(least[side], travel);
      most[side] = std::max(most[side], travel);
    }
  }
  for (std::size_t axis = 0; axis < drives_; ++axis) {
    DriveEstimate& drive = machine.drive[axis];
    for (const bool extends : {true, false}) {
      const std::size_t side = side_of(static_cast<int>(axis), extends);
      drive.side(extends).driven_least = least[side];
      drive.side(extends).driven_most = most[side];
      if (most[side] > 0.0) {
        tell_side(model, side, drive.side(extends));
      }
    }
    const std::size_t zero = kZerosAt + axis * kZeroSize;
    const auto in_pa = [&](std::size_t at) {
      Estimate estimate = found(blocks_.zero[axis][at], zero + at, priors_.zero_pa / kPaPerMpa);
      estimate.value *= kPaPerMpa;
      estimate.deviation *= kPaPerMpa;
      return estimate;
    };
    drive.cap_zero_pa = in_pa(0);
    drive.rod_zero_pa = in_pa(1);
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    machine.pump_flow_factor[j] = found(blocks_.pump[j][0], kPumpsAt + j, priors_.pump_flow);
  }
  if (falls_) {
    tell_regulators(model, machine);
  }
}

}  // namespace graben::identify
