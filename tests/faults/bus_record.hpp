#pragma once
/// What the controller said on the bus, decoded frame by frame: the only witness of its reactions.

#include <cstdint>
#include <map>
#include <vector>

#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"
#include "hal/can_frame.hpp"

namespace graben::faults {

struct BusRecord {
  struct Command {
    TimeUs at_us = 0;
    bool enable = false;
    bool neutral = false;  ///< Every duty is 0.
    bool pilot_cut = false;

    [[nodiscard]] bool is_neutral() const { return !enable && neutral; }
  };
  struct Status {
    TimeUs at_us = 0;
    EcuMode mode = EcuMode::kSilent;
    Fault fault = Fault::kNone;
    Limit limit;
  };
  struct Trouble {
    TimeUs at_us = 0;
    Fault fault = Fault::kNone;
  };
  struct Refusal {
    TimeUs at_us = 0;
    std::uint32_t why_not_armed = 0;
  };
  struct Wanted {
    TimeUs at_us = 0;
    double speed_mps = 0.0;  ///< Of all cylinders together, as the field wants them.
  };

  std::vector<Command> commands;
  std::vector<Status> statuses;
  std::vector<Trouble> troubles;
  std::vector<Refusal> refusals;
  std::vector<Wanted> wanted;
  std::map<std::uint32_t, TimeUs> last_us;  ///< Of each message of the others.

  void see(const CanFrame& frame, bool from_controller);

  /// Whether EcuStatus named this fault, or DM1 its trouble code, at or after `since_us`.
  [[nodiscard]] bool status_named(Fault fault, TimeUs since_us) const;
  [[nodiscard]] bool dm1_named(Fault fault, TimeUs since_us, TimeUs until_us) const;
  /// Whether any fault at all was named at or after `since_us`.
  [[nodiscard]] bool any_fault(TimeUs since_us) const;
  /// Of all frames sent at or after `since_us`.
  [[nodiscard]] bool all_neutral(TimeUs since_us) const;
  [[nodiscard]] bool any_pilot_cut(TimeUs since_us) const;
  /// When the first neutral command at or after `since_us` came; -1: none has.
  [[nodiscard]] TimeUs first_neutral_us(TimeUs since_us) const;
};

}  // namespace graben::faults
