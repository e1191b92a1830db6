// SPDX-License-Identifier: Apache-2.0
#include "tests/endurance/day.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace graben::endurance {
namespace {

constexpr std::uint32_t kMorning_s = 1'800'000'000;
constexpr std::uint64_t kName = 0x3000FF0000000005;
const auto kOwnIds = ecu::ExcavatorKind::Transmitter::ids();

void say(const char* line) { std::fprintf(stderr, "%s\n", line); }

}  // namespace

Day::Day(const faults::Excavator::Scenery& scenery, test::MemoryDisk& disk)
    : machine_port_(bus_.attach()),
      operator_port_(bus_.attach()),
      tool_port_(bus_.attach()),
      ecu_port_(bus_.attach()),
      counted_(ecu_port_),
      machine_(faults::Excavator::node(scenery, machine_port_)),
      driver_(operator_port_),
      setup_(faults::Excavator::setup_of(scenery.machine)),
      claim_(kOwnAddress, kName),
      address_(counted_, claim_, last_),
      diagnostics_(kOwnAddress, kOwnIds.data(), kOwnIds.size()),
      port_(address_, diagnostics_),
      ecu_(setup_, scenery.machine.hash, port_, nullptr),
      store_(disk, scenery.machine.hash),
      keeper_(store_, *rings_, ecu::SampleKind::kExcavator, say) {
  if (!machine_port_.open() || !operator_port_.open() || !tool_port_.open() || !port_.open()) {
    throw std::runtime_error("the bus in memory did not open");
  }
  static_cast<void>(keeper_.begin(0, 1));
  recorder_.begin(keeper_.history());
  ask(false, Task::kNone);
}

std::uint32_t Day::wall_s(TimeUs now_us) {
  return kMorning_s + static_cast<std::uint32_t>(now_us / kSecondUs);
}

void Day::ask(bool enable, Task task) {
  driver_.set_schedule({{0, {enable, OperatorMode::kAutomatic, task, 1.0}}});
}

/// What the control thread does in a cycle.
void Day::control() {
  const std::uint64_t before = allocation_count() - counted_.allocations();
  address_.begin(now_us_);
  port_.begin(now_us_);
  ecu_.step(now_us_, 0);
  const MachineStatus& status = outputs().status;
  recorder_.look(ecu::sample_of(ecu_.inputs(), outputs(), now_us_), status.faults);
  const FaultSet cleared = port_.finish({status.faults, status.mode, recorder_.stored(),
                                         ecu::frozen_of(recorder_.last()), recorder_.can_forget()});
  recorder_.forget(cleared, now_us_);
  if (now_us_ % kSecondUs == 0 && rings_->learnt.has_room()) {
    static_cast<void>(rings_->learnt.put(ecu::record_of(ecu_.learnt())));
  }
  address_.finish();
  weight_.allocations +=
      weight_.cycles > 0 ? allocation_count() - counted_.allocations() - before : 0;
  for (Fault fault = status.faults.first(); fault != Fault::kNone;
       fault = status.faults.after(fault)) {
    weight_.events += there_.has(fault) ? 0U : 1U;
  }
  there_ = status.faults;
  ++weight_.cycles;
}

void Day::step() {
  bus_.set_time(now_us_);
  machine_.step(now_us_);
  driver_.step(now_us_);
  control();
  if (now_us_ % kWorkUs == 0) {
    keeper_.work(now_us_, wall_s(now_us_));
  }
  std::array<CanFrame, 64> frames;
  for (int count = 64; count == 64;) {
    count = tool_port_.receive(frames.data(), 64);
    for (int i = 0; i < count; ++i) {
      const std::uint32_t id = frames[static_cast<std::size_t>(i)].id;
      weight_.answers +=
          (id & 0xFFU) == kOwnAddress && (id >> 24U & 0x1FU) >= 0x18U && (id >> 16U & 0xFFU) < 240U
              ? 1U
              : 0U;
    }
  }
  now_us_ += kCycleUs;
}

void Day::end() { keeper_.finish(now_us_, wall_s(now_us_)); }

}  // namespace graben::endurance
