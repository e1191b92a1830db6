#include "app/plant/operator_node.hpp"

#include <array>

#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::plant {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;
using Command = bus::OperatorCommand;

constexpr std::uint64_t kSendCycles = Command::kCycleTimeMs / 10;
constexpr int kFramesPerRead = 64;

template <class Bus, class Own>
dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), RawState::kValid};
}

}  // namespace

OperatorRequest OperatorNode::request_at(TimeUs now) const {
  OperatorRequest request;
  for (const OperatorPhase& phase : schedule_) {
    if (phase.from_us <= now) {
      request = phase.request;
    }
  }
  return request;
}

void OperatorNode::set_silent(bool silent) { faults_.set_silent(Command::kId, silent); }

void OperatorNode::step(TimeUs now) {
  std::array<CanFrame, kFramesPerRead> ignored;
  static_cast<void>(port_.receive(ignored.data(), kFramesPerRead));
  if (cycle_++ % kSendCycles != 0) {
    return;
  }
  const OperatorRequest request = request_at(now);
  Command command;
  command.enable = coded<Command::Enable>(request.enable ? 1 : 0);
  command.operator_mode = coded<Command::OperatorMode>(request.mode);
  command.task = coded<Command::Task>(request.task);
  command.speed_override_ratio = {request.speed_override_ratio, RawState::kValid};
  sender_.send(command, faults_.frames, now);
}

}  // namespace graben::plant
