// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that the controller talks to, on one port: sensors, engine, operator, valve. By itself it is
/// a machine that does what it is told; a script can spoil any of it.

#include <array>
#include <cstdint>
#include <deque>
#include <string_view>

#include "can_dbc/codec.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

inline constexpr unsigned kInputMessages = 11;

/// Messages to the controller of every machine of the kind, in the order of the DBC, the valve's
/// answer last: the corpus counts on that.
template <class Kind>
[[nodiscard]] constexpr std::array<dbc::MessageInfo, kInputMessages> input_messages() {
  std::array<dbc::MessageInfo, kInputMessages> inputs{};
  unsigned count = 0;
  for (const dbc::MessageInfo& info : Kind::Dbc::kMessages) {
    const bool from_ecu =
        std::string_view(info.sender) == std::string_view(Kind::Dbc::EcuStatus::kSender);
    if (!from_ecu && !Kind::is_of_a_part(info.id) && info.id != Kind::Dbc::ValveState::kId) {
      inputs[count++] = info;
    }
  }
  inputs[count++] = dbc::message_info<typename Kind::Dbc::ValveState>();
  return count == kInputMessages ? inputs : decltype(inputs){};
}

template <class Kind>
[[nodiscard]] const dbc::MessageInfo& input_message(unsigned index) {
  static constexpr auto kInputs = input_messages<Kind>();
  static_assert(kInputs[kInputMessages - 1].id == Kind::Dbc::ValveState::kId);
  return kInputs[index % kInputMessages];
}

struct OperatorHand {
  bool enable = false;
  bool automatic = true;
  bool task = false;
  double speed_ratio = 1.0;
};

template <class Kind>
class BusPartner {
 public:
  BusPartner(const typename Kind::Profile& profile, std::uint32_t profile_hash, ScriptedPort& port,
             TimeUs now);

  /// Takes in what the controller has sent, moves the machine, and queues every frame that was due
  /// since the last call.
  void run_until(TimeUs now);

  /// The hand does what the mode on the bus wants for Active: release, enable again, task.
  void lead_to_active();
  /// No more interference, with the machine's motion neither.
  void mend();

  /// A frame of the message beside the regular ones, its CRC right; `skip` on from its counter.
  /// With 0 the regular ones go on from there.
  void put_protected(unsigned message, dbc::Payload payload, std::uint8_t skip);
  /// Queues the last `count` regular frames once more.
  void replay(unsigned count);

  OperatorHand hand;
  std::uint16_t muted = 0;  ///< A bit for each message.
  /// Bytes of the payload that a message has instead of its own, before it is protected.
  struct Replacement {
    std::uint8_t mask = 0;  ///< A bit for each byte.
    dbc::Payload payload{};
  };
  std::array<Replacement, kInputMessages> replaced{};
  /// The next frames of a message are changed by `flip` in one byte, after they were protected; or
  /// protected as another message.
  struct Spoil {
    int frames = 0;
    std::uint8_t byte = 0;
    std::uint8_t flip = 0;
    bool masquerade = false;
  };
  std::array<Spoil, kInputMessages> spoilt{};
  typename Kind::Body body;

 private:
  void listen(TimeUs now);
  [[nodiscard]] dbc::Payload payload_of(unsigned message) const;
  void send(unsigned message, TimeUs now);

  std::uint32_t profile_hash_;
  ScriptedPort& port_;
  TimeUs now_;
  std::array<TimeUs, kInputMessages> due_us_{};
  std::array<std::uint8_t, kInputMessages> counter_{};
  std::deque<CanFrame> last_sent_;
  // What the controller said last.
  TimeUs command_us_ = 0;
  typename Kind::Dbc::EcuStatus status_;
  TimeUs enabled_since_us_ = 0;
  TimeUs released_since_us_ = 0;
};

}  // namespace graben::test
