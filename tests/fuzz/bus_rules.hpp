#pragma once
/// What must hold of all that the controller sends, cycle by cycle, whatever it has received.

#include <map>
#include <string>
#include <vector>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/machine/excavator_profile.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

/// One cycle as seen from outside.
struct BusCycle {
  TimeUs now = 0;
  TimeUs elapsed_us = 0;  ///< Since the cycle before; 0 in the first.
  bool bus_active = false;
  const char* against_motion = "";  ///< Why nothing may move; empty if nothing is known.
  TimeUs released_us = 0;           ///< When the operator was last heard to have let go.
  const std::vector<SentFrame>* sent = nullptr;
  const ExcavatorOutputs* outputs = nullptr;  ///< For what is not on the bus in every cycle.
};

class BusRules {
 public:
  explicit BusRules(const ExcavatorProfile& profile) : profile_(profile) {}

  /// Empty, or what was wrong.
  [[nodiscard]] std::string check(const BusCycle& cycle);

 private:
  [[nodiscard]] std::string check_frame(const CanFrame& frame);
  [[nodiscard]] std::string check_command(const BusCycle& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_opening(const dbc::excavator::SpoolCommand& command, TimeUs now);
  [[nodiscard]] std::string check_status(const BusCycle& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_arming(const BusCycle& cycle);
  [[nodiscard]] std::string may_not_move(const BusCycle& cycle) const;

  const ExcavatorProfile& profile_;
  std::map<std::uint32_t, int> counter_;  ///< Last, of each protected message.
  std::array<double, kAxisCount> opening_{};
  TimeUs command_us_ = 0;
  bool any_command_ = false;
  int refused_ = 0;  ///< Commands in a row that the bus did not take.
  int late_ = 0;     ///< Cycles in a row.
  EcuMode mode_ = EcuMode::kSilent;
  TimeUs motion_us_ = 0;  ///< When it was last Armed or Active.
};

}  // namespace graben::test
