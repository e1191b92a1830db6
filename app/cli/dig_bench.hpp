#pragma once
/// Simulated machine, operator and controller on one bus in memory. They share nothing but frames.

#include "app/ecu/excavator_ecu.hpp"
#include "app/machines/machine_file.hpp"
#include "app/plant/operator_node.hpp"
#include "app/plant/plant_node.hpp"
#include "platform/loopback/loopback_bus.hpp"

namespace graben::cli {

/// The operator gives nothing until kEnable_us, then enables automatic mode, then sets the task.
struct DigBench {
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kEnable_us = 200 * kMillisecondUs;
  static constexpr TimeUs kTask_us = 300 * kMillisecondUs;

  DigBench(const machines::ExcavatorMachine& machine, const Eigen::Vector3d& start_strokes_m,
           double override_ratio);

  /// Everyone's cycle at `now_us`, machine first; returns how long the controller computed, in
  /// microseconds of real time.
  double step(TimeUs now_us);

  /// The operator lets go of the deadman, for good.
  void release();
  /// The operator, having let go, enables at `enable_us` and sets the task 100 ms later.
  void enable_from(TimeUs enable_us);

  LoopbackBus bus;
  LoopbackPort& plant_port;
  LoopbackPort& operator_port;
  LoopbackPort& ecu_port;
  double speed_override_ratio;
  plant::PlantNode plant;
  plant::OperatorNode driver;
  ecu::ExcavatorEcu ecu;
};

}  // namespace graben::cli
