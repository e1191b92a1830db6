#include "app/plant/operator_node.hpp"

#include <array>

namespace graben::plant {
namespace {

using dbc::RawState;

template <class Bus, class Own>
dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), RawState::kValid};
}

const auto& messages_with(const dbc::excavator::OperatorCommand*) {
  return dbc::excavator::kMessages;
}
const auto& messages_with(const dbc::dozer::OperatorCommand*) { return dbc::dozer::kMessages; }

void say_task_number(dbc::excavator::OperatorCommand& command, std::uint8_t number) {
  command.task_number = {number, RawState::kValid};
}
void say_task_number(dbc::dozer::OperatorCommand& /*command*/, std::uint8_t /*number*/) {}

}  // namespace

OperatorRequest request_at(const std::vector<OperatorPhase>& schedule, TimeUs now) {
  OperatorRequest request;
  for (const OperatorPhase& phase : schedule) {
    if (phase.from_us <= now) {
      request = phase.request;
    }
  }
  return request;
}

template <class Command>
OperatorStation<Command>::OperatorStation(CanPort& port)
    : port_(port), sender_(port, messages_with(static_cast<const Command*>(nullptr))) {}

template <class Command>
void OperatorStation<Command>::step(TimeUs now) {
  constexpr int kFramesPerRead = 64;
  constexpr std::uint64_t kSendCycles = Command::kCycleTimeMs / 10;
  std::array<CanFrame, kFramesPerRead> ignored;
  static_cast<void>(port_.receive(ignored.data(), kFramesPerRead));
  if (cycle_++ % kSendCycles != 0) {
    return;
  }
  const OperatorRequest request = request_at(now);
  Command command;
  command.enable = coded<typename Command::Enable>(request.enable ? 1 : 0);
  command.operator_mode = coded<typename Command::OperatorMode>(request.mode);
  command.task = coded<typename Command::Task>(request.task);
  command.speed_override_ratio = {request.speed_override_ratio, RawState::kValid};
  say_task_number(command, request.task_number);
  sender_.send(command, faults_.frames, now);
}

template class OperatorStation<dbc::excavator::OperatorCommand>;
template class OperatorStation<dbc::dozer::OperatorCommand>;

}  // namespace graben::plant
