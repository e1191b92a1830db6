// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated machine, its operator, a workshop's tool and all of the deployed controller that
/// is no Linux: address, diagnosis, stored faults, what was learnt and their store, on a disk in
/// memory.

#include <cstdint>
#include <memory>
#include <random>

#include "app/ecu/address_port.hpp"
#include "app/ecu/diagnostic_port.hpp"
#include "app/ecu/store/fault_keeper.hpp"
#include "app/ecu/store/frozen_fault.hpp"
#include "platform/linux/allocation_counter.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/faults/excavator_kind.hpp"
#include "tests/unit/ecu/memory_disk.hpp"

namespace graben::endurance {

inline constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
/// The store's thread looks so often.
inline constexpr TimeUs kWorkUs = 100 * kMillisecondUs;

/// What the process had done by a cycle.
struct Weight {
  std::uint64_t cycles = 0;
  std::uint64_t allocations = 0;  ///< Of the control thread since its first cycle.
  std::uint64_t events = 0;       ///< Faults that came, as the bus tells them.
  std::uint32_t answers = 0;      ///< Claims, acknowledgments and packets of long messages.
};

/// The bus in memory has queues on the heap; what they take is not the controller's.
class CountedPort final : public CanPort {
 public:
  explicit CountedPort(CanPort& port) : port_(port) {}

  [[nodiscard]] bool open() override {
    const Outside outside(*this);
    return port_.open();
  }
  [[nodiscard]] CanPortState state() const override { return port_.state(); }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    const Outside outside(*this);
    return port_.receive(frames, capacity);
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    const Outside outside(*this);
    return port_.send(frame);
  }
  /// All so far.
  [[nodiscard]] std::uint64_t allocations() const { return allocations_; }

 private:
  class Outside {
   public:
    explicit Outside(CountedPort& port) : port_(port), before_(allocation_count()) {}
    Outside(const Outside&) = delete;
    Outside& operator=(const Outside&) = delete;
    ~Outside() { port_.allocations_ += allocation_count() - before_; }

   private:
    CountedPort& port_;
    std::uint64_t before_;
  };

  CanPort& port_;
  std::uint64_t allocations_ = 0;
};

class Day {
 public:
  Day(const faults::Excavator::Scenery& scenery, test::MemoryDisk& disk);

  /// A cycle of everybody: machine, operator, tool, controller, store.
  void step();
  void ask(bool enable, Task task);
  /// Sent by a tool before the next cycle.
  void tool_sends(const CanFrame& frame) { static_cast<void>(tool_port_.send(frame)); }

  [[nodiscard]] const ExcavatorOutputs& outputs() const { return ecu_.outputs(); }
  [[nodiscard]] EcuMode mode() const { return outputs().status.mode; }
  [[nodiscard]] faults::Excavator::Node& machine() { return machine_; }
  [[nodiscard]] const ecu::FaultKeeper& keeper() const { return keeper_; }
  [[nodiscard]] const j1939::AddressClaim& claim() const { return claim_; }
  [[nodiscard]] const Weight& weight() const { return weight_; }
  [[nodiscard]] TimeUs now_us() const { return now_us_; }
  void end();

 private:
  void control();
  [[nodiscard]] static std::uint32_t wall_s(TimeUs now_us);

  LoopbackBus bus_;
  LoopbackPort& machine_port_;
  LoopbackPort& operator_port_;
  LoopbackPort& tool_port_;
  LoopbackPort& ecu_port_;
  CountedPort counted_;
  faults::Excavator::Node machine_;
  faults::Excavator::Operator driver_;
  ExcavatorSetup setup_;
  j1939::AddressClaim claim_;
  ecu::LastFrames last_;
  ecu::AddressPort address_;
  j1939::Diagnostics diagnostics_;
  ecu::DiagnosticPort port_;
  faults::Excavator::Ecu ecu_;
  std::unique_ptr<ecu::FaultRings> rings_ = std::make_unique<ecu::FaultRings>();
  ecu::Store store_;
  ecu::FaultKeeper keeper_;
  ecu::FaultRecorder recorder_{rings_.get()};
  FaultSet there_;
  Weight weight_;
  TimeUs now_us_ = 0;
};

}  // namespace graben::endurance
