#include "app/identify/motion_model.hpp"

#include <cmath>
#include <numeric>

namespace graben::identify {
namespace {

// The others' velocities come from the pass before.
constexpr int kPasses = 2;
constexpr double kAhead_s = 1.0;

double full(const JointModel& joint, std::size_t first_rise) {
  const auto* from = joint.value.begin() + static_cast<std::ptrdiff_t>(first_rise);
  return std::accumulate(from, from + kRises, 1e-9);
}

std::vector<double> integral(const std::vector<double>& time_s,
                             const std::vector<double>& command) {
  std::vector<double> sum(time_s.size(), 0.0);
  for (std::size_t row = 1; row < time_s.size(); ++row) {
    sum[row] = sum[row - 1] + command[row - 1] * (time_s[row] - time_s[row - 1]);
  }
  return sum;
}

/// Sums for one joint, run after run.
class Judge {
 public:
  void add(const MotionRun& run, std::size_t joint, const std::vector<double>& predicted) {
    const std::vector<double>& measured = run.velocity_radps[joint];
    std::vector<double> turned(run.size(), 0.0);
    for (std::size_t row = 0; row < run.size(); ++row) {
      const double error = measured[row] - predicted[row];
      unexplained_ += error * error;
      sum_ += measured[row];
      squares_ += measured[row] * measured[row];
      if (row > 0) {
        turned[row] = turned[row - 1] + 0.5 * (predicted[row] + predicted[row - 1]) *
                                            (run.time_s[row] - run.time_s[row - 1]);
      }
    }
    rows_ += static_cast<double>(run.size());
    std::size_t until = 0;
    for (std::size_t from = 0; from < run.size(); ++from) {
      while (until < run.size() && run.time_s[until] < run.time_s[from] + kAhead_s) {
        ++until;
      }
      if (until == run.size()) {
        break;
      }
      const double went = run.angle_rad[joint][until] - run.angle_rad[joint][from];
      const double error = went - (turned[until] - turned[from]);
      ahead_ += error * error;
      aheads_ += 1.0;
    }
  }

  [[nodiscard]] Score score() const {
    Score score;
    const double spread = squares_ - sum_ * sum_ / rows_;
    score.velocity_rms_radps = std::sqrt(unexplained_ / rows_);
    score.moved = squares_ / rows_ > kStands_radps * kStands_radps;
    score.velocity_r2 = score.moved ? 1.0 - unexplained_ / spread : 0.0;
    score.angle_1s_rms_rad = aheads_ > 0.0 ? std::sqrt(ahead_ / aheads_) : 0.0;
    return score;
  }

 private:
  double unexplained_ = 0.0;
  double sum_ = 0.0;
  double squares_ = 0.0;
  double rows_ = 0.0;
  double ahead_ = 0.0;
  double aheads_ = 0.0;
};

}  // namespace

JointRun joint_run(const MotionModel& model, std::size_t joint, const MotionRun& run,
                   const Velocities* rates) {
  JointRun of;
  of.run = &run;
  of.commanded_s = integral(run.time_s, run.command[joint]);
  for (std::size_t at = 0; at < kOthers; ++at) {
    const std::size_t other = other_joint(joint, at);
    const JointModel& theirs = model[other];
    JointRun alone;
    alone.run = &run;
    alone.commanded_s = integral(run.time_s, run.command[other]);
    of.other_opening[at] = openings<double>(alone, other, theirs.value.data(), theirs.knots);
    for (double& open : of.other_opening[at]) {
      open /= full(theirs, open > 0.0 ? kForward : kBackward);
    }
    of.other_velocity_radps[at] =
        rates == nullptr ? std::vector<double>(run.size(), 0.0) : (*rates)[other];
  }
  return of;
}

Velocities predict(const MotionModel& model, const MotionRun& run) {
  Velocities before;
  for (int pass = 0; pass < kPasses; ++pass) {
    Velocities now;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const JointRun of = joint_run(model, joint, run, pass == 0 ? nullptr : &before);
      now[joint] = velocities<double>(of, joint, model[joint].value.data(), model[joint].knots);
      for (double& velocity : now[joint]) {
        velocity *= model[joint].sign;
      }
    }
    before = std::move(now);
  }
  return before;
}

std::array<Score, kJoints> judge(const MotionModel& model, const std::vector<MotionRun>& runs) {
  std::array<Judge, kJoints> judges;
  for (const MotionRun& run : runs) {
    const Velocities predicted = predict(model, run);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      judges[joint].add(run, joint, predicted[joint]);
    }
  }
  std::array<Score, kJoints> scores;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    scores[joint] = judges[joint].score();
  }
  return scores;
}

}  // namespace graben::identify
