// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/runs/calm.hpp"
#include "app/runs/grade_run.hpp"

namespace graben::runs {
namespace {

/// Slower than this it does not get on.
constexpr double kHalt_mps = 0.03;

/// Share by which the required flow may exceed the available one and still count as kept.
constexpr double kFlowTolerance = 0.02;

/// Count of turns of a value that runs up and down, smaller ways than `resolution` left out.
class Turns {
 public:
  explicit Turns(double resolution) : resolution_(resolution) {}

  void add(double value) {
    highest_ = std::max(highest_, value);
    lowest_ = std::min(lowest_, value);
    if (way_ != -1 && highest_ - value > resolution_) {
      turn(-1, value);
    } else if (way_ != 1 && value - lowest_ > resolution_) {
      turn(1, value);
    }
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  void turn(int way, double value) {
    count_ += way_ != 0 ? 1 : 0;
    way_ = way;
    highest_ = value;
    lowest_ = value;
  }

  double resolution_;
  double highest_ = -std::numeric_limits<double>::infinity();
  double lowest_ = std::numeric_limits<double>::infinity();
  int way_ = 0;
  int count_ = 0;
};

/// Flow that the true motion needs, over what there is.
class FlowCount {
 public:
  void add(const GradeSample& sample) {
    const double share = sample.flow_required_m3ps / sample.flow_available_m3ps;
    most_ = std::max(most_, share);
    ++all_;
    if (share <= 1.0 + kFlowTolerance) {
      return;
    }
    ++above_;
    occasions_ += last_m_ && sample.edge_m.x() - *last_m_ < kOccasion_m ? 0 : 1;
    last_m_ = sample.edge_m.x();
  }
  [[nodiscard]] double most() const { return most_; }
  [[nodiscard]] int occasions() const { return occasions_; }
  [[nodiscard]] double above_share() const {
    return all_ > 0 ? static_cast<double>(above_) / static_cast<double>(all_) : 0.0;
  }

 private:
  double most_ = 0.0;
  long all_ = 0;
  long above_ = 0;
  int occasions_ = 0;
  std::optional<double> last_m_;
};

/// Largest fall of a speed over so many cycles, per second.
double deceleration_mps2(const std::vector<GradeSample>& over, double GradeSample::*speed_mps,
                         std::size_t cycles) {
  double most = 0.0;
  for (std::size_t n = cycles; n < over.size(); ++n) {
    const GradeSample& before = over[n - cycles];
    const double fall_mps = before.*speed_mps - over[n].*speed_mps;
    most = std::max(most, fall_mps / (over[n].time_s - before.time_s));
  }
  return most;
}

std::vector<GradeSample> samples_over_grade(const GradeResult& result) {
  std::vector<GradeSample> over;
  std::copy_if(result.samples.begin(), result.samples.end(), std::back_inserter(over),
               [](const GradeSample& sample) { return sample.over_grade; });
  return over;
}

/// Of the time over the grade.
void add_calm(const machines::SimulatedDozer& machine, const GradeResult& result,
              GradeSummary& summary) {
  Variation lambda;
  SpoolCalm spool({machine.plant.deadband_ratio, machine.plant.deadband_ratio});
  Jerk jerk;
  for (const GradeSample& sample : result.samples) {
    if (sample.over_grade) {
      lambda.add(sample.lambda);
      spool.add(sample.spool_real);
      jerk.add({sample.edge_m.x(), 0.0, sample.edge_m.y()});
    } else {
      lambda.pause();
      spool.pause();
      jerk.pause();
    }
  }
  summary.lambda_variation_ps = lambda.per_s();
  summary.spool_travel_ps = spool.travel_ps();
  summary.spool_reversals_ps = spool.reversals_ps();
  summary.edge_jerk_rms_mps3 = jerk.rms_mps3();
}

/// What is left of the ground, and what it has cost.
void add_ground(const machines::SimulatedDozer& machine, const GradeResult& result,
                GradeSummary& summary) {
  const GradeTruth truth(machine.profile);
  const auto add = [&](double x_m, double above_m) {
    if (x_m >= 0.0 && x_m <= machine.experiment.length_m) {
      summary.ground_left_m = std::max(summary.ground_left_m, above_m);
      summary.over_cut_m = std::max(summary.over_cut_m, -above_m);
    }
  };
  for (const Eigen::Vector2d& at_m : result.terrain_m) {
    add(at_m.x(), truth.error_m(at_m));
  }
  for (const Eigen::Vector3d& at_m : result.ends_m) {
    add(at_m.x(), truth.point_error_m(at_m));
  }
  double since_s = 0.0;
  double last_s = 0.0;
  for (const GradeSample& sample : result.samples) {
    summary.passes = std::max(summary.passes, sample.pass);
    const bool halts = sample.over_grade && std::abs(sample.speed_true_mps) < kHalt_mps;
    since_s = halts ? since_s + sample.time_s - last_s : 0.0;
    last_s = sample.time_s;
    summary.halt_s = std::max(summary.halt_s, since_s);
  }
}

}  // namespace

GradeSummary summarise(const machines::SimulatedDozer& machine, const GradeResult& result) {
  GradeSummary summary;
  const std::vector<GradeSample> over = samples_over_grade(result);
  Spread error_true;
  Spread error_measured;
  FlowCount flow;
  Turns turns(kSpeedResolution_mps);
  for (const GradeSample& sample : over) {
    error_true.add(std::abs(sample.error_true_m));
    error_measured.add(std::abs(sample.error_measured_m));
    flow.add(sample);
    turns.add(sample.speed_wanted_mps);
    summary.off_track_m = std::max(summary.off_track_m, std::abs(sample.off_track_m));
    if (sample.flow_limit_reported_m3ps > 0.0) {
      summary.flow_share_reported_max =
          std::max(summary.flow_share_reported_max,
                   sample.flow_reported_m3ps / sample.flow_limit_reported_m3ps);
    }
  }
  summary.max_error_true_m = error_true.max();
  summary.rmse_error_true_m = error_true.rms();
  summary.max_error_measured_m = error_measured.max();
  summary.rmse_error_measured_m = error_measured.rms();
  if (!over.empty()) {
    summary.time_s = over.back().time_s - over.front().time_s;
    const double way_m = over.back().edge_m.x() - over.front().edge_m.x();
    summary.mean_speed_mps = summary.time_s > 0.0 ? way_m / summary.time_s : 0.0;
  }
  summary.flow_share_max = flow.most();
  summary.flow_above_share = flow.above_share();
  summary.flow_occasions = flow.occasions();
  summary.deceleration_wanted_mps2 = deceleration_mps2(over, &GradeSample::speed_wanted_mps, 1);
  // In cycles of 10 ms.
  summary.deceleration_true_mps2 =
      deceleration_mps2(over, &GradeSample::speed_true_mps,
                        static_cast<std::size_t>(std::lround(kDeceleration_s * 100.0)));
  summary.sign_changes = turns.count();
  summary.corners = std::max(machine.profile.grade.count - 2, 0);
  add_calm(machine, result, summary);
  add_ground(machine, result, summary);
  summary.pace = pace_of(result.samples, result.wall_s);
  return summary;
}

const FigureTable<GradeSummary>& grade_figures() {
  using S = GradeSummary;
  static const FigureTable<S> all = with_pace<S>({
      {{"max_error_true_m", "true edge over the grade, max", kMillimetres, "max_error_true_m"},
       [](const S& s) { return s.max_error_true_m; }},
      {{"rmse_error_true_m", "true edge over the grade, RMSE", kMillimetres, "rmse_error_true_m"},
       [](const S& s) { return s.rmse_error_true_m; }},
      {{"max_error_measured_m", "measured edge over the grade, max", kMillimetres,
        "max_error_measured_m"},
       [](const S& s) { return s.max_error_measured_m; }},
      {{"rmse_error_measured_m", "measured edge over the grade, RMSE", kMillimetres},
       [](const S& s) { return s.rmse_error_measured_m; }},
      {{"time_s", "time for the grade", kSeconds, "time_s"}, [](const S& s) { return s.time_s; }},
      {{"mean_speed_mps", "mean speed over the grade", kMetresPerSecond},
       [](const S& s) { return s.mean_speed_mps; }},
      {{"flow_share_max", "required flow over the available, max", kPercent, "flow_share_max"},
       [](const S& s) { return s.flow_share_max; }},
      {{"flow_share_reported_max", "the same by the controller's figures", kPercent},
       [](const S& s) { return s.flow_share_reported_max; }},
      {{"flow_above_share", "time with more than 102 % of it", kPercent, "flow_above"},
       [](const S& s) { return s.flow_above_share; }},
      {{"flow_occasions", "occasions of that", kCount, "flow_occasions"},
       [](const S& s) { return static_cast<double>(s.flow_occasions); }},
      {{"deceleration_wanted_mps2", "deceleration of the wanted speed, max", kMetresPerSecond2,
        "deceleration_wanted_mps2"},
       [](const S& s) { return s.deceleration_wanted_mps2; }},
      {{"deceleration_true_mps2", "deceleration of the machine, max over 0.1 s", kMetresPerSecond2,
        "deceleration_true_mps2"},
       [](const S& s) { return s.deceleration_true_mps2; }},
      {{"sign_changes", "turns of the wanted speed", kCount, "sign_changes"},
       [](const S& s) { return static_cast<double>(s.sign_changes); }},
      {{"corners", "corners of the design", kCount},
       [](const S& s) { return static_cast<double>(s.corners); }},
      {kLambdaVariation, [](const S& s) { return s.lambda_variation_ps; }},
      {{"spool_travel_ps", "blade's spool, full travels a second", kPerSecond, "spool_travel_ps"},
       [](const S& s) { return s.spool_travel_ps; }},
      {{"spool_reversals_ps", "blade's spool, changes of side a second", kPerSecond,
        "spool_reversals_ps"},
       [](const S& s) { return s.spool_reversals_ps; }},
      {{"edge_jerk_rms_mps3", "jerk of the true edge below 10 Hz, RMS", kMetresPerSecond3,
        "edge_jerk_rms_mps3"},
       [](const S& s) { return s.edge_jerk_rms_mps3; }},
      {{"off_track_m", "edge beside a track that curves, in plan, max", kMillimetres},
       [](const S& s) { return s.off_track_m; }},
      {{"passes", "passes", kCount, "passes"},
       [](const S& s) { return static_cast<double>(s.passes); }},
      {{"ground_left_m", "ground left above the design, max", kMillimetres, "ground_left_m"},
       [](const S& s) { return s.ground_left_m; }},
      {{"over_cut_m", "ground cut below the design, max", kMillimetres, "over_cut_m"},
       [](const S& s) { return s.over_cut_m; }},
      {{"halt_s", "longest halt in a pass", kSeconds, "halt_s"},
       [](const S& s) { return s.halt_s; }},
  });
  return all;
}

RunFigures headed_figures(const GradeSummary& summary) {
  RunFigures figures = figures_of(summary);
  if (summary.passes > 1) {
    lead_with({"ground_left_m", "over_cut_m", "passes"}, figures);
  }
  return figures;
}

std::string out_of_tolerance(const GradeSummary& summary, double tolerance_m) {
  if (std::max(summary.ground_left_m, summary.over_cut_m) <= tolerance_m) {
    return "";
  }
  return fmt::format(
      "the grade is out of tolerance: up to {:.0f} mm left above the design and {:.0f} mm cut "
      "below "
      "it; grade.tolerance is {:.0f} mm",
      1e3 * summary.ground_left_m, 1e3 * summary.over_cut_m, 1e3 * tolerance_m);
}

}  // namespace graben::runs
