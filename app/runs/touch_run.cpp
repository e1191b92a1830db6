// SPDX-License-Identifier: Apache-2.0
#include "app/runs/touch_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "app/plant/random.hpp"
#include "app/runs/excavator_rig.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

/// Of a peg over the ground.
constexpr double kPegHeight_m = 0.3;
/// From either end of a stroke, of the stroke.
constexpr double kFromEnds = 0.1;
constexpr double kAttitudeStep_rad = 0.02;
constexpr double kReachStep_m = 0.25;
/// Two pegs say more the farther they are apart; on each the bucket turns by this at least.
constexpr double kLeastTurn_rad = 0.7;

// How a hand moves a lever to bring a stroke where the eye wants it.
constexpr double kLever_pm = 4.0;
constexpr double kMostLever = 0.4;
constexpr double kLeastLever = 0.004;
/// More each cycle until the drive has come there: within its dead band it does not answer.
constexpr double kPush = 1e-4;
constexpr double kGentler = 0.8;
constexpr double kMostGentle = 0.1;
/// The posture is about right, and the edge where the eye wants it.
constexpr double kNear_m = 0.01;
constexpr double kGood = 0.4;
constexpr double kThere_m = 0.0003;
constexpr double kLooks_s = 1.0;
constexpr double kLongestMove_s = 120.0;

struct Span {
  double least_rad = 0.0;
  double most_rad = 0.0;
  [[nodiscard]] double turn_rad() const { return most_rad - least_rad; }
};

std::optional<Eigen::Vector3d> strokes_inside(const ExcavatorKinematics& kinematics,
                                              const Eigen::Vector2d& peg_m, double attitude_rad) {
  const StrokeResult strokes = kinematics.strokes_from_pose({peg_m.x(), peg_m.y(), attitude_rad});
  bool inside = strokes.status == ReachStatus::kOk;
  for (int i = 0; i < kAxisCount && inside; ++i) {
    const double whole_m = kinematics.geometry().cylinder[static_cast<std::size_t>(i)].stroke_m;
    inside = strokes.strokes_m[i] > kFromEnds * whole_m &&
             strokes.strokes_m[i] < (1.0 - kFromEnds) * whole_m;
  }
  return inside ? std::optional(strokes.strokes_m) : std::nullopt;
}

/// The widest stretch of attitudes in which the edge can be there.
Span span_at(const ExcavatorKinematics& kinematics, const Eigen::Vector2d& peg_m) {
  Span best;
  Span now;
  bool open = false;
  for (double attitude_rad = 0.0; attitude_rad < kTwoPi; attitude_rad += kAttitudeStep_rad) {
    const bool inside = strokes_inside(kinematics, peg_m, attitude_rad).has_value();
    now.least_rad = open ? now.least_rad : attitude_rad;
    now.most_rad = attitude_rad;
    best = inside && now.turn_rad() > best.turn_rad() ? now : best;
    open = inside;
  }
  return best;
}

/// Of all strokes: where the machine stands before the first touch.
Eigen::Vector3d middle_of(const ExcavatorGeometry& geometry) {
  return 0.5 * Eigen::Vector3d(geometry.cylinder[0].stroke_m, geometry.cylinder[1].stroke_m,
                               geometry.cylinder[2].stroke_m);
}

class TouchRun {
 public:
  TouchRun(const machines::SimulatedExcavator& machine, const TouchOptions& options)
      : options_(options),
        kinematics_(machine.profile.geometry),
        eye_(options.seed, plant::Draw::kEye),
        rig_(machine, machine.profile, start_at(middle_of(machine.profile.geometry)), Task::kJog,
             1.0) {
    rig_.enable_from(kImusLearn_us);
    for (const Eigen::Vector2d& peg_m : options.pegs_m) {
      result_.height_m.push_back(peg_m.y() + options.level_m * eye_.normal());
    }
    aim();
  }

  TouchRunResult run(const Progress& progress) {
    const LoggedRun unused = run_logged(
        rig_, options_.log_file, [this](TimeUs now_us) { return ended(now_us); },
        [&](TimeUs now_us, double) {
          operate(seconds(now_us));
          progress(
              static_cast<double>(result_.touched) / static_cast<double>(options_.touches.size()),
              fmt::format("touch {}", result_.touched + 1));
        });
    static_cast<void>(unused);
    return std::move(result_);
  }

 private:
  using Drives = std::array<double, kAxisCount>;

  [[nodiscard]] const WantedTouch& touch() const { return options_.touches[result_.touched]; }

  /// Where the eye wants the edge: not quite on the peg.
  void aim() {
    const Eigen::Vector2d& peg_m = options_.pegs_m[touch().peg];
    const KinematicState pose = kinematics_.state(touch().strokes_m);
    const StrokeResult wanted = kinematics_.strokes_from_pose(
        {peg_m.x() + 0.5 * options_.eye_m * eye_.symmetric(1.0),
         peg_m.y() + 0.5 * options_.eye_m * eye_.symmetric(1.0), pose.tip.attitude_rad});
    wanted_m_ = wanted.status == ReachStatus::kOk ? wanted.strokes_m : touch().strokes_m;
  }

  bool ended(TimeUs now_us) {
    const ExcavatorStatus& status = rig_.ecu->outputs().status;
    result_.machine_s = seconds(now_us);
    if (status.mode == EcuMode::kFault) {
      result_.end = TouchEnd::kFault;
      result_.fault = status.fault;
      return true;
    }
    if (result_.touched < options_.touches.size() &&
        seconds(now_us) > moved_s_ + options_.rest_s + kLongestMove_s) {
      result_.end = TouchEnd::kTooLong;
      return true;
    }
    return result_.touched == options_.touches.size();
  }

  [[nodiscard]] double off_m() const {
    return (rig_.plant.plant().tip().position_m - options_.pegs_m[touch().peg]).norm();
  }

  /// A drive that went too far is moved more gently from then on.
  double lever_of(std::size_t i, double left_m) {
    const bool turned_back = left_m * last_left_m_[i] < 0.0;
    last_left_m_[i] = left_m;
    gentle_[i] = turned_back ? std::max(kMostGentle, kGentler * gentle_[i]) : gentle_[i];
    pushes_[i] = std::abs(left_m) < kThere_m || turned_back ? 0.0 : pushes_[i] + gentle_[i] * kPush;
    const double least = std::min(kMostLever, kLeastLever + pushes_[i]);
    return std::clamp(gentle_[i] * kLever_pm * std::abs(left_m), least, kMostLever);
  }

  /// Levers until the strokes are there, hands off and a look, then the rest.
  void operate(double now_s) {
    const bool active = rig_.ecu->outputs().status.mode == EcuMode::kActive;
    plant::OperatorHands hands;
    const Drives strokes_m = rig_.plant.plant().strokes_m();
    bool there = true;
    bool near = true;
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      const double left_m = wanted_m_[static_cast<int>(i)] - strokes_m[i];
      there = there && std::abs(left_m) < kThere_m;
      near = near && std::abs(left_m) < kNear_m;
      const double lever = lever_of(i, left_m);
      hands.lever_ratio[i] =
          active && !rests_ && std::abs(left_m) >= kThere_m ? std::copysign(lever, left_m) : 0.0;
    }
    if (active && !rests_ && (there || (near && off_m() < kGood * options_.eye_m))) {
      rests_ = true;
      since_s_ = now_s;
    }
    if (rests_ && now_s > since_s_ + kLooks_s && now_s < since_s_ + 2.0 * kLooks_s &&
        off_m() > options_.eye_m) {
      rests_ = false;
      aim();
    }
    if (rests_ && now_s > since_s_ + options_.rest_s) {
      result_.off_m.push_back(off_m());
      ++result_.touched;
      rests_ = false;
      moved_s_ = now_s;
      if (result_.touched < options_.touches.size()) {
        gentle_.fill(1.0);
        aim();
      }
    }
    rig_.driver.set_hands(hands);
  }

  const TouchOptions& options_;
  ExcavatorKinematics kinematics_;
  plant::Random eye_;
  ExcavatorRig rig_;
  TouchRunResult result_;
  Eigen::Vector3d wanted_m_ = Eigen::Vector3d::Zero();
  Drives pushes_{};
  Drives last_left_m_{};
  Drives gentle_{1.0, 1.0, 1.0};
  bool rests_ = false;
  double since_s_ = 0.0;  ///< Hands off.
  double moved_s_ = 0.0;  ///< The last touch was done.
};

}  // namespace

TouchOptions usual_touches(const machines::SimulatedExcavator& machine, std::size_t pegs,
                           std::size_t each) {
  const ExcavatorGeometry& geometry = machine.profile.geometry;
  const ExcavatorKinematics kinematics(geometry);
  const double up_m = kPegHeight_m - geometry.boom_foot_m.y();
  const double reach_m = geometry.boom_length_m + geometry.arm_length_m + geometry.bucket_length_m;
  Eigen::Vector2d widest_m = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> wide_m;
  double widest_rad = 0.0;
  for (double ahead_m = 0.3 * reach_m; ahead_m < reach_m; ahead_m += kReachStep_m) {
    const Eigen::Vector2d peg_m(ahead_m, up_m);
    const double turn_rad = span_at(kinematics, peg_m).turn_rad();
    if (turn_rad > kLeastTurn_rad) {
      wide_m.push_back(peg_m);
    }
    widest_m = turn_rad > widest_rad ? peg_m : widest_m;
    widest_rad = std::max(widest_rad, turn_rad);
  }
  if (wide_m.empty()) {
    throw std::runtime_error("the machine reaches no peg in several postures");
  }
  TouchOptions options;
  options.pegs_m = {widest_m};
  if (pegs > 1) {
    options.pegs_m = {wide_m.back(), wide_m.front()};
  }
  for (std::size_t p = 0; p < options.pegs_m.size(); ++p) {
    const Span span = span_at(kinematics, options.pegs_m[p]);
    for (std::size_t n = 0; n < each; ++n) {
      const double share = each > 1 ? static_cast<double>(n) / static_cast<double>(each - 1) : 0.5;
      const auto strokes_m =
          strokes_inside(kinematics, options.pegs_m[p],
                         span.least_rad + share * (span.turn_rad() - kAttitudeStep_rad));
      if (strokes_m) {
        options.touches.push_back({p, *strokes_m});
      }
    }
  }
  return options;
}

TouchRunResult run_touches(const machines::SimulatedExcavator& machine, const TouchOptions& options,
                           const Progress& progress) {
  return TouchRun(machine, options).run(progress);
}

}  // namespace graben::runs
