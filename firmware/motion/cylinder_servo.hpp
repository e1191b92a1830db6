#pragma once
/// Velocity feedback of the cylinders around the model: what they should have done by now, what is
/// still under way to them, and what they owe.

#include <Eigen/Core>
#include <array>

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/motion/load_filter.hpp"

namespace graben {

/// What one cycle hands to the next. Everything 0 is a machine at rest.
struct ServoState {
  static constexpr int kMostDelayed = 64;  ///< Cycles of dead time that can be remembered.
  std::array<Eigen::Vector3d, kMostDelayed> asked_mps{};  ///< Ring of the last commands.
  int newest = 0;
  Eigen::Vector3d lag_mps[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d under_way_m = Eigen::Vector3d::Zero();  ///< Asked for, not yet due.
  Eigen::Vector3d owed_m = Eigen::Vector3d::Zero();       ///< Due, not yet seen.
  Eigen::Vector3d calm_owed_m = Eigen::Vector3d::Zero();  ///< The same without oscillation.
  Eigen::Vector3d calm_strokes_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
  std::array<bool, kAxisCount> moves{};
};

/// State after a cycle in which `asked_mps` was commanded (lambda V_L^d, without corrections), for
/// use in the next one `period_s` later with these strokes.
///
/// A cylinder is expected to answer after the dead time with two lags of half `response_s` each.
/// What it should have moved by then and has not is owed; bounded by `servo_most_m`, so that a
/// cylinder that something holds owes no more than that.
[[nodiscard]] ServoState next_servo(const ControlProfile& control, const ServoState& last,
                                    const Eigen::Vector3d& asked_mps,
                                    const Eigen::Vector3d& strokes_m, double period_s);

/// Nothing is under way, nothing is owed.
[[nodiscard]] ServoState servo_at_rest(const Eigen::Vector3d& strokes_m);

/// Where the cylinders will be when what is under way has arrived, within their strokes.
[[nodiscard]] Eigen::Vector3d strokes_then(const ExcavatorProfile& profile, const ServoState& servo);

/// The wanted velocity with what is owed and with damping; no motion is asked for where none is
/// wanted. It all scales with lambda: what a limit holds back does not grow.
[[nodiscard]] Eigen::Vector3d corrected_velocity(const ControlProfile& control,
                                                 const Eigen::Vector3d& wanted_mps,
                                                 ServoState& servo, const LoadState& load, double last_lambda);

}  // namespace graben
