// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulated machine in real time on a CAN interface, with an operator beside it; whatever its
/// kind.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/quiet_port.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::runs {

/// Source of enable and task.
enum class Player {
  kNobody,   ///< Another node does.
  kTask,     ///< Enables once and lets go half a second before the end.
  kChanges,  ///< As kTask; every 2 s no task is asked for during 50 ms, with the deadman held.
  kShifts,   ///< Works for 5 s, lets go for 1 s, and so on: what stopped is armed again.
};

struct PlantRunOptions {
  std::string interface;
  double speed = 1.0;    ///< Simulated over real time.
  double seconds = 0.0;  ///< Simulated; 0: until SIGINT or SIGTERM.
  Player player = Player::kNobody;
  double enable_after_s = 1.5;  ///< Then the operator enables, and 0.1 s later sets the task.
  double speed_override_ratio = 1.0;
  std::uint8_t task_number = 0;  ///< Of Task::kProgram.
  /// When a player at its task lets go for a second, in their order.
  std::vector<double> lets_go_s;
  std::vector<std::string> faults;  ///< As told_fault() reads them.
};

/// Figures of the run's own cycles and frames.
struct PlantBusFigures {
  double simulated_s = 0.0;
  std::uint64_t late_cycles = 0;  ///< Of this process.
  std::uint64_t frames_dropped = 0;
};

inline constexpr TimeUs kPlantPeriod_us = 10 * kMillisecondUs;
inline constexpr double kPlantPeriod_s = static_cast<double>(kPlantPeriod_us) * 1e-6;

/// `Kind` is a simulated machine kind.
template <class Kind>
class PlantBus {
 public:
  /// Opens the interface for a machine that takes these ids. Throws std::runtime_error where it is
  /// not there.
  PlantBus(const PlantRunOptions& options, const std::vector<std::uint32_t>& ids);

  /// The machine's.
  [[nodiscard]] CanPort& port() { return machine_way_; }
  /// Of frames that tell of the run, which are sent in late cycles too.
  [[nodiscard]] CanPort& mark_port() { return port_; }
  /// The operator lets go, for good.
  void let_go();
  /// Cycle by cycle, the machine and then the operator, until the time is over or the process is
  /// told to end. Of cycles that the process was too late for, up to five in a row are run before
  /// the next one, unheard.
  PlantBusFigures run(Task task, const std::function<void(TimeUs)>& machine);

 private:
  PlantRunOptions options_;
  SocketCanPort port_;
  SocketCanPort operator_port_;
  QuietPort machine_way_{port_};
  QuietPort operator_way_{operator_port_};
  typename Kind::Operator driver_;
};

extern template class PlantBus<ExcavatorSim>;
extern template class PlantBus<DozerSim>;

}  // namespace graben::runs
