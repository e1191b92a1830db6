#pragma once
/// The simulated machine in real time on a CAN interface.

#include <cstdint>
#include <string>

#include "app/machines/machine_file.hpp"

namespace graben::cli {

/// Who gives enable and task.
enum class Player {
  kNobody,  ///< Another node does.
  kDig,     ///< Enables once and lets go half a second before the end.
  kShifts,  ///< Digs for 5 s, lets go for 1 s, and so on: what stopped is armed again.
};

struct PlantRunOptions {
  std::string interface;
  Eigen::Vector3d start_strokes_m = Eigen::Vector3d::Zero();
  double speed = 1.0;    ///< Simulated over real time.
  double seconds = 0.0;  ///< Simulated; 0: until SIGINT or SIGTERM.
  Player player = Player::kNobody;
  double enable_after_s = 1.5;  ///< Then the operator enables, and 0.1 s later sets the task.
  double speed_override_ratio = 1.0;
};

/// What the run saw. Errors are of the true tip, while it was on the path and the spools enabled.
struct PlantRunResult {
  double simulated_s = 0.0;
  double on_path_s = 0.0;
  double loops = 0.0;  ///< Times round the path.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  double enabled_s = 0.0;  ///< That the valve side let spools open.
  std::uint64_t commands_accepted = 0;
  std::uint64_t commands_rejected = 0;
  std::uint64_t command_timeouts = 0;
  std::uint64_t late_cycles = 0;  ///< Of this process.
  std::uint64_t frames_dropped = 0;
  double peak_chamber_pressure_pa = 0.0;
};

/// Throws std::runtime_error where the interface is not there.
[[nodiscard]] PlantRunResult run_plant(const machines::ExcavatorMachine& machine,
                                       const PlantRunOptions& options);

}  // namespace graben::cli
