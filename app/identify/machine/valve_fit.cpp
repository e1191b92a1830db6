// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/valve_fit.hpp"

#include <Eigen/Cholesky>
#include <map>

#include "app/identify/machine/valve_problem.hpp"

namespace graben::identify {
namespace {

constexpr double kSpeedShare = 0.02;  ///< Of a speed, that the model is off.
constexpr double kOutShare = 0.06;    ///< The same by the draining side.
/// Of the line's pressure, which nothing measures: hoses, what a pump is off at a pressure.
constexpr double kLine_pa = 0.25e6;
/// The weights depend on where the curves are, so they are made anew so often.
constexpr int kPasses = 3;
constexpr double kLeastSoftness = 0.001;
constexpr double kMostSoftness = 0.15;
constexpr double kUsualSoftness = 0.008;
constexpr int kSteps = 60;
constexpr double kMostRegulator = 0.9;  ///< Logarithm of a regulator's factor.
/// A side is driven where a steady point of it was at least so fast.
constexpr double kMoves_mps = 0.01;

/// Where a block's values stand among all.
std::map<const double*, std::size_t> places_of(const Blocks& blocks, std::size_t drives) {
  std::map<const double*, std::size_t> places;
  for (std::size_t side = 0; side < 2 * drives; ++side) {
    places[blocks.side[side].data()] = side * kSideSize;
  }
  for (std::size_t axis = 0; axis < drives; ++axis) {
    places[blocks.zero[axis].data()] = kZerosAt + axis * kZeroSize;
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    places[blocks.pump[j].data()] = kPumpsAt + j;
  }
  places[blocks.regulator.data()] = kRegulatorAt;
  return places;
}

}  // namespace

ValveProblem::ValveProblem(const std::vector<PreparedPoint>& points, const ValvePriors& priors,
                           const MachineEstimate& machine, const DriveModel& model)
    : points_(points),
      priors_(priors),
      drives_(model.drives()),
      falls_(model.pump_kind() == PumpKind::kNegativeFlow) {
  start(machine);
  spread_.resize(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const PreparedPoint& of = points[n];
    const int axis = of.point().axis;
    auto* const cost = new PointCost(&of, &spread_[n]);
    double* const side = blocks_.side[side_of(axis, of.extends())].data();
    double* const zero = blocks_.zero[static_cast<std::size_t>(axis)].data();
    double* const pump = blocks_.pump[static_cast<std::size_t>(of.pump())].data();
    if (falls_) {
      problem_.AddResidualBlock(
          new ceres::NumericDiffCostFunction<PointCost, ceres::CENTRAL, 2, kSideSize, kZeroSize, 1,
                                             kRegulatorSize>(cost, ceres::TAKE_OWNERSHIP, 2,
                                                             steps()),
          new ceres::CauchyLoss(2.0), side, zero, pump, blocks_.regulator.data());
    } else {
      problem_.AddResidualBlock(
          new ceres::NumericDiffCostFunction<PointCost, ceres::CENTRAL, 2, kSideSize, kZeroSize, 1>(
              cost, ceres::TAKE_OWNERSHIP, 2, steps()),
          new ceres::CauchyLoss(2.0), side, zero, pump);
    }
  }
  add_priors(machine);
}

void ValveProblem::solve() {
  for (auto& side : blocks_.side) {
    bound(side.data(), kEdge, 0.02, 0.85);
    bound(side.data(), kLogSoftness, std::log(kLeastSoftness), std::log(kMostSoftness));
    bound(side.data(), kExponent, 0.6, 3.0);
  }
  for (auto& pump : blocks_.pump) {
    bound(pump.data(), 0, 0.6, 1.4);
  }
  for (std::size_t at = 0; at < kRegulatorSize; ++at) {
    bound(blocks_.regulator.data(), at, -kMostRegulator, kMostRegulator);
  }
  ceres::Solver::Options options;
  options.max_num_iterations = kSteps;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  for (int pass = 0; pass < kPasses; ++pass) {
    weigh();
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
  }
  find_covariance();
}

void ValveProblem::start(const MachineEstimate& machine) {
  for (std::size_t axis = 0; axis < drives_; ++axis) {
    const DriveEstimate& drive = machine.drive[axis];
    for (const bool extends : {true, false}) {
      const SideEstimate& side = drive.side(extends);
      blocks_.side[side_of(static_cast<int>(axis), extends)] = {
          side.edge.value, std::log(std::max(side.softness.value, kUsualSoftness)),
          side.exponent.value, std::log(side.coefficient_factor.value),
          std::log(side.out_area_factor.value)};
    }
    blocks_.zero[axis] = {drive.cap_zero_pa.value / kPaPerMpa, drive.rod_zero_pa.value / kPaPerMpa};
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    blocks_.pump[j] = {machine.pump_flow_factor[j].value};
  }
  start_at_edges();
}

/// Between the farthest spool that moves nothing and the nearest that moves its drive: from there
/// the fit need not look for an edge through flat ground.
void ValveProblem::start_at_edges() {
  std::array<double, kSides> nearest{};
  nearest.fill(1.0);
  for (const PreparedPoint& of : points_) {
    const SteadyPoint& point = of.point();
    const double along_mps = of.extends() ? point.speed_mps : -point.speed_mps;
    if (along_mps > 0.6 * kMoves_mps) {
      double& at = nearest[side_of(point.axis, of.extends())];
      at = std::min(at, of.edge_before(std::abs(point.spool)));
    }
  }
  for (std::size_t side = 0; side < kSides; ++side) {
    if (nearest[side] < 1.0) {
      blocks_.side[side][kEdge] = std::clamp(nearest[side] - 0.02, 0.03, 0.8);
    }
  }
}

/// Where the load takes nearly all that the line has, a small error of the line's pressure is a
/// large one of the speed: such points say less.
void ValveProblem::weigh() {
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const PreparedPoint& of = points_[n];
    const SteadyPoint& point = of.point();
    const auto axis = static_cast<std::size_t>(point.axis);
    const ValveTry tried =
        try_of(blocks_.side[side_of(point.axis, of.extends())].data(), blocks_.zero[axis].data(),
               blocks_.pump[static_cast<std::size_t>(of.pump())].data(),
               falls_ ? blocks_.regulator.data() : nullptr);
    const double speed_mps = std::abs(point.speed_mps);
    const double by_line_mps = of.speed_error(tried).per_force_mpspn * kLine_pa * of.fed_area_m2();
    spread_[n].speed_mps =
        std::hypot(point.speed_spread_mps + kSpeedShare * speed_mps, by_line_mps);
    spread_[n].out_mps = 2.0 * point.speed_spread_mps + kOutShare * speed_mps;
  }
}

void ValveProblem::add_priors(const MachineEstimate& machine) {
  for (std::size_t axis = 0; axis < drives_; ++axis) {
    const DriveEstimate& drive = machine.drive[axis];
    for (const bool extends : {true, false}) {
      const SideEstimate& from = drive.side(extends);
      auto& block = blocks_.side[side_of(static_cast<int>(axis), extends)];
      prior(block, kEdge, from.edge.value, priors_.edge);
      prior(block, kLogSoftness, std::log(std::max(from.softness.value, kUsualSoftness)),
            priors_.log_softness);
      prior(block, kExponent, from.exponent.value, priors_.exponent);
      prior(block, kLogCoefficient, std::log(from.coefficient_factor.value),
            priors_.log_coefficient);
      prior(block, kLogOutArea, std::log(from.out_area_factor.value), priors_.log_out_area);
    }
    const auto zero = [&](std::size_t at, const Estimate& from) {
      prior(blocks_.zero[axis], at, from.value / kPaPerMpa,
            (from.deviation > 0.0 ? from.deviation : priors_.zero_pa) / kPaPerMpa);
    };
    zero(0, drive.cap_zero_pa);
    zero(1, drive.rod_zero_pa);
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    prior(blocks_.pump[j], 0, machine.pump_flow_factor[j].value, priors_.pump_flow);
  }
  if (falls_) {
    prior(blocks_.regulator, 0, 0.0, priors_.log_closes_at);
    prior(blocks_.regulator, 1, 0.0, priors_.log_felt);
  }
}

/// What the points leave open as they are weighed, H^-1, and what shows that they hang together or
/// that the model is not the machine: H^-1 (sum of g g^T over blocks of time) H^-1. Added up, the
/// second is never taken for less than the first.
void ValveProblem::find_covariance() {
  const auto places = places_of(blocks_, drives_);
  Square curvature = Square::Zero();
  std::map<std::size_t, Row> gradient;
  std::vector<ceres::ResidualBlockId> ids;
  problem_.GetResidualBlocks(&ids);
  for (std::size_t n = 0; n < ids.size(); ++n) {
    std::vector<double*> blocks;
    problem_.GetParameterBlocksForResidualBlock(ids[n], &blocks);
    const int rows = problem_.GetCostFunctionForResidualBlock(ids[n])->num_residuals();
    std::array<std::array<double, 2 * kSideSize>, 4> jacobian{};  // The largest that there are.
    std::array<double*, 4> to = {jacobian[0].data(), jacobian[1].data(), jacobian[2].data(),
                                 jacobian[3].data()};
    std::array<double, 2> residual{};
    double cost = 0.0;
    problem_.EvaluateResidualBlock(ids[n], true, &cost, residual.data(), to.data());
    for (int r = 0; r < rows; ++r) {
      Row row = Row::Zero();
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        const int size = problem_.ParameterBlockSize(blocks[b]);
        for (int k = 0; k < size; ++k) {
          row[static_cast<Eigen::Index>(places.at(blocks[b])) + k] =
              jacobian[b][static_cast<std::size_t>(r * size + k)];
        }
      }
      curvature += row * row.transpose();
      if (n < points_.size()) {
        auto [at, is_new] = gradient.try_emplace(points_[n].point().block, Row::Zero());
        at->second += residual[static_cast<std::size_t>(r)] * row;
      }
    }
  }
  Square gradients = Square::Zero();
  for (const auto& [block, each] : gradient) {
    gradients += each * each.transpose();
  }
  // A drive that the machine has not.
  for (Eigen::Index at = 0; at < curvature.rows(); ++at) {
    curvature(at, at) = curvature(at, at) == 0.0 ? 1.0 : curvature(at, at);
  }
  const Square inverse = curvature.ldlt().solve(Square::Identity());
  covariance_ = inverse + inverse * gradients * inverse;
}

void fit_valves(const DriveModel& model, const std::vector<SteadyPoint>& points,
                const ValvePriors& priors, MachineEstimate& machine) {
  std::vector<PreparedPoint> prepared;
  prepared.reserve(points.size());
  for (const SteadyPoint& point : points) {
    prepared.emplace_back(model, point, machine.drive);
  }
  ValveProblem problem(prepared, priors, machine, model);
  problem.solve();
  problem.tell(model, machine);
}

}  // namespace graben::identify