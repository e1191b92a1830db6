// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulated machine with its controller on a bus in memory, whatever its kind, and what it digs
/// in.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulation_file.hpp"
#include "app/machines/unknown_drives.hpp"
#include "app/plant/excavator_plant.hpp"
#include "app/plant/operator_node.hpp"
#include "app/scope/sim/sim_fault.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::scope {

/// What the bucket of a simulated excavator meets, switched while it digs.
class SimGround {
 public:
  SimGround(const plant::SoilProfile& soil, const plant::ObstacleProfile& obstacle)
      : soil_profile_(soil), obstacle_profile_(obstacle) {}

  void want_soil(bool wanted) { soil_ = wanted; }
  /// A rock that has come loose is gone: it has to be wanted anew.
  void want_obstacle(bool wanted) { obstacle_ = wanted; }
  [[nodiscard]] bool soil() const { return soil_; }
  [[nodiscard]] bool obstacle() const { return obstacle_; }

  /// Before each cycle: gives the plant what is wanted. A rock is put down once the tip is well
  /// in front of its face.
  void step(plant::ExcavatorPlant& plant);

 private:
  plant::SoilProfile soil_profile_;
  plant::ObstacleProfile obstacle_profile_;
  bool soil_ = false;
  bool obstacle_ = false;
};

struct SimOptions {
  std::string task = "dig";              ///< dig, grade or autodig.
  std::optional<std::string> profile;    ///< File or shipped name; the task's own unless told.
  machines::SimulatedChoice simulated;   ///< Of an excavator.
  std::optional<std::string> task_file;  ///< Of autodig: file or shipped name; else flatten.
  /// That an excavator digs in: of machines::kSoilNames, or of dig kim, a field of force that the
  /// page can switch off. Empty: none from the start.
  std::string soil;
  /// Of grade: the machine with a design of its own, in the place of `profile`.
  std::optional<machines::SimulatedDozer> designed;
  /// What the controller does not know is drawn from it: errors of sensors and parameters. Exact
  /// without it.
  std::optional<std::uint64_t> seed;
  /// Of a task that needs drives which were not commissioned.
  machines::UnknownTask unknown = machines::UnknownTask::kRefused;
};

class SimMachine {
 public:
  SimMachine() = default;
  SimMachine(const SimMachine&) = delete;
  SimMachine& operator=(const SimMachine&) = delete;
  virtual ~SimMachine() = default;

  /// Everyone's cycle of 10 ms: machine, operator who asks for `request`, controller.
  virtual void step(TimeUs now_us, const plant::OperatorRequest& request) = 0;
  /// Machine and controller are new and at their start; the faults that are on stay so, but for
  /// those that happen once.
  virtual void restart() = 0;
  /// The task has come to its end.
  [[nodiscard]] virtual bool is_done() const = 0;
  /// What the operator has to ask for.
  [[nodiscard]] virtual Task task() const = 0;

  [[nodiscard]] virtual const std::vector<SimFault>& faults() const = 0;
  [[nodiscard]] virtual bool is_on(std::size_t fault) const = 0;
  /// From the next cycle on; no change is none.
  virtual void set_fault(std::size_t fault, bool on) = 0;

  /// Null where the machine cannot be given soil or an obstacle.
  [[nodiscard]] virtual SimGround* ground() const = 0;
};

/// Sees each frame as it is on the bus, stamped with simulated time.
using FrameTap = std::function<void(const CanFrame&)>;

/// Throws std::runtime_error where the options do not fit, ProfileError for a wrong file.
[[nodiscard]] std::unique_ptr<SimMachine> make_sim_machine(const SimOptions& options, FrameTap tap);

}  // namespace graben::scope
