// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_model.hpp"

#include <cmath>
#include <numeric>

#include "app/identify/joint_cost.hpp"
#include "app/identify/joint_motion.hpp"

namespace graben::identify {
namespace {

constexpr double kAhead_s = 1.0;
constexpr double kStood_radps = 0.03;  // In one row: more than noise, less than a motion.

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

/// Fills in what is known of a joint's command.
void know_command(JointRun& of, const MotionRun& run, std::size_t joint) {
  of.run = &run;
  of.commanded_s = integral(run.time_s, run.command[joint]);
  // What the first row commands a joint that stands has only just come: had it held before, the
  // joint would move. Taken for an old command, it passes for a machine that answers sooner.
  const bool stood = std::abs(run.velocity_radps[joint][0]) < kStood_radps;
  of.command_before = stood ? 0.0 : run.command[joint][0];
}

using States = std::array<JointState<double>, kJoints>;

/// All joints together over one run.
class Machine {
 public:
  Machine(const MotionModel& model, const MotionRun& run) : model_(model), run_(run) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      inputs_[joint] = joint_run(model, joint, run, nullptr);
      open_[joint] =
          openings<double>(inputs_[joint], joint, model[joint].value.data(), model[joint].grid);
    }
  }

  /// From the row before to `row`, where the joints are at `angles`.
  void step(States& states, std::size_t row, const Angles& angles) const {
    const double row_s = run_.time_s[row] - run_.time_s[row - 1];
    const Pose pose = pose_of(angles);
    const States before = states;
    Angles wanted{};
    Angles faster{};  // Of each joint, as if none shook another.
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const JointModel& of = model_[joint];
      wanted[joint] = flow_velocity(inputs_[joint], row, of.value.data(), of.grid, pose,
                                    angles[joint], open_[joint][row]);
      move(states[joint], of.value.data(), row_s, wanted[joint], 0.0,
           inertia_of(of.value.data(), of.grid, pose));
      faster[joint] = of.sign * (states[joint].seen_radps - before[joint].seen_radps);
    }
    states = before;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const double* p = model_[joint].value.data();
      double shoved = 0.0;
      for (std::size_t at = 0; at < kOthers; ++at) {
        shoved += p[kRockForce + at] * faster[other_joint(joint, at)];
      }
      move(states[joint], p, row_s, wanted[joint], shoved, inertia_of(p, model_[joint].grid, pose));
    }
  }

  /// One for each row, in the measured pose.
  [[nodiscard]] std::vector<States> run() const {
    std::vector<States> all(run_.size());
    for (std::size_t row = 1; row < run_.size(); ++row) {
      all[row] = all[row - 1];
      step(all[row], row, angles_at(run_, row));
    }
    return all;
  }

  /// How far each joint turns from a row to a later one; `states` are those of the first.
  [[nodiscard]] Angles turns(States states, const Ahead& rows) const {
    const States first = states;
    const Angles measured = angles_at(run_, rows.from);
    Angles turned{};
    for (std::size_t row = rows.from + 1; row <= rows.to; ++row) {
      const double row_s = run_.time_s[row] - run_.time_s[row - 1];
      Angles angles{};
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        angles[joint] = measured[joint] + turned[joint] +
                        row_s * model_[joint].sign * states[joint].velocity_radps;
      }
      step(states, row, angles);
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        turned[joint] = model_[joint].sign * (states[joint].turned_rad - first[joint].turned_rad);
      }
    }
    return turned;
  }

 private:
  const MotionModel& model_;
  const MotionRun& run_;
  std::array<JointRun, kJoints> inputs_;
  std::array<std::vector<double>, kJoints> open_;
};

/// Sums for one joint, run after run.
class Judge {
 public:
  void add(const MotionRun& run, std::size_t joint, const std::vector<double>& velocity_radps,
           const std::vector<double>& turns_rad) {
    const std::vector<double>& measured = run.velocity_radps[joint];
    for (std::size_t row = 0; row < run.size(); ++row) {
      const double error = measured[row] - velocity_radps[row];
      unexplained_ += error * error;
      sum_ += measured[row];
      squares_ += measured[row] * measured[row];
    }
    rows_ += static_cast<double>(run.size());
    const std::vector<Ahead> aheads = rows_ahead(run, kAhead_s, 1);
    for (std::size_t at = 0; at < aheads.size(); ++at) {
      const std::vector<double>& angle = run.angle_rad[joint];
      const double error = angle[aheads[at].to] - angle[aheads[at].from] - turns_rad[at];
      ahead_ += error * error;
    }
    aheads_ += static_cast<double>(aheads.size());
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
  know_command(of, run, joint);
  of.pose.reserve(run.size());
  for (std::size_t row = 0; row < run.size(); ++row) {
    of.pose.push_back(pose_of(angles_at(run, row)));
  }
  for (std::size_t at = 0; at < kOthers; ++at) {
    const std::size_t other = other_joint(joint, at);
    const JointModel& theirs = model[other];
    JointRun alone;
    know_command(alone, run, other);
    of.other_opening[at] = openings<double>(alone, other, theirs.value.data(), theirs.grid);
    for (double& open : of.other_opening[at]) {
      open /= full(theirs, open > 0.0 ? kForward : kBackward);
    }
    of.other_velocity_radps[at] =
        rates == nullptr ? std::vector<double>(run.size(), 0.0) : (*rates)[other];
  }
  return of;
}

Velocities predict(const MotionModel& model, const MotionRun& run) {
  Velocities velocities;
  for (const States& states : Machine(model, run).run()) {
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      velocities[joint].push_back(model[joint].sign * states[joint].seen_radps);
    }
  }
  return velocities;
}

Velocities predict_measured(const MotionModel& model, const MotionRun& run) {
  const std::vector<States> states = Machine(model, run).run();
  Velocities velocities;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    std::vector<JointState<double>> of;
    for (const States& all : states) {
      of.push_back(all[joint]);
    }
    for (std::size_t row = 0; row < run.size(); ++row) {
      velocities[joint].push_back(model[joint].sign * as_measured(run, joint, row, of));
    }
  }
  return velocities;
}

Velocities turns_ahead(const MotionModel& model, const MotionRun& run) {
  const Machine machine(model, run);
  const std::vector<States> states = machine.run();
  Velocities turns;
  for (const Ahead& rows : rows_ahead(run, kAhead_s, 1)) {
    const Angles turned = machine.turns(states[rows.from], rows);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      turns[joint].push_back(turned[joint]);
    }
  }
  return turns;
}

std::array<Score, kJoints> judge(const MotionModel& model, const std::vector<MotionRun>& runs) {
  std::array<Judge, kJoints> judges;
  for (const MotionRun& run : runs) {
    const Velocities velocities = predict_measured(model, run);
    const Velocities turns = turns_ahead(model, run);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      judges[joint].add(run, joint, velocities[joint], turns[joint]);
    }
  }
  std::array<Score, kJoints> scores;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    scores[joint] = judges[joint].score();
  }
  return scores;
}

}  // namespace graben::identify
