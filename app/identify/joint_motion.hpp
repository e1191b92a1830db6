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

/// One row further: `wanted_radps` is what flow_velocity() says at the new row, `shoved_radps` by
/// how much the other joints' accelerations change the rocking's rate.
template <class T>
void move(JointState<T>& state, const T* p, double row_s, const T& wanted_radps,
          const T& shoved_radps) {
  constexpr int kSteps = 3;
  const double step_s = row_s / kSteps;
  const T stiffness = p[kModeRate] * p[kModeRate];
  const T rock_stiffness = p[kRockRate] * p[kRockRate];
  const T rock_damping = 2.0 * p[kRockDamping] * p[kRockRate];
  const T before = state.flow_radps;
  state.flow_radps +=
      (wanted_radps - before) * (row_s / (row_s + lag_of(p + kFlowLag, before, wanted_radps)));
  for (int step = 0; step < kSteps; ++step) {
    const T flow = before + (state.flow_radps - before) * ((step + 0.5) / kSteps);
    const T& damping = p[state.pushed_radps2 * flow > 0.0 ? kDampingDriving : kDampingBraking];
    state.pushed_radps2 =
        (state.pushed_radps2 + step_s * stiffness * (flow - state.velocity_radps)) /
        (1.0 + step_s * (damping + step_s * stiffness));
    state.velocity_radps += step_s * state.pushed_radps2;
    state.rocks_radps = (state.rocks_radps + shoved_radps / double(kSteps) -
                         step_s * rock_stiffness * state.tilt_rad) /
                        (1.0 + step_s * (rock_damping + step_s * rock_stiffness));
    state.tilt_rad += step_s * state.rocks_radps;
    const T true_radps = state.velocity_radps + state.rocks_radps;
    state.turned_rad += step_s * true_radps;
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
    move(states[row], p, time[row] - time[row - 1], wanted, shove(of, row, p));
  }
  return states;
}

}  // namespace graben::identify
