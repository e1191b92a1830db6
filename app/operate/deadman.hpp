// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the operator holds the machine's enable.

#include <cstdint>

namespace graben::operate {

/// Why a deadman that is held must not count.
enum class Trouble : std::uint8_t {
  kNone = 0,
  kStart,         ///< Nothing was seen released yet.
  kNotAtRest,     ///< It was pressed with a lever off its middle.
  kDeviceGone,    ///< What the hands hold is not there.
  kEventsLost,    ///< Of what they did something was lost.
  kDeviceSilent,  ///< Held, and no sign of life for too long.
  kStationLate,   ///< This process was left out for too long.
  kBus,           ///< The bus is not active.
  kEcuSilent,     ///< No EcuStatus.
  kOtherDbc,      ///< The ECU's frames are of another version.
};

/// In text; empty for kNone.
[[nodiscard]] const char* trouble_words(Trouble trouble);

/// The deadman counts from a press on that was seen to begin, with the levers at rest and without
/// any trouble, until it is released or trouble comes. After trouble it has to be seen released,
/// without trouble, before the next press counts.
class Deadman {
 public:
  /// Once a cycle; true while enable is to be given.
  [[nodiscard]] bool step(bool held, bool levers_at_rest, Trouble trouble);

  [[nodiscard]] bool is_on() const { return state_ == State::kOn; }
  /// Why the next press does not count, or the one that is held; kNone where it does.
  [[nodiscard]] Trouble trouble() const { return why_; }

 private:
  enum class State : std::uint8_t { kMustRelease, kReleased, kOn };

  void refuse(Trouble why);

  State state_ = State::kMustRelease;
  Trouble why_ = Trouble::kStart;
};

}  // namespace graben::operate
