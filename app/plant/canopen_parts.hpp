// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Sensors of CANopen as they are sold: each a node that boots, waits for its start, says by its
/// heartbeat what state it is in, and sends its TPDO1 only while it is operational (CiA 301). An
/// emergency is told once, and taken back by code 0; the TPDO goes on meanwhile.
///
///   1 .. 3      encoders on the cylinders (CiA 406): position, unsigned, 10 um
///   17 .. 20    inclinometers on links and platform (CiA 410): two slopes, 0.01 degree
///   33 .. 38    pressure transmitters, cap and rod of each cylinder (CiA 404): 0.1 bar, status

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/plant/excavator_faults.hpp"
#include "app/plant/excavator_sensors.hpp"
#include "app/plant/slope_sensors.hpp"
#include "hal/can_frame.hpp"

namespace graben::plant {

class CanopenParts {
 public:
  static constexpr std::uint8_t kEncoder = 1;
  static constexpr std::uint8_t kInclinometer = 17;
  static constexpr std::uint8_t kTransmitter = 33;
  static constexpr std::uint64_t kHeartbeatCycles = 10;

  /// Those that the profile has.
  explicit CanopenParts(const ExcavatorPlantProfile& profile);

  [[nodiscard]] bool measures_joints() const { return encoders_ || slopes_; }
  [[nodiscard]] bool measures_pressures() const { return transmitters_; }

  /// What the bus says; a start is for its node or, 0, for all.
  void take(const CanFrame& frame);

  /// The frames of this cycle; every node's heartbeat among them where it is due.
  [[nodiscard]] std::vector<CanFrame> report(const ExcavatorPlant& plant,
                                             const ExcavatorFaults& faults, FaultySensors& sensors,
                                             std::uint64_t cycle);

 private:
  struct Node {
    std::uint8_t id = 0;
    bool booted = false;
    bool operational = false;
  };

  void add(std::uint8_t first, std::uint8_t count);
  void measure(std::uint8_t id, const ExcavatorPlant& plant, const ExcavatorFaults& faults,
               FaultySensors& sensors, CanFrame& frame);

  bool encoders_;
  bool transmitters_;
  std::uint8_t bus_;
  std::optional<SlopeSensors> slopes_;
  std::vector<Node> nodes_;
  std::uint32_t reboots_done_ = 0;
  std::uint16_t emergency_told_ = 0;
};

}  // namespace graben::plant
