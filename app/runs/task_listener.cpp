// SPDX-License-Identifier: Apache-2.0
#include "app/runs/task_listener.hpp"

namespace graben::runs {

using dbc::RawState;
using dbc::excavator::TaskStatus;

std::optional<int> TaskListener::step() const {
  using Kind = TaskStatus::StepKind;
  if (!is_at_task() || said_->step.state != RawState::kValid) {
    return std::nullopt;
  }
  const Kind kind = said_->step_kind.value;
  const bool in_step = kind != Kind::kNone && kind != Kind::kApproach && kind != Kind::kDone;
  return in_step ? std::optional<int>(static_cast<int>(said_->step.value)) : std::nullopt;
}

bool TaskListener::is_done() const {
  return is_at_task() && said_->step_kind.value == TaskStatus::StepKind::kDone;
}

bool TaskListener::is_at_task() const {
  return said_ && now_us_ - said_us_ < kHeldFor_us &&
         said_->task_number.state == RawState::kValid && said_->task_number.value == number_ &&
         said_->step_kind.state == RawState::kValid;
}

int TaskListener::receive(CanFrame* frames, int capacity) {
  const int count = port_.receive(frames, capacity);
  for (int i = 0; i < count; ++i) {
    read(frames[i]);
  }
  return count;
}

void TaskListener::read(const CanFrame& frame) {
  const bool whole = frame.extended && !frame.remote && !frame.error && !frame.fd &&
                     frame.length == TaskStatus::kLength;
  if (whole && same_message(frame.id, TaskStatus::kId)) {
    said_ = TaskStatus::decode(frame.data);
    said_us_ = now_us_;
  }
}

}  // namespace graben::runs
