// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Second sensors of an excavator's joints: encoders with a node of their own, which have nothing
/// in common with the first ones.

#include <array>

#include "app/plant/excavator_faults.hpp"
#include "app/plant/excavator_plant.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "app/plant/node_faults.hpp"

namespace graben::plant {

/// Where the plant's errors are on, each is off by a bias, a scale and an age of its own, drawn
/// from its seed; else each is as old as the middle of that, and exact.
class SecondSensorModel {
 public:
  explicit SecondSensorModel(const ExcavatorPlantProfile& profile);

  /// To be called every cycle of 10 ms.
  void look(const ExcavatorPlant& plant, const ExcavatorFaults& faults);
  /// What they show since then; of a joint without one 'not available'.
  [[nodiscard]] const dbc::Physical& shown(std::size_t drive) const { return shown_[drive]; }

 private:
  /// Cycles that a reading may be old.
  static constexpr std::size_t kKept = 12;

  struct Sensor {
    bool is_there = false;
    double bias = 0.0;
    double scale = 1.0;
    double age_cycles = 0.0;
    FaultyReading faulty;
    std::array<double, kKept> last{};  ///< True, the newest first.
  };

  std::array<Sensor, kDriveCount> sensor_;
  std::array<dbc::Physical, kDriveCount> shown_{};
  bool has_looked_ = false;
};

}  // namespace graben::plant
