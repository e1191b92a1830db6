// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated machine, its operator and the controller on a bus in memory, as a script has them.

#include <cstdint>
#include <functional>
#include <stdexcept>

#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/timing/counts/recording_port.hpp"
#include "tests/timing/counts/script.hpp"

namespace graben::timing {

template <class Kind>
class Scene {
 public:
  /// `node` makes the machine on the port that it is given.
  template <class Machine, class MakeNode>
  Scene(const Script& script, const Machine& machine, std::uint32_t profile_hash, Task task,
        MakeNode node)
      : script_(script),
        task_(task),
        machine_port_(bus_.attach()),
        operator_port_(bus_.attach()),
        ecu_port_(bus_.attach(kQueue)),
        recorder_(ecu_port_),
        plant_(node(machine_port_)),
        driver_(operator_port_),
        ecu_(machine, profile_hash, recorder_) {
    if (!machine_port_.open() || !operator_port_.open() || !ecu_port_.open()) {
      throw std::runtime_error("the bus in memory did not open");
    }
    bus_.set_fault_hook([this](CanFrame& frame, const LoopbackPort* from) {
      return from == nullptr || from == &ecu_port_ || alter(frame);
    });
  }

  /// Everyone's next cycle, and what the controller saw of it.
  [[nodiscard]] TraceCycle step();

 private:
  /// As many frames as a cycle of the controller reads.
  static constexpr std::size_t kQueue = ecu::kFramesPerBatch * ecu::kBatchesRead;

  void give_task();
  /// False loses the frame.
  bool alter(CanFrame& frame);
  bool alter(const Edit& edit, CanFrame& frame);
  void disturb(const Edit& edit);
  void send_more(const Edit& edit);

  const Script& script_;
  Task task_;
  LoopbackBus bus_;
  LoopbackPort& machine_port_;
  LoopbackPort& operator_port_;
  LoopbackPort& ecu_port_;
  RecordingPort recorder_;
  typename Kind::Node plant_;
  typename Kind::Operator driver_;
  typename Kind::Ecu ecu_;
  int cycle_ = 0;
  TimeUs now_us_ = 0;
  int hold_ = 0;
  double speed_ratio_ = 1.0;
};

}  // namespace graben::timing
