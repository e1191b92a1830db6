#pragma once
/// What must hold of all that the controller sends, cycle by cycle, whatever it has received.

#include <map>
#include <string>
#include <vector>

#include "firmware/core/codes.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

/// One cycle as seen from outside.
template <class Kind>
struct BusCycle {
  TimeUs now = 0;
  TimeUs elapsed_us = 0;  ///< Since the cycle before; 0 in the first.
  bool bus_active = false;
  const char* against_motion = "";  ///< Why nothing may move; empty if nothing is known.
  TimeUs released_us = 0;           ///< When the operator was last heard to have let go.
  const std::vector<SentFrame>* sent = nullptr;
  const typename Kind::Outputs* outputs = nullptr;  ///< For what is not on the bus in every cycle.
};

template <class Kind>
class BusRules {
 public:
  explicit BusRules(const typename Kind::Profile& profile) : profile_(profile), others_(profile) {}

  /// Empty, or what was wrong.
  [[nodiscard]] std::string check(const BusCycle<Kind>& cycle);

 private:
  [[nodiscard]] std::string check_frame(const CanFrame& frame);
  [[nodiscard]] std::string check_command(const BusCycle<Kind>& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_opening(const typename Kind::Dbc::SpoolCommand& command,
                                          TimeUs now);
  [[nodiscard]] std::string check_status(const BusCycle<Kind>& cycle, const CanFrame& frame);
  [[nodiscard]] std::string check_arming(const BusCycle<Kind>& cycle);
  [[nodiscard]] std::string may_not_move(const BusCycle<Kind>& cycle) const;

  const typename Kind::Profile& profile_;
  typename Kind::OtherCommands others_;
  std::map<std::uint32_t, int> counter_;  ///< Last, of each protected message.
  std::array<double, Kind::kSpools> opening_{};
  TimeUs command_us_ = 0;
  bool any_command_ = false;
  int refused_ = 0;  ///< Commands in a row that the bus did not take.
  int late_ = 0;     ///< Cycles in a row.
  EcuMode mode_ = EcuMode::kSilent;
  TimeUs motion_us_ = 0;  ///< When it was last Armed or Active.
};

}  // namespace graben::test
