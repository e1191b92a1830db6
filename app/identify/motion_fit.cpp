// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_fit.hpp"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/identify/joint_cost.hpp"
#include "app/identify/motion_start.hpp"

namespace graben::identify {
namespace {

constexpr std::array<double, 3> kDeadTimeStarts_s = {0.05, 0.12, 0.19};
constexpr double kAlike_s = 0.03;            // Starts closer than that end alike.
constexpr int kTrySteps = 12;                // Show which start is none,
constexpr int kSearchSteps = 12;             // and so many more which of the best two is better.
constexpr std::size_t kSearchedRows = 4000;  // Are enough to choose a start by,
constexpr std::size_t kSomeRows = 8000;      // and so many for all passes but the last.
constexpr int kSteps = 15;
constexpr double kOfRow = 0.12;    // Deviation of a dead time, of 20 simulated machines.
constexpr double kSettled = 1e-4;  // Of the cost, in one step.

/// Once a dead time is found: near it. Lags and the rocking stand in for dead time, and slowly so.
Range near(double dead_time_s) {
  constexpr double kNear_s = 0.03;
  const Range any = range(kDeadTime, 0.0);
  return {any.least, dead_time_s, any.most, kNear_s};
}

/// A joint's problem in Ceres.
class JointFit {
 public:
  JointFit(const std::vector<JointRun>& inputs, std::size_t joint, JointModel& model,
           double scale_radps, const Range& dead_time)
      : model_(model) {
    for (const JointRun& of : inputs) {
      problem_.AddResidualBlock(new JointCost(of, joint, model.grid, model.sign, scale_radps),
                                nullptr, model.value.data());
    }
    ceres::Matrix narrow = ceres::Matrix::Zero(kParameters, kParameters);
    ceres::Vector start = ceres::Vector::Zero(kParameters);
    for (std::size_t at = 0; at < kParameters; ++at) {
      const Range allowed = at == kDeadTime ? dead_time : range(at, scale_radps);
      start[static_cast<Eigen::Index>(at)] = allowed.start;
      narrow(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(at)) = 1.0 / allowed.wide;
      problem_.SetParameterLowerBound(model.value.data(), static_cast<int>(at), allowed.least);
      problem_.SetParameterUpperBound(model.value.data(), static_cast<int>(at), allowed.most);
    }
    problem_.AddResidualBlock(new ceres::NormalPrior(narrow, start), nullptr, model.value.data());
  }

  /// Cost after up to `steps` steps.
  double solve(int steps, int threads) {
    ceres::Solver::Options options;
    options.max_num_iterations = steps;
    options.num_threads = threads;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = kSettled;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.final_cost;
  }

  /// Standard deviations from the Jacobian. Errors within a run hang together, so whole runs are
  /// what is counted: H^-1 (sum of g g^T over runs) H^-1, with g a run's gradient.
  void deviations(const std::vector<JointRun>& inputs, std::size_t joint, double scale_radps) {
    constexpr auto kSize = static_cast<Eigen::Index>(kParameters);
    using Square = Eigen::Matrix<double, kSize, kSize>;
    Square curvature = Square::Zero();
    Square gradients = Square::Zero();
    Eigen::Matrix<double, kSize, 1> held;
    for (Eigen::Index at = 0; at < kSize; ++at) {
      const double wide = range(static_cast<std::size_t>(at), scale_radps).wide;
      held[at] = 1.0 / (wide * wide);
    }
    for (const JointRun& of : inputs) {
      const JointCost cost(of, joint, model_.grid, model_.sign, scale_radps);
      const auto rows = static_cast<Eigen::Index>(cost.num_residuals());
      Eigen::VectorXd residuals(rows);
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, kSize);
      const double* parameters = model_.value.data();
      double* to = jacobian.data();
      cost.Evaluate(&parameters, residuals.data(), &to);
      curvature += jacobian.transpose() * jacobian;
      const Eigen::Matrix<double, kSize, 1> gradient = jacobian.transpose() * residuals;
      gradients += gradient * gradient.transpose();
    }
    const double none = 1e-9 * curvature.trace() / static_cast<double>(kSize);
    for (Eigen::Index at = 0; at < kSize; ++at) {
      model_.deviation[static_cast<std::size_t>(at)] =
          curvature(at, at) > none ? 0.0 : std::numeric_limits<double>::infinity();
      curvature(at, at) += none + held[at];
    }
    const Square inverse = curvature.ldlt().solve(Square::Identity());
    const Square covariance = inverse * gradients * inverse;
    for (Eigen::Index at = 0; at < kSize; ++at) {
      model_.deviation[static_cast<std::size_t>(at)] +=
          std::sqrt(std::max(0.0, covariance(at, at)));
    }
    // A model that goes by rows can't know a dead time better than a part of one.
    const MotionRun& run = *inputs.front().run;
    const double row_s =
        (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.size() - 1);
    model_.deviation[kDeadTime] = std::hypot(model_.deviation[kDeadTime], kOfRow * row_s);
  }

 private:
  JointModel& model_;
  ceres::Problem problem_;
};

std::vector<JointRun> inputs_of(const MotionModel& model, std::size_t joint,
                                const std::vector<MotionRun>& runs, bool first) {
  std::vector<JointRun> inputs;
  inputs.reserve(runs.size());
  for (const MotionRun& run : runs) {
    if (first) {
      inputs.push_back(joint_run(model, joint, run, nullptr));
    } else {
      const Velocities rates = predict(model, run);
      inputs.push_back(joint_run(model, joint, run, &rates));
    }
  }
  return inputs;
}

std::size_t rows_of(const MotionRun& run) { return run.size(); }
std::size_t rows_of(const JointRun& of) { return of.run->size(); }

/// Of all, evenly, with about so many rows.
template <class T>
std::vector<T> some(const std::vector<T>& all, std::size_t rows) {
  std::size_t has = 0;
  for (const T& one : all) {
    has += rows_of(one);
  }
  const std::size_t every = std::max<std::size_t>(1, has / rows);
  std::vector<T> chosen;
  for (std::size_t at = 0; at < all.size(); at += every) {
    chosen.push_back(all[at]);
  }
  return chosen;
}

/// `model` with another dead time, and the lags that stand in for it as at first.
JointModel other_start(const JointModel& model, double dead_time_s, double scale_radps) {
  JointModel other = model;
  other.value[kDeadTime] = dead_time_s;
  for (const std::size_t lags : {kPilotLag, kFlowLag}) {
    std::fill_n(other.value.begin() + static_cast<std::ptrdiff_t>(lags), 4,
                range(lags, scale_radps).start);
  }
  return other;
}

/// The best of several dead times to start from: each row's length there is a best one of its own.
void search(const std::vector<JointRun>& all, std::size_t joint, JointModel& model,
            double scale_radps, int threads) {
  std::vector<JointModel> starts;
  for (const double dead_time_s : kDeadTimeStarts_s) {
    starts.push_back(other_start(model, dead_time_s, scale_radps));
  }
  const std::vector<JointRun> inputs = some(all, kSearchedRows);
  std::vector<std::pair<double, JointModel>> tried;
  const auto solve = [&](JointModel& start, int steps) {
    return JointFit(inputs, joint, start, scale_radps, range(kDeadTime, 0.0)).solve(steps, threads);
  };
  for (JointModel& start : starts) {
    const double cost = solve(start, kTrySteps);
    tried.emplace_back(cost, start);
  }
  std::sort(tried.begin(), tried.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  constexpr std::size_t kBest = 2;
  tried.resize(std::min(kBest, tried.size()));
  double least = std::numeric_limits<double>::infinity();
  for (auto& [before, start] : tried) {
    const double cost = solve(start, kSearchSteps);
    if (cost < least) {
      least = cost;
      model = start;
    }
  }
}

}  // namespace

MotionModel fit_motion(const std::vector<MotionRun>& runs, const FitOptions& options) {
  MotionModel model;
  std::array<double, kJoints> scale_radps{};
  std::array<double, kJoints> dead_time_s{};  // As searched.
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    scale_radps[joint] = usual_velocity(runs, joint);
    model[joint] = start_model(runs, joint);
  }
  const auto stands = [&](std::size_t joint) { return scale_radps[joint] < kStands_radps; };
  if (stands(0) && stands(1) && stands(2) && stands(3)) {
    throw std::runtime_error(
        fmt::format("no joint moves: {} is the fastest rms velocity, rad/s",
                    *std::max_element(scale_radps.begin(), scale_radps.end())));
  }
  const std::vector<MotionRun> fewer = some(runs, kSomeRows);
  const double work = options.passes * static_cast<double>(kJoints);
  for (int pass = 0; pass < options.passes; ++pass) {
    const bool last = pass + 1 == options.passes;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      options.progress((pass * static_cast<double>(kJoints) + static_cast<double>(joint)) / work,
                       fmt::format("pass {}, {}", pass + 1, kJointNames[joint]));
      JointModel& of = model[joint];
      if (stands(joint)) {
        std::fill_n(of.value.begin() + kForward, 2 * kRises, 0.0);
        of.deviation.fill(std::numeric_limits<double>::infinity());
        continue;
      }
      const std::vector<JointRun> inputs = inputs_of(model, joint, last ? runs : fewer, pass == 0);
      if (pass == 0) {
        search(inputs, joint, of, scale_radps[joint], options.threads);
        dead_time_s[joint] = of.value[kDeadTime];
        spread_bends(runs, joint, of);
      }
      JointFit fit(inputs, joint, of, scale_radps[joint],
                   pass == 0 ? range(kDeadTime, 0.0) : near(dead_time_s[joint]));
      fit.solve(kSteps, options.threads);
      if (last) {
        fit.deviations(inputs, joint, scale_radps[joint]);
      }
    }
  }
  return model;
}

}  // namespace graben::identify
