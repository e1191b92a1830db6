// SPDX-License-Identifier: Apache-2.0
#include "app/runs/assist_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "app/plant/random.hpp"
#include "app/runs/assist_way.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/fence_truth.hpp"

namespace graben::runs {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr double kOnto_m = 0.3;
constexpr double kTouch_s = 1.0;
constexpr double kEnable_s = 3.0;
constexpr double kMost_s = 90.0;
constexpr double kRest_s = 1.5;
constexpr double kStands_mps = 0.02;
constexpr double kWave_hz = 0.5;
/// The edge stands where it stays so near to where it comes to rest within so long.
constexpr double kHalted_m = 0.015;
constexpr double kRests_s = 0.5;

/// What is faster than a frequency, of two poles (Butterworth), bilinear.
class HighPass {
 public:
  explicit HighPass(double frequency_hz) {
    const double k = std::tan(kPi * frequency_hz * kPeriod_s);
    const double norm = 1.0 / (1.0 + std::sqrt(2.0) * k + k * k);
    b_ = norm;
    a1_ = 2.0 * (k * k - 1.0) * norm;
    a2_ = (1.0 - std::sqrt(2.0) * k + k * k) * norm;
  }
  double step(double in) {
    if (!begun_) {
      begun_ = true;
      in1_ = in2_ = in;
    }
    const double out = b_ * (in - 2.0 * in1_ + in2_) - a1_ * out1_ - a2_ * out2_;
    in2_ = in1_;
    in1_ = in;
    out2_ = out1_;
    out1_ = out;
    return out;
  }

 private:
  double b_ = 0.0, a1_ = 0.0, a2_ = 0.0;
  double in1_ = 0.0, in2_ = 0.0, out1_ = 0.0, out2_ = 0.0;
  bool begun_ = false;
};

/// A hand's noise: sines below 3 Hz.
class HandNoise {
 public:
  explicit HandNoise(std::uint64_t seed) : random_(seed, plant::Draw::kEye) {
    for (Sine& sine : sines_) {
      sine = {0.2 + 2.8 * random_.uniform(), kTwoPi * random_.uniform()};
    }
  }
  [[nodiscard]] double at(double time_s) const {
    double sum = 0.0;
    for (const Sine& sine : sines_) {
      sum += std::sin(kTwoPi * sine.frequency_hz * time_s + sine.phase_rad);
    }
    return sum / std::sqrt(0.5 * static_cast<double>(sines_.size()));
  }

 private:
  struct Sine {
    double frequency_hz = 0.0;
    double phase_rad = 0.0;
  };
  plant::Random random_;
  std::array<Sine, 8> sines_;
};

TaskBook book_of(const Way& way) {
  TaskBook book;
  book.count = 1;
  book.program[0].fences.count = 1;
  book.program[0].fences.fence[0] = way.fence;
  return book;
}

/// The mark is where the true edge is at the start.
ExcavatorProfile marked(ExcavatorProfile profile, bool is_marked,
                        const machines::SimulatedExcavator& machine,
                        const Eigen::Vector3d& start_m) {
  if (is_marked) {
    const plant::ExcavatorPlant plant(machine.plant, {start_m[0], start_m[1], start_m[2]});
    profile.mark.place_m = plant.teeth().position_m;
    profile.mark.tolerance_m = 0.2;
  }
  return profile;
}

/// IMUs are given the time to learn their biases before anything is touched by them.
double begin_s(const ExcavatorProfile& profile) {
  return profile.imu.known() || profile.imu.has_body()
             ? static_cast<double>(kImusLearn_us) / kSecondUs
             : 0.0;
}

class AssistRun {
 public:
  AssistRun(const machines::SimulatedExcavator& machine, const AssistOptions& options)
      : options_(options),
        kinematics_(machine.profile.geometry),
        way_(way_of(machine.profile, options)),
        fastest_(machine, way_, options.record == LeverRecord::kThird ? 1.0 / 3.0 : 1.0),
        start_m_(kinematics_.strokes_from_pose(way_.at(0.5 * way_.length_m())).strokes_m),
        noise_(options.seed),
        begin_s_(begin_s(machine.profile)),
        rig_(machine,
             ExcavatorSetup(marked(machine.profile, options.marked, machine, start_m_),
                            book_of(way_)),
             start_at(start_m_), Task::kAssist, 1.0) {
    rig_.driver.set_hands(hands_);
    std::vector<plant::OperatorPhase> phases;
    const auto at = [](double time_s) { return static_cast<TimeUs>(time_s * 1e6); };
    phases.push_back({0, {false, OperatorMode::kManual, Task::kNone, 0.0}});
    phases.push_back(
        {at(begin_s_ + kEnable_s - 0.5), {false, OperatorMode::kAutomatic, Task::kNone, 0.0}});
    phases.push_back(
        {at(begin_s_ + kEnable_s), {true, OperatorMode::kAutomatic, Task::kNone, 0.0}});
    phases.push_back(
        {at(begin_s_ + kEnable_s + 0.1), {true, OperatorMode::kAutomatic, Task::kAssist, 1.0}});
    rig_.driver.set_schedule(phases);
  }

  AssistResult run() {
    AssistResult result;
    const auto most = static_cast<int>((begin_s_ + kMost_s) / kPeriod_s);
    int n = 0;
    for (; n < most && phase_ != Phase::kDone; ++n) {
      now_s_ = n * kPeriod_s;
      if (options_.marked && n == static_cast<int>((begin_s_ + kTouch_s) / kPeriod_s)) {
        rig_.driver.touch_mark();
      }
      operate();
      rig_.driver.set_hands(hands_);
      rig_.step(static_cast<TimeUs>(n) * 10 * kMillisecondUs);
      watch();
      if (rig_.ecu->outputs().status.mode == EcuMode::kFault) {
        result.end = AssistEnd::kFault;
        summary_.fault = static_cast<double>(rig_.ecu->outputs().status.fault);
        break;
      }
    }
    if (n == most) {
      result.end = AssistEnd::kNotFinished;
    }
    summarise();
    result.summary = summary_;
    return result;
  }

 private:
  enum class Phase { kWait, kOut, kTurn, kIn, kEnd, kDone };

  [[nodiscard]] double out_m() const {
    return way_.along().dot(rig_.plant.plant().tip().position_m - way_.near_m);
  }

  /// Of the arm's lever, 0 .. 1.
  [[nodiscard]] double lever(double time_s) const {
    switch (options_.record) {
      case LeverRecord::kFull:
        return 1.0;
      case LeverRecord::kThird:
        return 1.0 / 3.0;
      case LeverRecord::kRamps:
        return 1.0 - std::abs(1.0 - std::fmod(time_s, 3.0) / 1.5);
      case LeverRecord::kReleases:
        return std::fmod(time_s, 2.2) < 1.2 ? 0.67 : 0.0;
      case LeverRecord::kNoise:
        return std::clamp(0.6 + 0.2 * noise_.at(time_s), 0.05, 1.0);
      case LeverRecord::kTwo:
        return 0.67;
    }
    return 0.0;
  }

  void operate() {
    hands_.lever_ratio = {};
    const bool active = rig_.ecu->outputs().status.mode == EcuMode::kActive;
    const double at_m = out_m();
    const auto next = [&](Phase phase) {
      phase_ = phase;
      since_s_ = now_s_;
      from_m_ = at_m;
    };
    if (phase_ == Phase::kWait && active && now_s_ > begin_s_ + kEnable_s + 1.0) {
      next(Phase::kOut);
    } else if (phase_ == Phase::kOut && at_m > way_.length_m() - 0.1) {
      next(Phase::kTurn);
    } else if (phase_ == Phase::kTurn && now_s_ > since_s_ + kRest_s) {
      next(Phase::kIn);
    } else if (phase_ == Phase::kIn && at_m < 0.1) {
      next(Phase::kEnd);
    } else if (phase_ == Phase::kEnd && now_s_ > since_s_ + kRest_s) {
      next(Phase::kDone);
    }
    if (phase_ == Phase::kIn || phase_ == Phase::kOut) {
      const double time_s = now_s_ - since_s_;
      hands_.lever_ratio[kArm] = (phase_ == Phase::kIn ? 1.0 : -1.0) * lever(time_s);
      if (options_.record == LeverRecord::kTwo) {
        const double turn = std::fmod(time_s, 3.0);
        hands_.lever_ratio[kBoom] = turn < 0.8 ? -0.7 : 0.0;
        hands_.lever_ratio[kBucket] = turn > 1.0 && turn < 1.5   ? 0.2
                                      : turn > 2.0 && turn < 2.5 ? -0.2
                                                                 : 0.0;
      }
    }
  }

  void watch() {
    const plant::ExcavatorPlant& plant = rig_.plant.plant();
    const ExcavatorStatus& status = rig_.ecu->outputs().status;
    const double at_m = out_m();
    // Off the line that is held; a cut is one of the design itself.
    const FenceTruth truth(plant);
    const double over_design_m = way_.ground != nullptr ? truth.edge_over_m(way_.ground->height_m)
                                                        : truth.left_m(way_.fence);
    const double off_m = over_design_m - rig_.setup.profile.assist.offset_m;
    const Eigen::Vector3d teeth_m = plant.teeth().position_m;
    const double speed_mps = (teeth_m - last_teeth_m_).norm() / kPeriod_s;
    last_teeth_m_ = teeth_m;
    const double lever_now = hands_.lever_ratio[kArm];
    const bool works = phase_ == Phase::kIn || phase_ == Phase::kOut;
    way_m_ += works ? std::abs(at_m - last_m_) : 0.0;
    if (way_m_ > kOnto_m && phase_ != Phase::kDone) {
      off_.add(off_m);
      most_off_m_ = std::max(most_off_m_, std::abs(off_m));
      over_cut_m_ = std::max(over_cut_m_, -over_design_m);
      wave_.add(high_pass_.step(off_m));
    }
    if (works && lever_now != 0.0 && std::abs(at_m - from_m_) > kOnto_m) {
      took_s_ += kPeriod_s;
      fastest_s_ += std::abs(at_m - last_m_) / fastest_.mps(at_m, phase_ == Phase::kIn);
    }
    on_s_ = std::abs(lever_now) > 0.3 ? on_s_ + kPeriod_s : 0.0;
    if (works && on_s_ > 0.5 && speed_mps < 0.01 && status.limit.kind == LimitKind::kNone) {
      summary_.unsaid_s += kPeriod_s;
    }
    watch_stop(lever_now, off_m, speed_mps);
    watch_halt(lever_now, teeth_m);
    last_m_ = at_m;
    last_lever_ = lever_now;
  }

  void watch_stop(double lever_now, double off_m, double speed_mps) {
    if (lever_now == 0.0 && last_lever_ != 0.0) {
      let_go_s_ = now_s_;
    }
    if (lever_now != 0.0) {
      let_go_s_.reset();
    }
    if (let_go_s_) {
      stop_off_m_ = std::max(stop_off_m_, std::abs(off_m));
      if (speed_mps > kStands_mps) {
        stop_s_ = std::max(stop_s_, now_s_ - *let_go_s_);
      }
    }
  }

  /// A rest that is too short to be one says nothing.
  void watch_halt(double lever_now, const Eigen::Vector3d& teeth_m) {
    if (lever_now == 0.0 && phase_ != Phase::kDone && (!let_go_m_.empty() || last_lever_ != 0.0)) {
      let_go_m_.push_back(teeth_m);
    } else {
      end_halt();
    }
  }

  void end_halt() {
    if (static_cast<double>(let_go_m_.size()) * kPeriod_s > kRests_s) {
      std::size_t n = let_go_m_.size();
      while (n > 0 && (let_go_m_[n - 1] - let_go_m_.back()).norm() <= kHalted_m) {
        --n;
      }
      halt_s_ = std::max(std::isnan(halt_s_) ? 0.0 : halt_s_, static_cast<double>(n) * kPeriod_s);
    }
    let_go_m_.clear();
  }

  void summarise() {
    end_halt();
    summary_.halt_s = halt_s_;
    summary_.rmse_m = off_.rms();
    summary_.most_off_m = most_off_m_;
    summary_.over_cut_m = over_cut_m_;
    summary_.wave_rms_m = wave_.rms();
    const bool steady =
        options_.record == LeverRecord::kFull || options_.record == LeverRecord::kThird;
    summary_.time_ratio = steady && fastest_s_ > 0.0 ? took_s_ / fastest_s_ : kAbsent;
    summary_.stop_s = stop_s_;
    summary_.stop_off_m = stop_off_m_;
  }

  const AssistOptions& options_;
  ExcavatorKinematics kinematics_;
  Way way_;
  FastestByFlow fastest_;
  Eigen::Vector3d start_m_;
  HandNoise noise_;
  double begin_s_;
  ExcavatorRig rig_;
  plant::OperatorHands hands_;
  AssistSummary summary_;
  Phase phase_ = Phase::kWait;
  double now_s_ = 0.0;
  double since_s_ = 0.0;
  double from_m_ = 0.0;
  double last_m_ = 0.0;
  double way_m_ = 0.0;
  double took_s_ = 0.0;
  double fastest_s_ = 0.0;
  double stop_s_ = 0.0;
  double stop_off_m_ = 0.0;
  double halt_s_ = kAbsent;
  std::vector<Eigen::Vector3d> let_go_m_;  ///< The edge in each cycle since.
  double most_off_m_ = 0.0;
  double over_cut_m_ = 0.0;
  double last_lever_ = 0.0;
  double on_s_ = 0.0;  ///< The lever is, for so long.
  std::optional<double> let_go_s_;
  Eigen::Vector3d last_teeth_m_ = Eigen::Vector3d::Zero();
  Spread off_;
  Spread wave_;
  HighPass high_pass_{kWave_hz};
};

}  // namespace

const FigureTable<AssistSummary>& assist_figures() {
  using S = AssistSummary;
  static const FigureTable<S> all = {
      {{"rmse_m", "true edge off the design, RMS", kMillimetres, "rmse_m"},
       [](const S& s) { return s.rmse_m; }},
      {{"most_off_m", "the same, max", kMillimetres, "most_off_m"},
       [](const S& s) { return s.most_off_m; }},
      {{"over_cut_m", "true edge under the design, max", kMillimetres, "over_cut_m"},
       [](const S& s) { return s.over_cut_m; }},
      {{"wave_rms_m", "error above 0.5 Hz, RMS", kMillimetres, "wave_rms_m"},
       [](const S& s) { return s.wave_rms_m; }},
      {{"time_ratio", "time over the fastest by flow", kRatio, "time_ratio"},
       [](const S& s) { return s.time_ratio; }},
      {{"stop_s", "from letting go until below 20 mm/s, max", kSeconds, "stop_s"},
       [](const S& s) { return s.stop_s; }},
      {{"halt_s", "from letting go until 15 mm from its rest, max", kSeconds, "halt_s"},
       [](const S& s) { return s.halt_s; }},
      {{"stop_off_m", "off the design from then on, max", kMillimetres, "stop_off_m"},
       [](const S& s) { return s.stop_off_m; }},
      {{"unsaid_s", "stood without a limit told", kSeconds, "unsaid_s"},
       [](const S& s) { return s.unsaid_s; }},
      {{"fault", "fault that stopped it", kCount, "fault"}, [](const S& s) { return s.fault; }},
  };
  return all;
}

AssistResult run_assist(const machines::SimulatedExcavator& machine, const AssistOptions& options) {
  return AssistRun(machine, options).run();
}

}  // namespace graben::runs
