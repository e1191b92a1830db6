// SPDX-License-Identifier: Apache-2.0
// Row 77: a sensor of CANopen tells an emergency of its own, though it goes on with its values.

#include "app/runs/code_text.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// Device hardware, communication, and the device's own.
constexpr std::array<std::uint16_t, 3> kCodes = {0x5010, 0x8130, 0xFF01};
constexpr std::uint8_t kEncoder = 1;
constexpr std::uint8_t kInclinometer = 17;

void sensor_emergency(Trial<Excavator>& trial) {
  const bool inclined = trial.odd();
  trial.set_up(Excavator::found_scenery_of(trial.seed(), inclined ? "inclinometers" : "encoders"));
  auto& rig = trial.work();
  plant::SoldFaults& sold = rig.plant.faults().sold;
  const std::uint8_t first = inclined ? kInclinometer : kEncoder;
  sold.emergency_node = static_cast<std::uint8_t>(first + trial.any_of(kAxisCount));
  sold.emergency = kCodes[trial.any_of(kCodes.size())];
  char node_and_code[40];
  static_cast<void>(std::snprintf(node_and_code, sizeof node_and_code,
                                  "node %d has emergency %04Xh", sold.emergency_node,
                                  sold.emergency));
  Stop stop{rig.now_us, {Fault::kStrokeMissing}, 20 * kMillisecondUs};
  bool told = false;
  stop.cure = [&] {
    told = runs::emergency_words(rig.ecu->emergency()).find(node_and_code) != std::string::npos;
    sold.emergency = 0;
  };
  trial.expect_stop(stop);
  trial.check(told, "its code is not in the text");
  trial.check(runs::emergency_words(rig.ecu->emergency()).empty(), "told after it is over");
}

}  // namespace

Rows<Excavator> sold_rows() {
  return {{77, "a sensor of CANopen tells an emergency (EMCY)", "N L", sensor_emergency}};
}

}  // namespace graben::faults
