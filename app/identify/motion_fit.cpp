#include "app/identify/motion_fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/identify/joint_cost.hpp"

namespace graben::identify {
namespace {

constexpr std::array<double, 4> kDeadTimeStarts_s = {0.04, 0.10, 0.15, 0.21};
constexpr int kSearchSteps = 20;
constexpr std::size_t kSearched = 3;  // Every third run is enough to choose a start.
constexpr int kSteps = 15;
constexpr double kUsualDelay_s = 0.2;  // For the joint's sign alone.

struct Range {
  double least;
  double start;
  double most;
};

Range range(std::size_t parameter, double usual_radps) {
  if (parameter == kDeadTime) {
    return {0.0, 0.12, 0.5};
  }
  if (parameter < kForward) {
    return {0.005, 0.04, 0.6};
  }
  if (parameter < kModeRate) {
    return {0.0, 0.5 * usual_radps, 50.0 * usual_radps};
  }
  if (parameter == kModeRate) {
    return {1.0, 12.0, 40.0};
  }
  if (parameter < kLoadForward) {
    return {0.1, 8.0, 100.0};
  }
  if (parameter < kShare) {
    return {-5.0, 0.0, 5.0};
  }
  if (parameter < kRockRate) {
    return {0.0, 0.3, 8.0};
  }
  if (parameter == kRockRate) {
    return {3.0, 12.0, 80.0};
  }
  return parameter == kRockDamping ? Range{0.02, 0.15, 1.0} : Range{-20.0, 0.02, 20.0};
}

double rms(const std::vector<MotionRun>& runs, std::size_t joint) {
  double squares = 0.0;
  double rows = 0.0;
  for (const MotionRun& run : runs) {
    for (const double velocity : run.velocity_radps[joint]) {
      squares += velocity * velocity;
    }
    rows += static_cast<double>(run.size());
  }
  return std::sqrt(squares / rows);
}

/// +1 where a positive command makes the velocity positive.
double sign_of(const std::vector<MotionRun>& runs, std::size_t joint) {
  double agrees = 0.0;
  for (const MotionRun& run : runs) {
    std::size_t late = 0;
    for (std::size_t row = 0; row < run.size(); ++row) {
      while (run.time_s[late] < run.time_s[row] - kUsualDelay_s) {
        ++late;
      }
      // Beyond half of the command: nobody knows the edges yet.
      const double command = run.command[joint][late];
      agrees += (std::abs(command) > 0.5 ? command : 0.0) * run.velocity_radps[joint][row];
    }
  }
  return agrees < 0.0 ? -1.0 : 1.0;
}

/// Where a curve may bend before anything is known: even from the least opening that is likely.
constexpr double kLeastEdge = 0.05;

constexpr double kBeforeEdge = 0.03;  // Of the command, for an edge that was found too late.
constexpr double kOpen = 0.03;        // Of full speed.

Bends even_bends() {
  Bends bends{};
  for (std::size_t at = 0; at < kKnots; ++at) {
    bends[at] = kLeastEdge + (1.0 - kLeastEdge) * static_cast<double>(at) / (kKnots - 1);
  }
  return bends;
}

/// Commands of one direction (`sign`) as positive numbers, in order.
std::vector<double> sorted_commands(const std::vector<MotionRun>& runs, std::size_t joint,
                                    double sign) {
  std::vector<double> commands;
  for (const MotionRun& run : runs) {
    for (const double command : run.command[joint]) {
      if (sign * command > 0.0) {
        commands.push_back(sign * command);
      }
    }
  }
  std::sort(commands.begin(), commands.end());
  return commands;
}

/// Where the curve from `rises` starts to open.
double edge_of(const double* rises, const Bends& bends) {
  constexpr double kFine = 0.005;
  const double most = curve_at(rises, bends, 1.0);
  double edge = bends[0];
  while (curve_at(rises, bends, edge) < kOpen * most) {
    edge += kFine;
  }
  return std::max(kLeastEdge, edge - kBeforeEdge);
}

/// Moves the bends of one curve to where it opens and where `commands` are, half and half: a curve
/// must not be coarse where few commands are. Leaves the curve where it was.
void spread(double* rises, Bends& bends, const std::vector<double>& commands) {
  if (curve_at(rises, bends, 1.0) <= 0.0) {
    return;
  }
  constexpr double kLeastApart = 0.02;
  const double edge = edge_of(rises, bends);
  const auto first = std::lower_bound(commands.begin(), commands.end(), edge);
  const auto count = static_cast<double>(commands.end() - first);
  Bends to{};
  to[0] = edge;
  for (std::size_t at = 1; at < kKnots; ++at) {
    const double share = static_cast<double>(at) / (kKnots - 1);
    const double even = edge + (1.0 - edge) * share;
    const double driven =
        count > 0.0 ? first[static_cast<std::ptrdiff_t>(share * (count - 1.0))] : even;
    to[at] = std::clamp(0.5 * (even + driven), to[at - 1] + kLeastApart,
                        1.0 - kLeastApart * static_cast<double>(kKnots - 1 - at));
  }
  to.back() = 1.0;
  std::array<double, kRises> rise{};
  for (std::size_t at = 0; at < kRises; ++at) {
    rise[at] = curve_at(rises, bends, to[at + 1]) - curve_at(rises, bends, to[at]);
  }
  bends = to;
  std::copy(rise.begin(), rise.end(), rises);
}

/// A joint's problem in Ceres.
class JointFit {
 public:
  JointFit(const std::vector<JointRun>& inputs, std::size_t joint, JointModel& model,
           double scale_radps)
      : model_(model) {
    for (const JointRun& of : inputs) {
      problem_.AddResidualBlock(new JointCost(of, joint, model.knots, model.sign, scale_radps),
                                nullptr, model.value.data());
    }
    for (std::size_t at = 0; at < kParameters; ++at) {
      const Range allowed = range(at, scale_radps);
      problem_.SetParameterLowerBound(model.value.data(), static_cast<int>(at), allowed.least);
      problem_.SetParameterUpperBound(model.value.data(), static_cast<int>(at), allowed.most);
    }
  }

  /// Cost after up to `steps` steps.
  double solve(int steps, int threads) {
    ceres::Solver::Options options;
    options.max_num_iterations = steps;
    options.num_threads = threads;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.logging_type = ceres::SILENT;
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
    for (const JointRun& of : inputs) {
      const JointCost cost(of, joint, model_.knots, model_.sign, scale_radps);
      const auto rows = static_cast<Eigen::Index>(of.run->size());
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
      curvature(at, at) += none;
    }
    const Square inverse = curvature.ldlt().solve(Square::Identity());
    const Square covariance = inverse * gradients * inverse;
    for (Eigen::Index at = 0; at < kSize; ++at) {
      model_.deviation[static_cast<std::size_t>(at)] +=
          std::sqrt(std::max(0.0, covariance(at, at)));
    }
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

/// The first pass: the best of several dead times to start from.
void search(const std::vector<JointRun>& all, std::size_t joint, JointModel& model,
            double scale_radps, int threads) {
  const JointModel start = model;
  std::vector<JointRun> inputs;
  for (std::size_t at = 0; at < all.size(); at += kSearched) {
    inputs.push_back(all[at]);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const double dead_time_s : kDeadTimeStarts_s) {
    JointModel tried = start;
    tried.value[kDeadTime] = dead_time_s;
    const double cost = JointFit(inputs, joint, tried, scale_radps).solve(kSearchSteps, threads);
    if (cost < least) {
      least = cost;
      model = tried;
    }
  }
}

}  // namespace

MotionModel fit_motion(const std::vector<MotionRun>& runs, const FitOptions& options) {
  MotionModel model;
  std::array<double, kJoints> scale_radps{};
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    scale_radps[joint] = rms(runs, joint);
    model[joint].sign = sign_of(runs, joint);
    model[joint].knots = {even_bends(), even_bends()};
    for (std::size_t at = 0; at < kParameters; ++at) {
      model[joint].value[at] = range(at, scale_radps[joint]).start;
    }
  }
  const auto stands = [&](std::size_t joint) { return scale_radps[joint] < kStands_radps; };
  if (stands(0) && stands(1) && stands(2) && stands(3)) {
    throw std::runtime_error(
        fmt::format("no joint moves: {} is the fastest rms velocity, rad/s",
                    *std::max_element(scale_radps.begin(), scale_radps.end())));
  }
  const double work = options.passes * static_cast<double>(kJoints);
  for (int pass = 0; pass < options.passes; ++pass) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      options.progress((pass * static_cast<double>(kJoints) + static_cast<double>(joint)) / work,
                       fmt::format("pass {}, {}", pass + 1, kJointNames[joint]));
      JointModel& of = model[joint];
      if (stands(joint)) {
        std::fill_n(of.value.begin() + kForward, 2 * kRises, 0.0);
        of.deviation.fill(std::numeric_limits<double>::infinity());
        continue;
      }
      const std::vector<JointRun> inputs = inputs_of(model, joint, runs, pass == 0);
      if (pass == 0) {
        search(inputs, joint, of, scale_radps[joint], options.threads);
        spread(of.value.data() + kForward, of.knots.forward, sorted_commands(runs, joint, 1.0));
        spread(of.value.data() + kBackward, of.knots.backward, sorted_commands(runs, joint, -1.0));
      }
      JointFit fit(inputs, joint, of, scale_radps[joint]);
      fit.solve(kSteps, options.threads);
      if (pass + 1 == options.passes) {
        fit.deviations(inputs, joint, scale_radps[joint]);
      }
    }
  }
  return model;
}

}  // namespace graben::identify
