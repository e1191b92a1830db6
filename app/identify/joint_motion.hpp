// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The motion of a joint that its flow makes: pump lag, oil and mass, the rocking machine, sensor.

#include <array>
#include <cstddef>
#include <vector>

#include "app/identify/joint_model.hpp"

namespace graben::identify {

/// A joint in motion. Positive in the direction of a positive command: the joint's sign is not in
/// it.
template <class T>
struct JointState {
  T flow_radps{0.0};      ///< That the pump gives.
  T velocity_radps{0.0};  ///< Of the joint on its machine.
  T pushed_radps2{0.0};   ///< Acceleration by the oil.
  T tilt_rad{0.0};        ///< Of the rocking machine.
  T rocks_radps{0.0};     ///< Rate of the tilt.
  T seen_radps{0.0};      ///< By the sensor of velocity.
  T turned_rad{0.0};      ///< Since the run's first row, rocking included.
};

/// One step of what oscillates about `rest` at a `stiffness` of its rate squared, `at` with its
/// `speed`, to which `shoved` adds. The trapezoidal rule: it damps nothing by itself, and is stable
/// at any step.
template <class T>
void oscillate(T& at, T& speed, double step_s, const T& stiffness, const T& damping, const T& rest,
               const T& shoved) {
  const double half_s = 0.5 * step_s;
  const T before = speed;
  speed = (speed * (1.0 - half_s * damping - half_s * half_s * stiffness) + shoved +
           step_s * stiffness * (rest - at)) /
          (1.0 + half_s * damping + half_s * half_s * stiffness);
  at += half_s * (before + speed);
}

/// One row further: `wanted_radps` is what flow_velocity() says at the new row, `shoved_radps` by
/// how much the other joints' accelerations change the rocking's rate, `inertia` inertia_of().
template <class T>
void move(JointState<T>& state, const T* p, double row_s, const T& wanted_radps,
          const T& shoved_radps, const T& inertia) {
  constexpr int kSteps = 2;
  const double step_s = row_s / kSteps;
  const T stiffness = p[kModeRate] * p[kModeRate] / inertia;
  const T rock_stiffness = p[kRockRate] * p[kRockRate];
  const T rock_damping = 2.0 * p[kRockDamping] * p[kRockRate];
  const T before = state.flow_radps;
  state.flow_radps +=
      (wanted_radps - before) * (row_s / (row_s + lag_of(p + kFlowLag, before, wanted_radps)));
  for (int step = 0; step < kSteps; ++step) {
    const T flow = before + (state.flow_radps - before) * ((step + 0.5) / kSteps);
    const T& damping = p[state.pushed_radps2 * flow > 0.0 ? kDampingDriving : kDampingBraking];
    const T slower_radps = state.velocity_radps;
    const T was_radps = state.velocity_radps + state.rocks_radps;
    oscillate(state.velocity_radps, state.pushed_radps2, step_s, stiffness, damping, flow, T(0.0));
    const T shoved =
        shoved_radps / double(kSteps) + p[kRockOwn] * (state.velocity_radps - slower_radps);
    oscillate(state.tilt_rad, state.rocks_radps, step_s, rock_stiffness, rock_damping, T(0.0),
              shoved);
    const T true_radps = state.velocity_radps + state.rocks_radps;
    // The mean of both ends: with the later one alone an angle would lead by half a step.
    state.turned_rad += 0.5 * step_s * (was_radps + true_radps);
    state.seen_radps += (true_radps - state.seen_radps) * (step_s / (step_s + p[kSensorLag]));
  }
}

/// What the other joints' accelerations do to the rocking's rate between two rows.
template <class T>
T shove(const JointRun& of, std::size_t row, const T* p) {
  T shoved(0.0);
  for (std::size_t at = 0; at < kOthers; ++at) {
    const std::vector<double>& other = of.other_velocity_radps[at];
    shoved += p[kRockForce + at] * (other[row] - other[row - 1]);
  }
  return shoved;
}

/// What the run's velocity of a row would be: its sensor's, or the mean rate of the angle since an
/// earlier row.
template <class T>
T as_measured(const MotionRun& run, std::size_t joint, std::size_t row,
              const std::vector<JointState<T>>& states) {
  if (!run.by_angle[joint]) {
    return states[row].seen_radps;
  }
  const std::size_t since = run.since[row];
  return since == row ? states[row].velocity_radps
                      : T((states[row].turned_rad - states[since].turned_rad) /
                          (run.time_s[row] - run.time_s[since]));
}

/// A joint throughout a run, from the commands and the measured angles: one state per row.
template <class T>
std::vector<JointState<T>> motion(const JointRun& of, std::size_t joint, const T* p,
                                  const Grid& grid) {
  const std::vector<double>& time = of.run->time_s;
  const std::vector<T> open = openings(of, joint, p, grid);
  std::vector<JointState<T>> states(time.size());
  for (std::size_t row = 1; row < time.size(); ++row) {
    states[row] = states[row - 1];
    const T wanted =
        flow_velocity(of, row, p, grid, of.pose[row], of.run->angle_rad[joint][row], open[row]);
    move(states[row], p, time[row] - time[row - 1], wanted, shove(of, row, p),
         inertia_of(p, grid, of.pose[row]));
  }
  return states;
}

}  // namespace graben::identify
