// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Joint angles of a machine whose links carry IMUs instead of stroke sensors, and the strokes that
/// they stand for. Frames as in excavator_profile.hpp.
///
/// Each link's angle against the horizontal is a LinkAngle; what its sensor feels of the links' own
/// motion is taken out from the boom foot outwards: each pin's acceleration by the angles, rates
/// and accelerations of the links before it, and the centripetal one of the swing, whose rate the
/// gyros show too. The platform's own angle, where an IMU is on it, is taken off the boom's: else
/// the platform counts as level.
///
/// A reading is as old as its frame says. The angles go out as of the time that the frames came: by
/// rate and acceleration from there, so that what is made of them needs to know nothing of it.

#include <array>

#include "firmware/core/time.hpp"
#include "firmware/estimation/link_angle.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// Whether a sensor goes on showing what it showed. Without vibration, at rest, both may.
struct FrozenWatch {
  ImuRates rates;           ///< Of the last reading.
  double turned_rad = 0.0;  ///< By the gyro, since the force was another one.
  int same_forces = 0;      ///< Readings in a row since then.
  /// Readings with a force that is another one by more than its noise, since the rates were others.
  int same_rates = 0;

  [[nodiscard]] bool is_frozen() const;
};

/// Of all IMUs from cycle to cycle.
struct ImuState {
  std::array<LinkAngle, kImuCount> link{};
  std::array<FrozenWatch, kImuCount> frozen{};
  std::array<TimeUs, kImuCount> stamp_us{};   ///< Of the frame whose reading is in.
  std::array<double, kImuCount> latency_s{};  ///< Of that reading.
  double rest_s = 0.0;                        ///< So long nothing can have moved.
};

/// Strokes by the IMUs, as the validation takes them from stroke sensors, and the joints.
struct ImuStrokes {
  std::array<Signal<double>, kAxisCount> stroke_m{};
  JointAngles joints;
};

/// Goes on by a cycle. `still`: no spool is open, as far as anybody knows; the gyros' biases are
/// learnt where that has lasted. The strokes are as valid and as old as the worst of their IMUs;
/// kNotAvailable until the standard deviation of every link is within kLinkKnown_rad; kError
/// where gyro and gravity contradict each other, or one of them is frozen.
[[nodiscard]] ImuStrokes next_imu_strokes(const ExcavatorKinematics& kinematics,
                                          const ImuProfile& profile, const ExcavatorInputs& inputs,
                                          bool still, double period_s, ImuState& state);

}  // namespace graben
