// SPDX-License-Identifier: Apache-2.0
#include "app/operate/deadman.hpp"

namespace graben::operate {

const char* trouble_words(Trouble trouble) {
  switch (trouble) {
    case Trouble::kNone:
      return "";
    case Trouble::kStart:
      return "it was held from the start";
    case Trouble::kNotAtRest:
      return "a lever was off its middle when it was pressed";
    case Trouble::kDeviceGone:
      return "the gamepad is gone";
    case Trouble::kEventsLost:
      return "events of the gamepad were lost";
    case Trouble::kDeviceSilent:
      return "the gamepad has been silent for too long";
    case Trouble::kStationLate:
      return "this station was late";
    case Trouble::kBus:
      return "the bus is not active";
    case Trouble::kEcuSilent:
      return "the controller is not heard";
    case Trouble::kOtherDbc:
      return "the controller has another version of the frames";
  }
  return "";
}

void Deadman::refuse(Trouble why) {
  state_ = State::kMustRelease;
  why_ = why;
}

bool Deadman::step(bool held, bool levers_at_rest, Trouble trouble) {
  if (trouble != Trouble::kNone) {
    refuse(trouble);
  } else if (!held) {
    state_ = State::kReleased;
    why_ = Trouble::kNone;
  } else if (state_ == State::kReleased && !levers_at_rest) {
    refuse(Trouble::kNotAtRest);
  } else if (state_ == State::kReleased) {
    state_ = State::kOn;
  }
  return is_on();
}

}  // namespace graben::operate
